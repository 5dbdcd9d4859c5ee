"""A gradient step for one learner, or for several of one shape in one pass."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from agent.algorithm import AgentError
from agent.arena import Arena
from agent.gradients import METRICS, Gradients, Lesson
from agent.kernels import no_pause
from agent.networks import Networks
from agent.replay import Batch


@dataclass(frozen=True)
class Objective:
    """What the actors' entropies are drawn to, and how fast everything learns.

    skill_entropy: nats. parameter_entropy: (O, 1) nats of each option's actor.
    """

    learning_rate: float
    skill_entropy: float
    parameter_entropy: Tensor


class Trainer:
    """Trains the networks of S learners that have taken equally many steps. They keep their own replays and dice."""

    def __init__(self, learners: Sequence[Networks], objective: Objective) -> None:
        self.objective = objective
        self.arena = Arena(learners, objective.learning_rate)
        self._gradients = Gradients(self.arena, objective.skill_entropy, objective.parameter_entropy)

    @classmethod
    def joined(cls, members: Sequence[tuple[Trainer, int]]) -> Trainer:
        """Take each member, given as its trainer and its place there, into one trainer with what Adam knows of it."""
        trainer = cls([old.arena.learners[at] for old, at in members], members[0][0].objective)
        for place, (old, at) in enumerate(members):
            for name, moments in old.arena.moments(at).items():
                for key, value in trainer.arena.moments(place)[name].items():
                    value.copy_(moments[key])
        return trainer

    def step(
        self, drawn: Sequence[tuple[Batch, Tensor]], pause: Callable[[], None] = no_pause
    ) -> list[Mapping[str, float]]:
        """One step for every learner, each on its own batch and noise (O, B, P); the metrics of each.

        pause: called now and then before any weight changes: something may look at the networks meanwhile.

        Raises:
            AgentError: a learner's losses are no longer finite. The networks are as before this step.
        """
        metrics, total = self._gradients(_lesson(drawn), pause)
        if not bool(torch.isfinite(total).all()):
            raise AgentError(
                f"training diverged at gradient step {int(self.arena.state['step'])}",
                remedy="load the last checkpoint, or start anew with a lower learning_rate",
            )
        self.arena.descend()
        return [dict(zip(METRICS, row, strict=True)) for row in metrics.tolist()]


def _lesson(drawn: Sequence[tuple[Batch, Tensor]]) -> Lesson:
    batches = [batch for batch, _ in drawn]

    def stacked(name: str) -> Tensor:
        columns = [getattr(batch, name) for batch in batches]
        return torch.from_numpy(columns[0][None] if len(columns) == 1 else np.stack(columns))

    return Lesson(
        states=stacked("states"),
        skills=stacked("skills"),
        parameters=stacked("parameters"),
        targets=stacked("targets"),
        keypoints=stacked("keypoints"),
        noise=torch.stack([noise for _, noise in drawn]),
    )
