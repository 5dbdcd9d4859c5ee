"""The replay: its proportions, and that it depends on nothing but the labels it holds."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from agent.replay import INITIAL_CAPACITY, Batch, Entry, Int64, Replay, shares

VALUES = st.sampled_from([-1, 0, 1])


def entry(label_id: int, value: int) -> Entry:
    """An entry whose every column tells its id."""
    state = np.full(2, label_id, dtype=np.float32)
    return Entry(label_id, state, label_id % 3, np.full(4, -label_id, dtype=np.float32), value, value - label_id * 1e-6)


def filled(*values: int) -> Replay:
    """Labels 1, 2, ... of these values."""
    replay = Replay(2, 4)
    for label_id, value in enumerate(values, start=1):
        replay.add(entry(label_id, value))
    return replay


def drawn_values(batch: Batch) -> Counter[int]:
    """How many of each value a batch holds."""
    return Counter(round(float(t)) for t in batch.targets)


def test_a_batch_is_half_good_and_half_bad() -> None:
    replay = filled(1, *[-1] * 99)
    assert drawn_values(replay.sample(64, np.random.default_rng(0))) == {1: 32, -1: 32}


def test_only_bad_ones_until_a_good_one_exists() -> None:
    replay = filled(-1, -1, -1)
    assert drawn_values(replay.sample(64, np.random.default_rng(0))) == {-1: 64}
    replay.add(entry(4, 1))
    assert drawn_values(replay.sample(64, np.random.default_rng(0))) == {1: 32, -1: 32}


def test_neutral_is_neither_half() -> None:
    replay = filled(*[0] * 25, *[-1] * 70, *[1] * 5)
    assert drawn_values(replay.sample(64, np.random.default_rng(0))) == {0: 16, 1: 24, -1: 24}


@pytest.mark.parametrize(
    ("good", "neutral", "bad", "expected"),
    [
        (0, 3, 0, {1: 0, 0: 16, -1: 0}),
        (3, 0, 0, {1: 16, 0: 0, -1: 0}),
        (0, 1, 1000, {1: 0, 0: 1, -1: 15}),
        (1, 1000, 1, {1: 1, 0: 14, -1: 1}),
        (5, 0, 5, {1: 8, 0: 0, -1: 8}),
    ],
)
def test_shares_at_the_edges(good: int, neutral: int, bad: int, expected: dict[int, int]) -> None:
    assert shares({1: good, 0: neutral, -1: bad}, 16) == expected


@given(st.integers(0, 300), st.integers(0, 300), st.integers(0, 300), st.integers(4, 1024))
def test_shares_add_up_and_draw_only_what_exists(good: int, neutral: int, bad: int, size: int) -> None:
    counts = {1: good, 0: neutral, -1: bad}
    if not any(counts.values()):
        return
    drawn = shares(counts, size)
    assert sum(drawn.values()) == size
    assert all(drawn[value] >= 0 and (counts[value] or not drawn[value]) for value in counts)
    assert all(drawn[value] for value in counts if counts[value]), "every kind of label held is learned from"
    if good and bad:
        assert 0 <= drawn[-1] - drawn[1] <= 1


def ids_refused(replay: Replay) -> list[int]:
    return [-int(parameters[0]) for parameters in replay.refused(np.zeros(2, dtype=np.float32), np.inf).parameters]


def test_a_neutral_label_puts_a_call_off_only_until_the_next_answer() -> None:
    replay = filled(-1, 0, 1, 0, 0)
    assert ids_refused(replay) == [1, 4, 5]
    replay.add(entry(6, -1))
    assert ids_refused(replay) == [1, 6]
    assert ids_refused(filled(0, 0)) == [1, 2]
    assert ids_refused(filled()) == []


def test_an_empty_replay_draws_nothing() -> None:
    with pytest.raises(ValueError, match="empty"):
        Replay(2, 4).sample(8, np.random.default_rng(0))


def test_a_label_is_held_once() -> None:
    replay = filled(1)
    with pytest.raises(ValueError, match="held already"):
        replay.add(entry(1, -1))


def test_a_foreign_value_is_refused() -> None:
    with pytest.raises(ValueError, match="not -1, 0 or 1"):
        Replay(2, 4).add(entry(1, 2))


def test_it_grows() -> None:
    count = 2 * INITIAL_CAPACITY + 5
    replay = filled(*([1, -1] * count)[:count])
    batch = replay.sample(50_000, np.random.default_rng(0))
    assert len(replay) == count
    assert set(batch.states[:, 0].astype(int)) == set(range(1, count + 1)), "every label can be drawn"


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(st.integers(1, 40), VALUES, st.booleans()), max_size=80), st.integers(0, 2**32 - 1))
def test_it_depends_on_the_labels_held_only(steps: list[tuple[int, int, bool]], seed: int) -> None:
    replay, held = Replay(2, 4), dict[int, int]()
    for label_id, value, forget in steps:
        if forget:
            replay.forget(label_id)
            held.pop(label_id, None)
        elif label_id not in held:
            replay.add(entry(label_id, value))
            held[label_id] = value
    assert len(replay) == len(held)
    assert all((label_id in replay) == (label_id in held) for label_id in range(42))
    assert replay.counts() == {v: list(held.values()).count(v) for v in (1, 0, -1)}
    if not held:
        return
    anew = Replay(2, 4)
    for label_id in sorted(held):
        anew.add(entry(label_id, held[label_id]))
    ours, theirs = (r.sample(16, np.random.default_rng(seed)) for r in (replay, anew))
    np.testing.assert_array_equal(ours.states, theirs.states)
    np.testing.assert_array_equal(ours.targets, theirs.targets)
    for state, skill, parameters, target in zip(ours.states, ours.skills, ours.parameters, ours.targets, strict=True):
        expected = entry(int(state[0]), held[int(state[0])])
        assert skill == expected.skill
        np.testing.assert_array_equal(parameters, expected.parameters)
        assert target == np.float32(expected.target)


@given(st.permutations(range(6)), st.lists(VALUES, min_size=30, max_size=30))
@settings(max_examples=30, deadline=None)
def test_parts_may_come_in_any_order_also_from_the_newest_back(order: list[int], values: list[int]) -> None:
    whole, in_parts = filled(*values), Replay(2, 4)
    for part in order:
        some = in_parts.empty()
        for label_id in range(5 * part + 1, 5 * part + 6):
            some.add(entry(label_id, values[label_id - 1]))
        in_parts.take(some)
    for replay in (whole, in_parts):
        replay.forget(3)
        replay.add(entry(31, 1))
    ours, theirs = (replay.sample(64, np.random.default_rng(0)) for replay in (whole, in_parts))
    assert in_parts.counts() == whole.counts()
    np.testing.assert_array_equal(ours.states, theirs.states)
    np.testing.assert_array_equal(ours.targets, theirs.targets)


def test_thousands_of_older_labels_find_room_and_the_newer_stay() -> None:
    replay, count = Replay(2, 4), 4 * INITIAL_CAPACITY
    for first in range(count - 500, -1, -500):
        some = replay.empty()
        for label_id in range(first + 1, first + 501):
            some.add(entry(label_id, 1 if label_id % 2 else -1))
        replay.take(some)
    assert replay.counts()[1] == replay.counts()[-1] == len(replay) / 2
    assert len(replay) == count // 500 * 500
    np.testing.assert_array_equal(replay.good().states[-1], np.full(2, count - 1 - count % 2))
    newer = replay.empty()
    for label_id in range(count + 1, 3 * count + 1):
        newer.add(entry(label_id, -1))
    replay.take(newer)
    assert len(replay) == count // 500 * 500 + 2 * count
    np.testing.assert_array_equal(replay.bad().states[-1], np.full(2, 3 * count))


def test_what_the_newest_mean_stays_when_older_ones_come() -> None:
    def believed(_: Batch, values: NDArray[np.int8], __: Int64) -> NDArray[np.int8]:
        return np.where(np.arange(len(values)) % 3 == 0, -values, values).astype(np.int8)

    at_once, later = (Replay(2, 4, believed=believed) for _ in range(2))
    for replay, parts in ((at_once, [(1, 1600)]), (later, [(1500, 1600), (900, 1500), (300, 900), (1, 300)])):
        for first, end in parts:
            some = replay.empty()
            for label_id in range(first, end):
                some.add(entry(label_id, 1 if label_id % 2 else -1))
            replay.take(some)
            replay.counts()  # what the labels mean is worked out when it is asked for
    ours, theirs = (replay.sample(256, np.random.default_rng(0)) for replay in (at_once, later))
    assert at_once.counts() == later.counts()
    np.testing.assert_array_equal(ours.targets, theirs.targets)
