"""SEED through its `Algorithm` door: it learns, repeats exactly, resumes exactly, and refuses what makes no sense."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

from agent import kernels
from agent.algorithm import AgentError, Algorithm, CheckpointError, Label, Pausing, Problem, Suggestion
from agent.config import SEED, SeedSettings
from agent.gradients import METRICS
from agent.seed import Seed
from robot_adapters.base import ParameterSpec, SkillCall, SkillSpec, check_call
from tests.agent.problems import PICK, PUSH, RELEASE, labels, problem

SMALL: dict[str, Any] = {"hidden_size": 32, "batch_size": 32}
STATE = np.array([0.5, 1.0, 1.5])


@pytest.fixture(autouse=True)
def _one_thread() -> None:
    torch.set_num_threads(1)


def seed(*skills: SkillSpec, number: int = 0, **settings: Any) -> Seed:
    learner = SEED(problem(*skills), SeedSettings(**{**SMALL, **settings}), number)
    assert isinstance(learner, Seed)
    return learner


def work_off(learner: Algorithm) -> None:
    while learner.owed_updates:
        learner.update()


def proposals(learner: Algorithm, count: int = 5) -> list[Suggestion]:
    return [learner.propose(STATE) for _ in range(count)]


# --- it learns


def train(learner: Seed, judge: Callable[[SkillCall], int], feedback: int) -> None:
    for label_id in range(1, feedback + 1):
        call = learner.propose(STATE).call
        learner.add([Label(label_id, STATE, call, judge(call))])
        work_off(learner)


def test_it_learns_which_skill_and_where() -> None:
    """One state; only a pick with x near 0.6 m is good."""
    line = (ParameterSpec("x", "m", 0.3, 0.8),)

    def judge(call: SkillCall) -> int:
        return 1 if call.skill == "pick" and abs(call.parameters[0] - 0.6) < 0.05 else -1

    learner = seed(SkillSpec("push", line), SkillSpec("pick", line), RELEASE, learning_rate=3e-3)
    train(learner, judge, 150)
    good = sum(judge(s.call) == 1 for s in proposals(learner, 50))
    best = learner.propose(STATE, deterministic=True)
    assert good >= 30, f"{good} of 50 sampled proposals are good; untrained it is about 3"
    assert judge(best.call) == 1
    assert best.predicted_feedback > 0.5
    assert best.skill_probabilities["pick"] > 0.6


def test_it_learns_a_different_call_for_each_state() -> None:
    """The good x lies where the state says."""
    learner = seed(SkillSpec("reach", (ParameterSpec("x", "m", 0, 2),)), number=1)
    rng = np.random.default_rng(1)
    for label_id in range(1, 251):
        state = np.array([rng.uniform(0.2, 1.8), 1.0, 1.0])
        call = learner.propose(state).call
        learner.add([Label(label_id, state, call, 1 if abs(call.parameters[0] - state[0]) < 0.25 else -1)])
        work_off(learner)
    errors = [
        abs(learner.propose(np.array([x, 1.0, 1.0]), deterministic=True).call.parameters[0] - x)
        for x in np.linspace(0.3, 1.7, 15)
    ]
    assert np.mean(np.array(errors) < 0.25) >= 0.9, f"errors in m: {np.round(errors, 2)}"


def test_the_critic_predicts_what_was_said() -> None:
    """Good, bad, and neutral between them; a penalty comes through as well."""
    learner = seed(PICK, RELEASE, affordance_penalty=0.2, critics=2)
    good, neutral, bad = (SkillCall("pick", (x, 0.0, 0.0)) for x in (0.3, 0.55, 0.8))
    said = [(good, 1, True), (neutral, 0, True), (bad, -1, False)]
    learner.add([Label(i, STATE, call, value, near) for i, (call, value, near) in enumerate(said, start=1)])
    for _ in range(300):
        metrics = learner.update()
    assert metrics is not None
    assert metrics["critic_loss"] < 0.01
    encoder = learner._encoder
    for call, expected in ((good, 1.0), (neutral, 0.0), (bad, -1.2)):
        entry = encoder.entry(Label(9, STATE, call, 0), affordance_penalty=0)
        inputs = (torch.from_numpy(entry.state)[None], torch.tensor([0]), torch.from_numpy(entry.parameters)[None])
        assert learner._networks.predict(*inputs).mean().item() == pytest.approx(expected, abs=0.2)


@pytest.mark.parametrize("preset", ["paper_sim", "recommended"])
def test_what_it_says_of_any_call_is_what_it_predicts_when_it_proposes_it(preset: str) -> None:
    asked, quiet = (seed(**{**SEED.presets[preset], **SMALL}) for _ in range(2))
    for learner in (asked, quiet):
        train(learner, lambda call: 1 if call.skill == "pick" else -1, 20)
    suggestions: list[Suggestion] = []
    for _ in range(5):
        suggestions.append(asked.propose(STATE))
        told = asked.estimate(STATE, [suggestion.call for suggestion in suggestions])
        assert told == pytest.approx([suggestion.predicted_feedback for suggestion in suggestions], abs=1e-5)
    assert proposals(quiet) == suggestions, "asking draws nothing"
    with pytest.raises(AgentError, match="fly"):
        asked.estimate(STATE, [SkillCall("fly", ())])


def test_each_loss_trains_its_own_networks_only() -> None:
    """However the actors and temperatures are driven, the critic is the same regression on the same labels."""
    calm, wild = seed(skill_entropy=0.0), seed(skill_entropy=1.0, parameter_entropy=0.5, initial_temperature=10.0)
    for learner in (calm, wild):
        learner.add(labels(30))
        work_off(learner)
    pairs = list(zip(calm._networks.named_parameters(), wild._networks.named_parameters(), strict=True))
    same = {name for (name, ours), (_, theirs) in pairs if torch.equal(ours, theirs)}
    assert same == {name for (name, _), _ in pairs if name.startswith("critics.")}


# --- it repeats exactly


def test_proposals_depend_on_seed_labels_and_updates_only() -> None:
    """Updates between or after proposals: the noise of proposing isn't touched by training."""
    eager, late = seed(), seed()
    given = labels(20)
    eager.add(given)
    late.add(given[:10])
    late.add(given[10:])
    assert eager.owed_updates == late.owed_updates == 100
    work_off(eager)
    drawn_before = proposals(seed())
    assert [s.call.digest for s in proposals(late)] == [s.call.digest for s in drawn_before], "nothing learned yet"
    proposals(eager)
    work_off(late)
    assert proposals(eager) == proposals(late)


def test_another_seed_proposes_otherwise() -> None:
    assert proposals(seed(number=0)) != proposals(seed(number=1))


def test_looking_deterministically_changes_no_proposal() -> None:
    looked, plain = seed(), seed()
    first, second = (looked.propose(STATE, deterministic=True) for _ in range(2))
    assert first == second
    assert proposals(looked) == proposals(plain)


def resumed(path: Path, stored: Sequence[Label], **settings: Any) -> Seed:
    learner = seed(number=99, **settings)
    learner.load(path)
    learner.restore(stored)
    return learner


def test_a_resumed_learner_continues_bit_for_bit(tmp_path: Path) -> None:
    settings = {"train_frequency": 2, "think_time_updates": 3}
    learner, stored = seed(**settings), labels(40)
    learner.add(stored[:25])
    proposals(learner)
    for _ in range(17):
        learner.update()
    learner.save(tmp_path / "a.ckpt")
    other = resumed(tmp_path / "a.ckpt", stored[:25], **settings)
    assert (other.policy_version, other.last_label_id) == (17, 25)
    assert (other.owed_updates, other.spare_updates) == (learner.owed_updates, learner.spare_updates) == (43, 75)
    for part in (stored[25:30], stored[30:]):
        for each in (learner, other):
            each.add(part)
        assert [learner.update() for _ in range(20)] == [other.update() for _ in range(20)]
        assert proposals(learner) == proposals(other)
    for ours, theirs in zip(learner._networks.parameters(), other._networks.parameters(), strict=True):
        assert torch.equal(ours, theirs)


def test_a_fresh_learner_can_be_saved_too(tmp_path: Path) -> None:
    learner = seed()
    learner.save(tmp_path / "a.ckpt")
    assert proposals(resumed(tmp_path / "a.ckpt", [])) == proposals(learner)


def test_labels_newer_than_the_checkpoint_owe_updates(tmp_path: Path) -> None:
    learner, stored = seed(), labels(30)
    learner.add(stored[:20])
    work_off(learner)
    learner.save(tmp_path / "a.ckpt")
    other = resumed(tmp_path / "a.ckpt", stored)
    assert other.owed_updates == 10 * 5
    learner.add(stored[20:])
    assert learner.update() == other.update()


def test_an_undone_label_leaves_no_trace(tmp_path: Path) -> None:
    """A learner that forgot a label trains as one rebuilt from a store that no longer counts it."""
    learner, stored = seed(), labels(30)
    learner.add(stored)
    learner.forget(12)
    learner.forget(12)
    learner.forget(999)
    learner.save(tmp_path / "a.ckpt")
    other = resumed(tmp_path / "a.ckpt", [label for label in stored if label.id != 12])
    assert [learner.update() for _ in range(5)] == [other.update() for _ in range(5)]


def test_a_long_step_pauses_for_proposals_which_change_nothing() -> None:
    """They are those of before the step; training goes on as without them."""
    disturbed, undisturbed = (seed(hidden_size=256, batch_size=256) for _ in range(2))
    assert isinstance(disturbed, Pausing)
    within: list[Suggestion] = []
    disturbed.pause = lambda: within.append(disturbed.propose(STATE, deterministic=True))
    for learner in (disturbed, undisturbed):
        learner.add(labels(10))
        learner.update()
    before = disturbed.propose(STATE, deterministic=True)
    seen = len(within)
    assert disturbed.update() == undisturbed.update()
    if kernels.onednn():  # elsewhere the networks go together, in one piece
        assert len(within) > seen
    assert all(suggestion == before for suggestion in within[seen:])
    for ours, theirs in zip(disturbed._networks.parameters(), undisturbed._networks.parameters(), strict=True):
        assert torch.equal(ours, theirs)


# --- the schedule


@pytest.mark.parametrize(
    ("frequency", "steps", "owed"), [(1, 5, [5, 10, 15, 20]), (2, 3, [0, 3, 3, 6]), (25, 30, [0, 0, 0, 0])]
)
def test_updates_are_owed_as_the_schedule_says(frequency: int, steps: int, owed: list[int]) -> None:
    learner = seed(train_frequency=frequency, gradient_steps=steps)
    seen = []
    for label in labels(4):
        learner.add([label])
        seen.append(learner.owed_updates)
    assert seen == owed


def test_the_schedule_counts_over_a_restart(tmp_path: Path) -> None:
    learner, stored = seed(train_frequency=25, gradient_steps=30), labels(25)
    learner.add(stored[:24])
    learner.save(tmp_path / "a.ckpt")
    other = resumed(tmp_path / "a.ckpt", stored[:24], train_frequency=25, gradient_steps=30)
    other.add(stored[24:])
    assert other.owed_updates == 30


def test_a_label_is_taken_once() -> None:
    learner, given = seed(), labels(3)
    learner.add(given)
    learner.add(given)
    learner.forget(2)
    learner.add(given)
    assert learner.owed_updates == 15
    assert learner.last_label_id == 3


def test_owed_steps_are_worked_off_before_spare_ones() -> None:
    learner = seed(gradient_steps=2, think_time_updates=3)
    learner.add(labels(1))
    left = []
    for _ in range(6):
        left.append((learner.owed_updates, learner.spare_updates))
        learner.update()
    assert left == [(2, 3), (1, 3), (0, 3), (0, 2), (0, 1), (0, 0)]
    assert learner.policy_version == 6


def test_think_time_is_off_unless_asked_for() -> None:
    learner = seed()
    learner.add(labels(10))
    assert learner.spare_updates == 0


def test_with_nothing_to_learn_from_nothing_is_owed() -> None:
    learner = seed()
    assert learner.update() is None
    learner.add(labels(1))
    learner.forget(1)
    assert learner.owed_updates == 5
    assert learner.update() is None
    assert learner.owed_updates == 0
    assert learner.policy_version == 0


def test_an_update_reports_what_it_did() -> None:
    learner = seed()
    learner.add(labels(10))
    metrics = learner.update()
    assert metrics is not None
    assert tuple(metrics) == METRICS
    assert all(np.isfinite(value) for value in metrics.values())
    assert metrics["skill_entropy"] == pytest.approx(np.log(3), abs=0.01), "a fresh skill actor has no favourite"


# --- every kind of task


@pytest.mark.parametrize("skills", [(RELEASE,), (PICK,), (RELEASE, PICK), (PICK, PUSH, RELEASE)])
def test_any_set_of_skills_works(skills: tuple[SkillSpec, ...], tmp_path: Path) -> None:
    learner = seed(*skills)
    learner.add(labels(30, skills=skills))
    work_off(learner)
    for suggestion in proposals(learner, 20):
        check_call(suggestion.call, skills)
        assert set(suggestion.skill_probabilities) == {s.name for s in skills}
        assert sum(suggestion.skill_probabilities.values()) == pytest.approx(1)
        assert suggestion.policy_version == 150
    learner.save(tmp_path / "a.ckpt")


def test_skills_are_sampled_in_the_reported_proportions() -> None:
    drawn = [s.call.skill for s in proposals(seed(), 600)]
    for skill in (PICK, PUSH, RELEASE):
        assert drawn.count(skill.name) / 600 == pytest.approx(1 / 3, abs=0.07)


# --- what makes no sense


@pytest.mark.parametrize("state", [np.array([0.0, np.nan, 0.0]), np.zeros(4)])
def test_a_bad_state_is_refused(state: Any) -> None:
    with pytest.raises(AgentError, match=r"block_position\[1\]|shape"):
        seed().propose(state)


def test_one_bad_label_spoils_its_batch_and_nothing_else() -> None:
    learner, given = seed(), labels(3)
    bad = dataclasses.replace(given[1], state=np.full(3, np.inf))
    with pytest.raises(AgentError, match="block_position"):
        learner.add([given[0], bad])
    assert (learner.owed_updates, learner.last_label_id) == (0, 0)
    learner.add(given)
    assert learner.owed_updates == 15


def test_divergence_is_told_and_leaves_the_networks_alone() -> None:
    learner = seed()
    learner.add(labels(10))
    with torch.no_grad():
        learner._networks.log_parameter_temperature.fill_(1e30)
    before = [p.clone() for p in learner._networks.parameters()]
    with pytest.raises(AgentError, match="diverged at gradient step 0") as error:
        learner.update()
    assert "learning_rate" in error.value.remedy
    assert all(torch.equal(a, b) for a, b in zip(before, learner._networks.parameters(), strict=True))


@pytest.mark.parametrize(
    ("other", "told"),
    [
        (problem(task="other"), "task"),
        (problem(PICK, RELEASE), "skills"),
        (problem(state_size=4), "state"),
    ],
)
def test_a_checkpoint_of_another_task_changes_nothing(tmp_path: Path, other: Problem, told: str) -> None:
    learner = seed()
    learner.add(labels(5))
    work_off(learner)
    learner.save(tmp_path / "a.ckpt")
    foreign, untouched = (SEED(other, SeedSettings(**SMALL), 4) for _ in range(2))
    with pytest.raises(CheckpointError, match=f"{told}: file has"):
        foreign.load(tmp_path / "a.ckpt")
    state = np.ones(len(other.state_low))
    assert foreign.propose(state) == untouched.propose(state)


def test_a_checkpoint_of_another_size_is_refused(tmp_path: Path) -> None:
    seed().save(tmp_path / "a.ckpt")
    with pytest.raises(CheckpointError, match="hidden: file has"):
        seed(hidden_size=16).load(tmp_path / "a.ckpt")


def test_another_learning_rate_is_no_reason_to_refuse(tmp_path: Path) -> None:
    learner = seed()
    learner.add(labels(5))
    work_off(learner)
    learner.save(tmp_path / "a.ckpt")
    other = resumed(tmp_path / "a.ckpt", labels(5), learning_rate=1e-4)
    assert other.propose(STATE) == learner.propose(STATE)
