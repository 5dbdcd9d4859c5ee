"""Several SEED learners of one task and setting, which differ in their seeds, trained in one pass.

Each keeps its own weights, labels and dice, so it learns what it would learn alone (to rounding). What they share is
the pass: the same layer of all learners is one batch of matrices, and the many small operations of a step, which cost
small networks most, are called once.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from agent.algorithm import Problem
from agent.config import SeedSettings
from agent.seed import Seed
from agent.training import Trainer


class StackedSeeds:
    """Learners by place, in the order of their seeds. Give labels and ask for proposals through `learners`."""

    def __init__(self, learners: Sequence[Seed]) -> None:
        """Take learners of one task and setting, fresh or trained, alone or together with others until now."""
        self.learners = tuple(learners)

    @classmethod
    def fresh(cls, problem: Problem, settings: SeedSettings, seeds: Sequence[int]) -> StackedSeeds:
        """New ones."""
        return cls([Seed(problem, settings, seed) for seed in seeds])

    @property
    def owed_updates(self) -> int:
        """Gradient steps of the learner that owes most."""
        return max((learner.owed_updates for learner in self.learners), default=0)

    def update(self) -> list[Mapping[str, float] | None]:
        """One gradient step for each learner that owes one; its metrics, None for the others.

        Those that have taken equally many steps share a pass. A learner that is done, or has no labels, holds nobody
        up.

        Raises:
            AgentError: losses or gradients of a learner are no longer finite. Those it shares its pass with have not
                stepped.
        """
        told: list[Mapping[str, float] | None] = [None] * len(self.learners)
        for places in self._level():
            learners = [self.learners[place] for place in places]
            trainer = self._together(learners)
            metrics = trainer.step(Seed.drawn(learners))
            for place, learner, found in zip(places, learners, metrics, strict=True):
                learner.stepped()
                told[place] = found
        return told

    def work_off(self) -> None:
        """Take every step that is owed.

        Raises:
            AgentError: as `update`.
        """
        while self.owed_updates:
            self.update()

    def _level(self) -> list[list[int]]:
        """Places of the learners that owe a step, by how many they have taken."""
        levels: dict[int, list[int]] = {}
        for place, learner in enumerate(self.learners):
            if learner.owed_updates and learner.ready():
                levels.setdefault(learner.policy_version, []).append(place)
        return list(levels.values())

    def _together(self, learners: Sequence[Seed]) -> Trainer:
        """The one that trains exactly these: theirs, or a new one that they move to."""
        trainer, _ = learners[0].seat
        wanted = [(trainer, place) for place in range(len(trainer.arena.learners))]
        if [learner.seat for learner in learners] == wanted:
            return trainer
        trainer = Trainer.joined([learner.seat for learner in learners])
        for place, learner in enumerate(learners):
            learner.settle(trainer, place)
        return trainer
