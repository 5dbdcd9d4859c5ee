"""A course: one learner in one environment, decision by decision. Here: learners that choose skills."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Protocol

from agent.affordance import near
from agent.algorithm import Algorithm, Label, Problem, Suggestion
from agent.study.episodes import Counts, Done, SkillEpisodes, start_seed
from agent.study.labels import Labels
from robot_adapters.base import Adapter, Array, SkillCall
from robot_adapters.tasks.base import Task

LABELS = "labels.bin"


class Course(Protocol):
    """What a run does, whatever its algorithm."""

    counts: Counts

    @property
    def updates(self) -> int:
        """Gradient steps taken so far."""

    def decide(self) -> None:
        """One decision, and what follows from it. The training that it owes comes by `learn`."""

    def learn(self) -> None:
        """Take every gradient step that is owed."""

    def succeeds(self, seed: int) -> bool:
        """One rollout of the deterministic policy from the start that this seed gives; nothing is learned from it."""

    def save(self, learner: Path) -> Mapping[str, Any]:
        """Write the learner to a file; what else `load` needs, for JSON."""

    def load(self, learner: Path, saved: Mapping[str, Any]) -> None:
        """Go on from what `save` wrote and returned."""

    def close(self) -> None:
        """Release robots and files."""


class RewardLearner(Protocol):
    """A learner of skills from rewards (MAPLE)."""

    @property
    def policy_version(self) -> int:
        """Gradient steps taken so far."""

    @property
    def owed_updates(self) -> int:
        """Gradient steps owed and not yet taken."""

    def propose(self, state: Array, *, deterministic: bool = False) -> Suggestion:
        """Suggest a call."""

    def observe(self, state: Array, call: SkillCall, reward: float, next_state: Array, terminated: bool) -> None:
        """Take one transition."""

    def update(self) -> Mapping[str, float] | None:
        """One gradient step."""

    def save(self, path: Path) -> None:
        """Write a checkpoint."""

    def load(self, path: Path) -> None:
        """Read one."""


@dataclass(frozen=True)
class Stage:
    """Where skills are learned: two robots alike, one to train on and one to be evaluated on."""

    task: Task
    robot: Adapter
    judged_on: Adapter
    first_subgoal: bool
    seed: int
    folder: Path


class _SkillCourse:
    """What learners of skills share: episodes and counting."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._episodes = SkillEpisodes(stage.task, stage.robot, first_subgoal=stage.first_subgoal)
        self._judged = SkillEpisodes(stage.task, stage.judged_on, first_subgoal=stage.first_subgoal)
        self.counts = Counts()
        self._episodes.begin(start_seed(stage.seed, 0))

    def close(self) -> None:
        """Release the robots."""
        self._episodes.close()
        self._judged.close()

    def _execute(self, call: SkillCall) -> Done:
        """Run a skill, count it, and begin the next episode where this one is over."""
        done = self._episodes.execute(call)
        counts = self.counts
        counts.executions += 1
        counts.low_level_steps += done.low_level_steps
        counts.successes += done.success
        counts.violations += done.violations
        if done.over:
            counts.episodes += 1
            self._episodes.begin(start_seed(self._stage.seed, counts.episodes))
        return done

    def _saved(self) -> dict[str, Any]:
        return {"counts": asdict(self.counts), "episode": self._episodes.saved()}

    def _restore(self, saved: Mapping[str, Any]) -> None:
        self.counts = Counts(**saved["counts"])
        self._episodes.restore(int(saved["episode"]["seed"]), saved["episode"]["calls"])


class FeedbackCourse(_SkillCourse):
    """Algorithm 1 of the paper: propose, be judged, learn; only what was called good is executed."""

    def __init__(self, stage: Stage, learner: Algorithm, problem: Problem) -> None:
        super().__init__(stage)
        self.learner = learner
        self._problem = problem
        self._labels = Labels(stage.folder / LABELS, problem)

    @property
    def updates(self) -> int:
        """Gradient steps taken so far."""
        return self.learner.policy_version

    def decide(self) -> None:
        """One proposal and its feedback; carried out if that is good."""
        state = self._episodes.state
        call = self.learner.propose(state).call
        value = self._stage.task.judge(state, call)
        self.counts.decisions += 1
        label = Label(self.counts.decisions, state, call, value, near(self._problem, state, call))
        self._labels.append(label)
        self.learner.add([label])
        if value == 1:
            self._execute(call)

    def learn(self) -> None:
        """Take every gradient step that is owed."""
        while self.learner.owed_updates:
            self.learner.update()

    def succeeds(self, seed: int) -> bool:
        """One rollout of the deterministic policy."""
        return self._judged.rollout(seed, lambda state: self.learner.propose(state, deterministic=True).call)

    def save(self, learner: Path) -> Mapping[str, Any]:
        """Write the learner, and bring the labels to the disk."""
        self._labels.sync()
        self.learner.save(learner)
        return self._saved()

    def load(self, learner: Path, saved: Mapping[str, Any]) -> None:
        """Networks from the checkpoint; labels, which it doesn't hold, from their file."""
        self._restore(saved)
        self.learner.load(learner)
        self.learner.restore(self._labels.keep(self.counts.decisions))

    def close(self) -> None:
        """Release robots and file."""
        super().close()
        self._labels.close()


class RewardCourse(_SkillCourse):
    """Every proposed skill is executed; success is the reward (MAPLE). Its checkpoint holds its transitions."""

    def __init__(self, stage: Stage, learner: RewardLearner) -> None:
        super().__init__(stage)
        self._learner = learner

    @property
    def updates(self) -> int:
        """Gradient steps taken so far."""
        return self._learner.policy_version

    def decide(self) -> None:
        """One skill and its reward."""
        state = self._episodes.state
        call = self._learner.propose(state).call
        self.counts.decisions += 1
        done = self._execute(call)
        # the horizon and a violation cut the episode short; only success ends the task
        self._learner.observe(state, call, float(done.success), done.state, done.success)

    def learn(self) -> None:
        """Take every gradient step that is owed."""
        while self._learner.owed_updates:
            self._learner.update()

    def succeeds(self, seed: int) -> bool:
        """One rollout of the deterministic policy."""
        return self._judged.rollout(seed, lambda state: self._learner.propose(state, deterministic=True).call)

    def save(self, learner: Path) -> Mapping[str, Any]:
        """Write the learner with its transitions."""
        self._learner.save(learner)
        return self._saved()

    def load(self, learner: Path, saved: Mapping[str, Any]) -> None:
        """Go on from there."""
        self._restore(saved)
        self._learner.load(learner)
