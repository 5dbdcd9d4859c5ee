"""A gradient step for one learner, or for several of one shape in one pass; on the CPU or on a graphics card."""

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

    def __init__(self, learners: Sequence[Networks], objective: Objective, device: torch.device | None = None) -> None:
        """Elsewhere than where the networks are, twins of them learn, and after each step they hold the same.

        device: where the twins are; None: the networks themselves learn.
        """
        self.objective, self.device = objective, device
        self.learners = tuple(learners)
        there = self.learners if device is None else [networks.twin(device) for networks in self.learners]
        self.arena = Arena(there, objective.learning_rate)
        entropy = objective.parameter_entropy.to(self.arena.values.device)
        self._gradients = Gradients(self.arena, objective.skill_entropy, entropy)

    @classmethod
    def joined(cls, members: Sequence[tuple[Trainer, int]]) -> Trainer:
        """Take each member, given as its trainer and its place there, into one trainer with what Adam knows of it."""
        first, _ = members[0]
        trainer = cls([old.learners[at] for old, at in members], first.objective, first.device)
        for place, (old, at) in enumerate(members):
            trainer.recall(place, old.arena.moments(at))
        return trainer

    def recall(self, at: int, moments: Mapping[str, Mapping[str, Tensor]]) -> None:
        """Go on with learner `at` from what Adam knew of it, by parameter; of what isn't given, it knows nothing."""
        for name, kept in self.arena.moments(at).items():
            for key, value in moments.get(name, {}).items():
                kept[key].copy_(value)

    def step(
        self, drawn: Sequence[tuple[Batch, Tensor]], pause: Callable[[], None] = no_pause
    ) -> list[Mapping[str, float]]:
        """One step for every learner, each on its own batch and noise (O, B, P); the metrics of each.

        pause: called now and then before any weight changes: something may look at the networks meanwhile.

        Raises:
            AgentError: a learner's losses or gradients are no longer finite. The networks are as before this step.
        """
        metrics, total = self._gradients(_lesson(drawn).to(self.arena.values.device), pause)
        # finite losses may have gradients that aren't, and Adam squares them: one product of the flat vector finds both
        if not bool(torch.isfinite(total.sum() + self.arena.gradients.dot(self.arena.gradients))):
            raise AgentError(
                f"training diverged at gradient step {int(self.arena.state['step'])}",
                remedy="load the last checkpoint, or start anew with a lower learning_rate",
            )
        self.arena.descend()
        if self.device is not None:
            self._bring()
        return [dict(zip(METRICS, row, strict=True)) for row in metrics.tolist()]

    @torch.no_grad()
    def _bring(self) -> None:
        """Give the networks what their twins have learnt: those who propose read the networks, on the CPU."""
        brought = self.arena.values.cpu()  # at once: a transfer costs more than what it carries
        for at, networks in enumerate(self.learners):
            for name, parameter in networks.named_parameters():
                parameter.copy_(self.arena.block(name, brought)[at])


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
