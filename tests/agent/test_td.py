"""Targets, slow weights, transitions and the schedule against values worked out by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from torch import nn

from agent import td

QUARTERS = torch.tensor([[0.25, 0.75]], dtype=torch.float64).log()


def test_a_target_is_the_reward_and_the_discounted_rest() -> None:
    found = td.targets(torch.tensor([0.5, 1.0]), torch.tensor([0.0, 0.0]), torch.tensor([2.0, -4.0]), 0.9)
    assert found.tolist() == pytest.approx([0.5 + 0.9 * 2, 1 - 0.9 * 4])


def test_nothing_follows_the_end_of_a_task_but_a_cut_episode_would_have_gone_on() -> None:
    """The same step, once because it solved the task and once where the horizon fell."""
    ended, cut = td.targets(torch.ones(2), torch.tensor([1.0, 0.0]), torch.full((2,), 10.0), 0.5).tolist()
    assert (ended, cut) == (1.0, 6.0)


def test_soft_value_adds_the_entropy_bonus() -> None:
    found = td.soft_value(torch.tensor([2.0, 2.0]), torch.tensor([-1.0, 3.0]), torch.tensor(0.5))
    assert found.tolist() == pytest.approx([2.5, 0.5])


def test_soft_skill_value_is_the_exact_mean_over_skills() -> None:
    values = torch.tensor([[2.0], [-1.0]], dtype=torch.float64)
    density = torch.tensor([[-1.0], [0.0]], dtype=torch.float64)
    found = td.soft_skill_value(values, QUARTERS, density, torch.tensor(0.3), torch.tensor(0.2))
    by_hand = 0.25 * (2 + 0.2 - 0.3 * math.log(0.25)) + 0.75 * (-1 - 0.3 * math.log(0.75))
    assert found.item() == pytest.approx(by_hand)


def test_one_certain_skill_leaves_sacs_value() -> None:
    values, density, one = torch.tensor([[2.0, 1.0]]), torch.tensor([[0.5, -0.5]]), torch.zeros(2, 1)
    found = td.soft_skill_value(values, one, density, torch.tensor(9.0), torch.tensor(0.1))
    torch.testing.assert_close(found, td.soft_value(values[0], density[0], torch.tensor(0.1)))


def test_slow_weights_follow_by_their_rate() -> None:
    slow, fast = nn.Linear(1, 1), nn.Linear(1, 1)
    with torch.no_grad():
        for network, value in ((slow, 1.0), (fast, 3.0)):
            for weight in network.parameters():
                weight.fill_(value)
    td.follow(slow, fast, 0.25)
    assert slow.weight.item() == slow.bias.item() == 1.5
    td.follow(slow, fast, 0.25)
    assert slow.weight.item() == 1.875
    assert fast.weight.item() == 3.0
    td.copy_weights(slow, fast)
    assert slow.weight.item() == 3.0


def filled(count: int, capacity: int) -> td.Memory:
    memory = td.Memory(capacity, state=2, reward=0)
    for i in range(count):
        memory.add(state=np.array([i, -i], dtype=np.float32), reward=float(i))
    return memory


@given(count=st.integers(0, 2500), capacity=st.sampled_from([1, 7, 1024, 1500, 4000]))
@settings(max_examples=25, deadline=None)
def test_the_newest_records_are_kept(count: int, capacity: int) -> None:
    memory = filled(count, capacity)
    assert sorted(memory.column("reward").tolist()) == list(range(max(0, count - capacity), count))
    np.testing.assert_array_equal(memory.column("state"), np.outer(memory.column("reward"), [1, -1]))


@pytest.mark.parametrize(("count", "capacity"), [(0, 10), (3, 10), (10, 10), (13, 10), (1500, 3000)])
def test_a_restored_memory_goes_on_as_the_other_would(count: int, capacity: int) -> None:
    memory = filled(count, capacity)
    other = td.Memory(capacity, state=2, reward=0).restored(*memory.contents())
    for each in (memory, other):
        each.add(state=np.zeros(2, dtype=np.float32), reward=-1.0)
    np.testing.assert_array_equal(memory.column("reward"), other.column("reward"))
    drawn = [each.sample(5, np.random.default_rng(0))["state"] for each in (memory, other)]
    assert torch.equal(*drawn)


def test_contents_that_do_not_fit_are_refused() -> None:
    at, columns = filled(5, 10).contents()
    memory = td.Memory(10, state=2, reward=0)
    for changed in (
        {**columns, "reward": columns["reward"][:3]},
        {**columns, "state": columns["state"][:, :1]},
        {name: np.concatenate([column] * 3) for name, column in columns.items()},
    ):
        with pytest.raises(ValueError, match="transitions"):
            memory.restored(at, changed)
    with pytest.raises(ValueError, match="the next at 2"):
        memory.restored(2, columns)
    with pytest.raises(KeyError):
        memory.restored(at, {"state": columns["state"]})


def test_every_record_is_as_likely() -> None:
    drawn = filled(4, 10).sample(4000, np.random.default_rng(0))["reward"]
    for value in range(4):
        assert (drawn == value).float().mean().item() == pytest.approx(0.25, abs=0.03)


@pytest.mark.parametrize(
    ("frequency", "steps", "warm_up", "owed"),
    [(1, 5, 0, [5, 10, 15, 20]), (1, 5, 2, [0, 0, 5, 10]), (2, 3, 1, [0, 0, 3, 3]), (25, 30, 0, [0, 0, 0, 0])],
)
def test_updates_are_owed_as_the_schedule_says(frequency: int, steps: int, warm_up: int, owed: list[int]) -> None:
    schedule = td.Schedule(steps, frequency, warm_up)
    seen = []
    for _ in range(4):
        schedule.observed()
        seen.append(schedule.owed)
    assert seen == owed
