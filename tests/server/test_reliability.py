"""How often each trainer is right, and how far they agree: against other implementations, and in hard cases."""

from __future__ import annotations

import numpy as np
import pytest

from server.agreement import Agreement, agreement, ordinal_alpha
from server.reliability import Estimate, Said, estimate

SKILL = {0: 0.9, 1: 0.8, 2: 0.65, 3: 0.4}
CROWD_KIT = (
    0.2996,
    0.3525,
    1.0000,
    1.0000,
    0.0000,
    0.7016,
    0.0000,
    1.0000,
    0.0000,
    1.0000,
    0.4624,
    0.0000,
    0.0000,
    0.0000,
    0.3525,
    0.0000,
    0.0000,
    0.0000,
    0.0000,
    0.5124,
    1.0000,
    1.0000,
    0.0000,
    0.6543,
    1.0000,
    0.0000,
    0.2595,
    1.0000,
    0.6543,
    1.0000,
    0.0816,
    1.0000,
    1.0000,
    0.0000,
    0.0000,
    1.0000,
    1.0000,
    1.0000,
    0.3513,
    0.0000,
    0.0000,
    0.2585,
    0.0000,
    0.5124,
    1.0000,
    1.0000,
    0.0000,
    0.6543,
    1.0000,
    0.0000,
    0.0000,
    0.7016,
    0.2359,
    0.0000,
    0.0000,
    0.0000,
    1.0000,
    0.0000,
    1.0000,
    0.0000,
)
"""Probability that each call of `crowd(7)` is good, by crowd-kit 1.4.2: DawidSkene(n_iter=500, tol=1e-9)."""


Word = tuple[int, int, int]
"""Proposal, trainer, and what they said."""


def estimated(said: list[Word], known: dict[int, int], **pseudo_counts: float) -> Estimate:
    """From words instead of columns."""
    return estimate(Said(*np.array(said, np.int64).reshape(-1, 3).T), known, **pseudo_counts)


def agreed(clicks: dict[int, dict[int, int]]) -> Agreement:
    """Of proposal -> trainer -> value."""
    words = [(unit, trainer, value) for unit, values in clicks.items() for trainer, value in values.items()]
    return agreement(*np.array(words, np.int64).reshape(-1, 3).T)


def crowd(seed: int, calls: int = 60) -> tuple[list[Word], dict[int, int]]:
    """Trainers of the above skill, each judging three quarters of the calls; and the truth."""
    random, said, truth = np.random.default_rng(seed), [], {}
    for call in range(calls):
        truth[call] = 1 if random.random() < 0.45 else -1
        for trainer, skill in SKILL.items():
            if random.random() < 0.75:
                said.append((call, trainer, truth[call] if random.random() < skill else -truth[call]))
    return said, truth


def test_without_pseudo_counts_it_is_dawid_and_skene_as_crowd_kit_has_it() -> None:
    said, _ = crowd(7)
    found = estimated(said, {}, correct=1e-9, other=1e-9)
    assert found.proposals.tolist() == list(range(60))
    assert found.truth == pytest.approx(CROWD_KIT, abs=1e-4)


def test_trainers_are_told_apart_and_known_answers_find_out_a_majority_that_errs() -> None:
    said, truth = crowd(3, 400)
    found = estimated(said, {call: truth[call] for call in range(0, 400, 10)}).trainers
    for trainer, skill in SKILL.items():
        interval = found[trainer].interval
        assert interval is not None
        assert found[trainer].accuracy == pytest.approx(skill, abs=0.1)
        assert found[trainer].weight == pytest.approx(found[trainer].accuracy, abs=0.02)
    # two say the opposite of the truth together, one is right: only known answers can tell who
    said = [(call, trainer, (1, -1, -1)[trainer] * (-1) ** call) for call in range(40) for trainer in range(3)]
    fooled = estimated(said, {}).trainers
    told = estimated(said, {call: (-1) ** call for call in range(12)}).trainers
    assert fooled[0].weight < 0.5 < fooled[1].weight
    assert told[1].weight < 0.5 < told[0].weight


def test_of_a_trainer_who_is_alone_nothing_is_known_until_answers_are() -> None:
    said = [(call, 5, 1) for call in range(30)]
    (alone,) = estimated(said, {}).trainers.values()
    assert (alone.labels, alone.informative, alone.accuracy, alone.interval) == (30, 0, None, None)
    assert alone.weight == pytest.approx(2 / 3)
    (held_to,) = estimated(said, {0: 1, 1: 1, 2: -1}).trainers.values()
    assert (held_to.informative, held_to.right) == (3, 2)
    assert held_to.weight == pytest.approx(4 / 6)
    assert estimated([], {}).trainers == {}


def test_where_nobody_judged_what_another_did_nothing_is_known_of_anybody() -> None:
    said = [(10 * trainer + call, trainer, 1 - 2 * (call % 2)) for trainer in range(4) for call in range(10)]
    found = estimated(said, {})
    for each in found.trainers.values():
        assert (each.labels, each.informative, each.accuracy, each.interval) == (10, 0, None, None)
        assert each.weight == pytest.approx(2 / 3)
    assert np.isfinite(found.truth).all()


def test_who_all_say_the_same_are_believed() -> None:
    for value in (1, -1):
        found = estimated([(call, trainer, value) for call in range(30) for trainer in range(3)], {})
        assert (found.truth if value > 0 else 1 - found.truth).min() > 0.99
        assert all(each.informative == 30 and each.weight > 0.95 for each in found.trainers.values())
    neutral = estimated([(call, trainer, 0) for call in range(30) for trainer in range(3)], {})
    assert np.isfinite(neutral.truth).all()
    assert {each.informative for each in neutral.trainers.values()} == {0}


def test_an_adversary_and_spammers_are_found_out_and_lead_nobody_astray() -> None:
    random, said, truth = np.random.default_rng(11), [], {}
    for call in range(300):
        truth[call] = 1 if random.random() < 0.3 else -1
        said += [(call, trainer, truth[call] if random.random() < 0.85 else -truth[call]) for trainer in (1, 2, 3)]
        said += [(call, 4, -truth[call]), (call, 5, int(random.choice((-1, 1)))), (call, 6, 1)]
    found = estimated(said, {})
    right = [(found.truth[n] > 0.5) == (truth[int(call)] > 0) for n, call in enumerate(found.proposals)]
    assert sum(right) >= 0.97 * len(right)
    accuracy = {who: each.accuracy for who, each in found.trainers.items()}
    assert [accuracy[who] for who in (1, 2, 3)] == pytest.approx([0.85] * 3, abs=0.06)
    assert accuracy[4] == pytest.approx(0, abs=0.06), "always wrong"
    assert accuracy[5] == pytest.approx(0.5, abs=0.08), "throws a coin"
    assert accuracy[6] == pytest.approx(sum(each > 0 for each in truth.values()) / 300, abs=0.06), "always says good"


def test_neutral_says_neither_and_harms_nobodys_accuracy() -> None:
    said = [(call, trainer, 1) for call in range(10) for trainer in (1, 2)] + [(c, 3, 0) for c in range(10)]
    found = estimated(said, {}).trainers
    assert (found[3].labels, found[3].informative) == (10, 0)
    assert found[1].right == pytest.approx(10, abs=0.2)


def test_alpha_is_the_one_worked_out_by_hand() -> None:
    # labels: two bad, one neutral, three good. Ordinal distances squared: neutral-good (1/2 + 3/2)^2 = 4, bad-neutral
    # (2/2 + 1/2)^2 = 2.25, bad-good (2/2 + 1 + 3/2)^2 = 12.25. Observed 2 x 4; expected 2 x (4.5 + 73.5 + 12) / 5 = 36
    found = agreed({1: {1: 1, 2: 1}, 2: {1: -1, 2: -1}, 3: {1: 0, 2: 1}, 4: {1: -1}})
    assert found.alpha == pytest.approx(1 - 8 / 36)
    assert (found.proposals, found.labels, found.trainers) == (3, 6, 2)
    opposite = agreed({unit: {1: value, 2: -value} for unit, value in enumerate((-1, 1, -1, 1))}).alpha
    assert opposite is not None
    assert opposite < -0.5


def test_alpha_is_that_of_krippendorffs_own_example_with_missing_values() -> None:
    # Krippendorff (2011), "Computing Krippendorff's Alpha-Reliability", part C: four observers, twelve units, values
    # 1 to 5. The last unit was observed by one only
    observers = ("123321412...", "1233224125.3", ".3332342251.", "12332441251.")
    units = [[observer[n] for observer in observers if observer[n] != "."] for n in range(12)]
    counts = np.array([[unit.count(value) for value in "12345"] for unit in units if len(unit) > 1])
    assert counts.sum() == 40
    assert ordinal_alpha(counts) == pytest.approx(0.815, abs=5e-4)


def test_bad_against_good_is_further_apart_than_against_neutral() -> None:
    shared = {unit: {1: value, 2: value} for unit, value in enumerate((-1, 0, 1))}
    near, far = agreed(shared | {9: {1: -1, 2: 0}}).alpha, agreed(shared | {9: {1: -1, 2: 1}}).alpha
    assert near is not None
    assert far is not None
    assert near > far


def test_where_agreement_cant_be_told_it_says_why() -> None:
    for clicks, why in (
        ({}, "no proposal was judged by two"),
        ({1: {1: 1}, 2: {2: -1}}, "no proposal was judged by two"),
        ({1: {1: 1, 2: 1}, 2: {1: 1, 2: 1}}, "all labels are the same"),
    ):
        found = agreed(clicks)
        assert found.alpha is None
        assert found.why is not None
        assert why in found.why
