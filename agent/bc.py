"""Behaviour cloning on skill calls: SEED's actors, fitted to demonstrations by maximum likelihood.

The networks, their encoding and grounding and the augmentation are SEED's own, so that what is compared is the data
and the loss. There is no critic in the loss: a demonstration says what was done, not how good it was.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from agent import losses
from agent.algorithm import Label, Problem
from agent.config import SeedSettings
from agent.encoding import Encoder
from agent.grounding import grounding
from agent.networks import Layout, Networks
from agent.replay import Batch, Replay
from agent.symmetry import symmetries
from robot_adapters.base import Array, SkillCall

INSIDE = 0.999
"""Local parameters are kept this far inside [-1, 1], where the inverse of tanh is finite."""
STD_MIN = 0.02
"""Smallest standard deviation of a parameter before tanh: the likelihood of calls that are all alike has no maximum."""


@dataclass(frozen=True)
class Demonstration:
    """A call that was shown in state (n,)."""

    state: Array
    call: SkillCall


class Cloning:
    """Actors that do as was shown. settings: those of SEED that are about networks, key points and augmentation."""

    def __init__(self, problem: Problem, settings: SeedSettings, seed: int) -> None:
        self._settings = settings
        self._encoder = Encoder(problem, keypoints=settings.keypoints)
        self._rng = np.random.default_rng(seed)
        self._grounding = grounding(
            problem.skills,
            self._encoder.keypoint_counts,
            grounded=settings.grounded_actor,
            relative=False,
            radius=settings.grounding_radius,
        )
        self._networks = Networks(
            Layout(self._encoder.state_size, self._encoder.parameter_counts),
            hidden=[settings.hidden_size] * settings.hidden_layers,
            critics=1,
            initial_temperature=1.0,
            generator=torch.Generator().manual_seed(seed),
            grounding=self._grounding,
        )
        actors = [*self._networks.skill_actor.parameters(), *self._networks.parameter_actors.parameters()]
        self._optimiser = torch.optim.Adam(actors, lr=settings.learning_rate)
        self._symmetries = symmetries(problem, settings, self._encoder)

    def fit(self, shown: Sequence[Demonstration], steps: int) -> list[float]:
        """So many gradient steps on the negative log-likelihood; the loss of each, in nats.

        Raises:
            AgentError: a demonstration doesn't fit the task.
        """
        entries = [
            self._encoder.entry(Label(number, d.state, d.call, 1), affordance_penalty=0.0)
            for number, d in enumerate(shown, start=1)
        ]
        replay = Replay(len(entries[0].state), len(entries[0].parameters), self._encoder.keypoint_shape)
        for entry in entries:
            replay.add(entry)
        return [self._step(replay.sample(self._settings.batch_size, self._rng)) for _ in range(steps)]

    @torch.inference_mode()
    def propose(self, state: Array) -> SkillCall:
        """The likeliest skill (at the likeliest key point), and the middle of its parameters."""
        states = torch.from_numpy(self._encoder.state(state)).unsqueeze(0)
        keypoints = torch.from_numpy(self._encoder.keypoints(state)).unsqueeze(0)
        option = int(self._networks.skill_log_probabilities(states)[0].argmax())
        mean, _ = self._networks.parameter_distributions(states)
        parameters = self._networks.decode(torch.tanh(mean), keypoints)[option, 0].clamp(-1.0, 1.0)
        return self._encoder.call(int(self._networks.option_skill[option]), parameters.double().numpy())

    def log_likelihood(self, batch: Batch) -> Tensor:
        """(B,) nats: log pi(a|s) + log pi(x|s, a), where a call belongs to the key point that it is nearest to."""
        if self._symmetries is not None:
            batch = self._symmetries.applied(batch, self._rng)
        states, skills, parameters, keypoints = map(
            torch.from_numpy, (batch.states, batch.skills, batch.parameters, batch.keypoints)
        )
        options, local = self._grounding.encode(skills, parameters, keypoints)
        rows = torch.arange(len(options))
        mean, log_std = (part[options, rows] for part in self._networks.parameter_distributions(states))
        before = torch.atanh(local.clamp(-INSIDE, INSIDE))
        log_std = log_std.clamp(min=float(np.log(STD_MIN)))
        mask = self._networks.mask[options, 0]
        log_pi_x = losses.tanh_gaussian_log_probability(before, (before - mean) / log_std.exp(), log_std, mask)
        return self._networks.skill_log_probabilities(states)[rows, options] + log_pi_x

    def _step(self, batch: Batch) -> float:
        loss = -self.log_likelihood(batch).mean()
        self._optimiser.zero_grad()
        loss.backward()  # type: ignore[no-untyped-call]
        self._optimiser.step()
        return loss.item()
