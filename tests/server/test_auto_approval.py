"""The critic's own approvals as pure functions: when they are made, when they are checked, when they end."""

from __future__ import annotations

import math
from collections import Counter
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.auto_approval import WINDOW, Case, Decision, check, decide, is_audited, too_low
from server.errors import ServiceError
from server.schemas import Mode
from server.schemas_trust import AutoApproval

RULE = AutoApproval(audit_every=4)
SURE = Case(
    predicted=0.95,
    uncertainty=0.05,
    simulated=True,
    mode=Mode.EXECUTE_APPROVED,
    feedback=50,
    qualified=0,
    seed=3,
)


def case(**changes: Any) -> Case:
    return Case(**(vars(SURE) | changes))


def test_a_sure_critic_approves_and_one_in_each_block_is_audited() -> None:
    decisions = [decide(RULE, case(qualified=n)) for n in range(40)]
    for block in range(0, 40, 4):
        assert Counter(decisions[block : block + 4]) == {Decision.APPROVE: 3, Decision.AUDIT: 1}
    # by lot, so that a task that alternates between two skills has both checked
    assert len({n % 4 for n, d in enumerate(decisions) if d is Decision.AUDIT}) > 1
    assert decisions == [decide(RULE, case(qualified=n)) for n in range(40)]
    assert decisions != [decide(RULE, case(qualified=n, seed=4)) for n in range(40)]
    assert all(is_audited(1, n, 0) for n in range(5))


@pytest.mark.parametrize(
    "change",
    [
        {"predicted": 0.8999},
        {"predicted": math.nan},
        {"uncertainty": math.nan},
        {"uncertainty": 0.1001},
        {"uncertainty": None},
        {"feedback": 49},
        {"simulated": False},
        {"mode": Mode.PROPOSE_ONLY},
    ],
)
def test_whatever_is_missing_the_trainers_are_asked(change: dict[str, Any]) -> None:
    assert decide(RULE, SURE) is not Decision.ASK
    assert decide(RULE, case(**change)) is Decision.ASK
    assert decide(None, SURE) is Decision.ASK


any_float = st.floats(-1, 2) | st.floats(allow_nan=True, allow_infinity=True)


@given(
    rule=st.builds(
        AutoApproval,
        predicted_at_least=st.floats(0, 1),
        uncertainty_at_most=st.floats(0, 2),
        after_feedback=st.integers(1, 5),
        audit_every=st.integers(1, 5),
    )
    | st.none(),
    case=st.builds(
        Case,
        predicted=any_float,
        uncertainty=any_float | st.none(),
        simulated=st.booleans(),
        mode=st.sampled_from(Mode),
        feedback=st.integers(0, 10),
        qualified=st.integers(0, 100),
        seed=st.integers(0, 2**31 - 1),
    ),
)
def test_nothing_is_ever_approved_for_a_real_robot_or_below_the_rule(rule: AutoApproval | None, case: Case) -> None:
    if decide(rule, case) is Decision.ASK:
        return
    assert rule is not None
    assert case.simulated
    assert case.mode is Mode.EXECUTE_APPROVED
    assert case.uncertainty is not None
    assert case.predicted >= rule.predicted_at_least
    assert case.uncertainty <= rule.uncertainty_at_most
    assert case.feedback >= rule.after_feedback


def test_it_ends_once_trainers_surely_agree_too_rarely() -> None:
    assert not too_low(RULE, 0, 0)  # nothing is known yet
    assert too_low(RULE, 1, 0)  # the first audit of a sure critic was wrong
    assert not too_low(RULE, 10, 8)  # 0.49 to 0.94
    assert too_low(RULE, 10, 7)  # 0.40 to 0.89
    assert not too_low(RULE, WINDOW, WINDOW)
    assert too_low(AutoApproval(agreement_at_least=1.0), WINDOW, WINDOW - 1)


def test_full_agreement_is_never_too_low() -> None:
    strictest = AutoApproval(agreement_at_least=1)
    assert not any(too_low(strictest, count, count) for count in range(WINDOW + 1))


def test_a_rule_for_a_real_robot_or_a_single_critic_is_refused() -> None:
    check(RULE, adapter="kinematic", simulated=True, settings={"critics": 2})
    check(None, adapter="benchtop", simulated=False, settings={})
    for simulated, settings in ((False, {"critics": 5}), (True, {"critics": 1}), (True, {})):
        with pytest.raises(ServiceError) as refused:
            check(RULE, adapter="any", simulated=simulated, settings=settings)
        assert refused.value.problem.status == 422
        assert [field.field for field in refused.value.problem.fields] == ["auto_approval"]
        assert refused.value.problem.remedy
