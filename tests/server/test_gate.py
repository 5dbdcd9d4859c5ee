"""Every combination of what the gate is told."""

from __future__ import annotations

import itertools

from server import gate
from server.schemas import Lifecycle, Mode, Verdict

BOTH = (False, True)
UNCLEAR = "not everything is in sight: block_a: not seen for 4 s"
VERDICTS: tuple[Verdict | None, ...] = (*Verdict, None)


def test_opens_for_exactly_one_kind_of_situation() -> None:
    opened = 0
    # in two products: mypy knows the types of a product of few only
    for (mode, verdict, lifecycle, (critic, gold), (rule, stands)), (
        halted,
        simulated,
        operator,
        inside,
        current,
        unclear,
    ) in itertools.product(
        itertools.product(Mode, VERDICTS, Lifecycle, itertools.product(BOTH, BOTH), itertools.product(BOTH, BOTH)),
        itertools.product(BOTH, BOTH, BOTH, BOTH, BOTH, ("", UNCLEAR)),
    ):
        decision = gate.decide(
            mode=mode,
            by_critic=critic,
            auto_approval=rule,
            gold=gold,
            verdict=verdict,
            rule_stands=stands,
            lifecycle=lifecycle,
            halted=halted,
            simulated=simulated,
            operator_present=operator,
            workspace_ok=inside,
            observation_current=current,
            unclear=unclear,
        )
        expected = (
            mode == "execute_approved"
            and verdict == "good"
            and lifecycle == "running"
            and not halted
            and (simulated or operator)
            and inside
            and current
            and not unclear
            and ((simulated and rule) if critic else stands)
            and not gold
        )
        assert decision.allowed == expected
        assert not (decision.allowed and critic and not simulated)  # whatever else holds
        assert (decision.reason == "open") == expected
        opened += expected
    # with a person's verdict a simulator with and without an operator and a real robot with one, rule or not; with the
    # critic's a simulator, where there is a rule, whatever votes add up to
    assert opened == 3 * 2 + 2 * 2


def test_an_evaluation_moves_simulators_only_and_never_beside_training() -> None:
    opened = set()
    for verdict, lifecycle, halted, simulated, inside, current in itertools.product(
        VERDICTS, Lifecycle, BOTH, BOTH, BOTH, BOTH
    ):
        decision = gate.decide_evaluation(
            verdict=verdict,
            lifecycle=lifecycle,
            halted=halted,
            simulated=simulated,
            workspace_ok=inside,
            observation_current=current,
        )
        assert (decision.reason == "open") == decision.allowed
        if decision.allowed:
            assert verdict == "good"
            assert simulated
            assert not halted
            assert inside
            assert current
            opened.add(lifecycle)
    assert opened == {Lifecycle.CREATED, Lifecycle.PAUSED, Lifecycle.FINISHED}


def test_the_reason_names_what_is_in_the_way() -> None:
    shut = gate.decide(
        mode=Mode.PROPOSE_ONLY,
        by_critic=False,
        auto_approval=False,
        gold=False,
        verdict=Verdict.GOOD,
        rule_stands=True,
        lifecycle=Lifecycle.RUNNING,
        halted=False,
        simulated=True,
        operator_present=False,
        workspace_ok=True,
        observation_current=True,
        unclear="",
    )
    assert shut.reason == "the mode is propose only"
