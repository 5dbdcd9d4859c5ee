"""MAPLE: reinforcement learning over the same skills as SEED, paid by the environment alone.

A skill actor, a parameter actor a skill, and twin critics of (s, a, x) with slow targets (Nasiriany et al., 2022). The
networks and the actors' losses are SEED's (equations 2 and 3, with Q in the place of H); what differs is the critics'
target, which looks one skill call ahead. MAPLE-aff is the setting `affordance_penalty`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor

from agent import losses, td
from agent.affordance import near
from agent.algorithm import Label, Problem, Suggestion
from agent.baseline_config import MapleSettings
from agent.encoding import Encoder
from agent.gaussian import checked_reward
from agent.networks import Layout, Networks, dice
from agent.proposing import choose
from agent.resuming import Progress
from robot_adapters.base import Array, SkillCall

CRITICS = 2
EXPLORING_SKILL_ENTROPY = 0.97
"""Share of log(skills) that MAPLE asks of the skill actor while it explores; of a parameter actor it then asks 0."""
METRICS = (
    "critic_loss",
    "skill_actor_loss",
    "parameter_actor_loss",
    "skill_temperature",
    "parameter_temperature",
    "skill_entropy",
    "parameter_entropy",
    "target_mean",
)
"""What `Maple.update` reports, in order. Entropies in nats; a parameter's is over its range scaled to [-1, 1]."""


class Maple:
    """Suggests skill calls and learns from what they earned."""

    def __init__(self, problem: Problem, settings: MapleSettings, seed: int) -> None:
        """Start untrained.

        Raises:
            AgentError: the problem has no skills or no valid state bounds.
        """
        self._problem = problem
        self._settings = settings
        self._encoder = Encoder(problem)
        layout = Layout(self._encoder.state_size, self._encoder.parameter_counts)
        initial, proposing, training, drawing = np.random.SeedSequence(seed).spawn(4)
        start = dice(initial)
        self._networks, self._targets = (_networks(layout, settings, start) for _ in range(2))
        td.copy_weights(self._targets.critics, self._networks.critics)
        self._parameters = self._networks.mask.sum(dim=-1)  # (K, 1) how many each skill has
        n = layout.state_size
        self._progress = Progress(
            networks={"network": self._networks, "target": self._targets.critics},
            # every loss reaches its own weights only, so one optimiser and one backward pass serve them all
            optimiser=torch.optim.Adam(self._networks.parameters(), lr=settings.learning_rate, fused=True),
            memory=td.Memory(
                settings.replay_size, state=n, skill=0, parameters=layout.width, reward=0, next_state=n, terminated=0
            ),
            schedule=settings.schedule(),
            dice={"proposing": dice(proposing), "training": dice(training)},
            drawing=np.random.default_rng(drawing),
        )

    @property
    def policy_version(self) -> int:
        """Gradient steps taken so far."""
        return self._progress.version

    @property
    def owed_updates(self) -> int:
        """Gradient steps that the schedule asks for and that are not yet worked off."""
        return self._progress.schedule.owed

    def propose(self, state: Array, *, deterministic: bool = False) -> Suggestion:
        """A call for state (n,). `predicted_feedback` is here what the critics expect it to earn, Q(s, a, x).

        Raises:
            AgentError: the state has the wrong shape or holds a value that is not finite.
        """
        choice = choose(
            self._networks,
            self._encoder.state(state),
            self._encoder.keypoints(state),
            self._progress.dice["proposing"],
            deterministic=deterministic,
        )
        names = self._encoder.skill_names
        return Suggestion(
            call=self._encoder.call(choice.skill, choice.parameters),
            predicted_feedback=choice.predicted,
            skill_probabilities={name: float(p) for name, p in zip(names, choice.probabilities, strict=True)},
            policy_version=self.policy_version,
        )

    def observe(self, state: Array, call: SkillCall, reward: float, next_state: Array, terminated: bool) -> None:
        """Remember one executed call, and owe its gradient steps.

        reward: the environment's; the affordance penalty is taken off here. next_state: (n,) where the call led, before
        any reset. terminated: the task ended there; False where only the horizon cut the episode.

        Raises:
            AgentError: the call, a shape or a value doesn't fit the task. Nothing was remembered.
        """
        taken = self._encoder.entry(Label(0, state, call, 0), affordance_penalty=0.0)
        penalty = 0.0 if near(self._problem, state, call) else self._settings.affordance_penalty
        self._progress.memory.add(
            state=taken.state,
            skill=taken.skill,
            parameters=taken.parameters,
            reward=checked_reward(reward) - penalty,
            next_state=self._encoder.state(next_state),
            terminated=float(terminated),
        )
        self._progress.schedule.observed()

    def update(self) -> Mapping[str, float] | None:
        """One gradient step on critics, actors and temperatures; None before anything was observed.

        Raises:
            AgentError: losses or gradients are no longer finite. The networks are as before this step.
        """
        progress, networks, settings = self._progress, self._networks, self._settings
        if not progress.memory.size:
            return None
        batch = progress.memory.sample(settings.batch_size, progress.drawing)
        states, skills, parameters = batch["state"], batch["skill"].long(), batch["parameters"]
        skill_temperature = networks.log_skill_temperature.detach().exp()
        parameter_temperature = networks.log_parameter_temperature.detach().exp()

        with torch.no_grad():
            next_log_pi, imagined, density = self._imagine(batch["next_state"])
            next_values = td.soft_skill_value(
                self._targets.predict_every_skill(batch["next_state"], imagined),
                next_log_pi,
                density,
                skill_temperature,
                parameter_temperature,
            )
            targets = td.targets(batch["reward"], batch["terminated"], next_values, settings.discount)
        critic_loss = losses.critic_loss(networks.predict(states, skills, parameters), targets)

        # eq. 2 and 3 with Q in the place of H
        log_pi, imagined, density = self._imagine(states)
        predicted = networks.predict_every_skill(states, imagined)
        skill_loss = losses.skill_actor_loss(log_pi, predicted, skill_temperature)
        parameter_loss = losses.parameter_actor_loss(log_pi, density, predicted, parameter_temperature)
        skill_target, parameter_target = self._entropy_targets()
        temperature_loss = losses.skill_temperature_loss(
            networks.log_skill_temperature, log_pi, skill_target
        ) + losses.parameter_temperature_loss(networks.log_parameter_temperature, log_pi, density, parameter_target)

        progress.descend(critic_loss + skill_loss + parameter_loss + temperature_loss)
        td.follow(self._targets.critics, networks.critics, settings.target_rate)

        with torch.no_grad():
            reported = [
                critic_loss / CRITICS,
                skill_loss,
                parameter_loss,
                skill_temperature,
                parameter_temperature,
                losses.skill_entropy(log_pi).mean(),
                -(log_pi.exp().T * density).sum(dim=0).mean(),
                targets.mean(),
            ]
        return dict(zip(METRICS, torch.stack(reported).tolist(), strict=True))

    def save(self, path: Path) -> None:
        """Write networks, optimiser, transitions, random states and counters atomically."""
        self._progress.save(path, self._fingerprint())

    def load(self, path: Path) -> None:
        """Read what `save` wrote.

        Raises:
            CheckpointError: it is damaged or belongs to something else. Nothing has changed.
        """
        self._progress.load(path, self._fingerprint())

    def _imagine(self, states: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        """Log pi(a|s) (B, K); x_a ~ pi(.|s, a) for every skill (K, B, P), and its log density (K, B)."""
        networks = self._networks
        mean, log_std = networks.parameter_distributions(states)
        noise = torch.randn(mean.shape, generator=self._progress.dice["training"])
        imagined, density = losses.sample_parameters(mean, log_std, networks.mask, noise)
        return networks.skill_log_probabilities(states), imagined, density

    def _entropy_targets(self) -> tuple[float, Tensor]:
        """Of the skill actor, and of each parameter actor (K, 1), in nats."""
        settings, uniform = self._settings, math.log(len(self._problem.skills))
        if self.policy_version < settings.exploring_updates:
            return EXPLORING_SKILL_ENTROPY * uniform, torch.zeros_like(self._parameters)
        return settings.skill_entropy * uniform, settings.parameter_entropy * self._parameters

    def _fingerprint(self) -> Mapping[str, Any]:
        settings = self._settings
        hidden = [settings.hidden_size] * settings.hidden_layers
        penalty = settings.affordance_penalty
        return {"algorithm": "maple", **self._encoder.fingerprint(), "hidden": hidden, "affordance_penalty": penalty}


def _networks(layout: Layout, settings: MapleSettings, generator: torch.Generator) -> Networks:
    return Networks(
        layout,
        hidden=[settings.hidden_size] * settings.hidden_layers,
        critics=CRITICS,
        initial_temperature=settings.initial_temperature,
        generator=generator,
    )
