"""SAC over low-level actions: the paper's first baseline, and the oracle that TAMER's labels come from.

Soft actor-critic with twin critics, slow targets and a learned temperature (Haarnoja et al., 2018, "Soft Actor-Critic
Algorithms and Applications"). It sees the paper's low-level state vectors and is paid by the environment alone.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import torch

from agent import losses, td
from agent.baseline_config import SacSettings
from agent.gaussian import GaussianActorCritic, checked_action, checked_reward, low_level_encoder, values_of
from agent.networks import CRITIC_OUTPUT_RANGE, StackedMLP, dice
from agent.resuming import Progress
from robot_adapters.base import Array

CRITICS = 2
METRICS = ("critic_loss", "actor_loss", "temperature", "entropy", "target_mean")
"""What `Sac.update` reports, in order. The entropy is in nats, over actions in [-1, 1]."""


class Sac:
    """state_low, state_high: (n,) usual bounds of the state, for scaling only. Actions are (action_size,) in [-1, 1].

    Acting and training draw from separate random states, so looking at the policy changes nothing that it learns.
    """

    def __init__(self, state_low: Array, state_high: Array, action_size: int, settings: SacSettings, seed: int) -> None:
        """Start untrained.

        Raises:
            AgentError: the bounds don't fit, or there is no action.
        """
        self._settings = settings
        self._encoder = low_level_encoder(state_low, state_high, action_size)
        self.action_size = action_size
        initial, acting, training, drawing = np.random.SeedSequence(seed).spawn(4)
        start, hidden = dice(initial), [settings.hidden_size] * settings.hidden_layers
        n = self._encoder.state_size
        self._networks = GaussianActorCritic(
            n,
            action_size,
            hidden=hidden,
            critics=CRITICS,
            initial_temperature=settings.initial_temperature,
            generator=start,
        )
        self._targets = StackedMLP(CRITICS, [n + action_size, *hidden, 1], CRITIC_OUTPUT_RANGE, start)
        td.copy_weights(self._targets, self._networks.critics)
        self._progress = Progress(
            networks={"network": self._networks, "target": self._targets},
            # every loss reaches its own weights only, so one optimiser and one backward pass serve them all
            optimiser=torch.optim.Adam(self._networks.parameters(), lr=settings.learning_rate, fused=True),
            memory=td.Memory(settings.replay_size, state=n, action=action_size, reward=0, next_state=n, terminated=0),
            schedule=settings.schedule(),
            dice={"acting": dice(acting), "training": dice(training)},
            drawing=np.random.default_rng(drawing),
        )

    @property
    def state_size(self) -> int:
        """How many entries a state has."""
        return self._encoder.state_size

    @property
    def policy_version(self) -> int:
        """Gradient steps taken so far."""
        return self._progress.version

    @property
    def owed_updates(self) -> int:
        """Gradient steps that the schedule asks for and that are not yet worked off."""
        return self._progress.schedule.owed

    def act(self, state: Array, *, deterministic: bool = False) -> Array:
        """An action (A,) in [-1, 1] for state (n,): drawn from the policy, or its middle.

        Raises:
            AgentError: the state has the wrong shape or holds a value that is not finite.
        """
        scaled = self._encoder.state(state)
        return self._networks.act(scaled, self._progress.dice["acting"], deterministic=deterministic)

    def observe(self, state: Array, action: Array, reward: float, next_state: Array, terminated: bool) -> None:
        """Remember one step, and owe its gradient steps.

        next_state: (n,) where the step led, before any reset. terminated: the task ended there; False where only the
        horizon cut the episode, as nothing in next_state says that no more reward can follow.

        Raises:
            AgentError: a shape is wrong or a value not finite. Nothing was remembered.
        """
        self._progress.memory.add(
            state=self._encoder.state(state),
            action=checked_action(action, self.action_size),
            reward=checked_reward(reward),
            next_state=self._encoder.state(next_state),
            terminated=float(terminated),
        )
        self._progress.schedule.observed()

    def update(self) -> Mapping[str, float] | None:
        """One gradient step on critics, actor and temperature; None before anything was observed.

        Raises:
            AgentError: losses or gradients are no longer finite. The networks are as before this step.
        """
        progress, networks, settings = self._progress, self._networks, self._settings
        if not progress.memory.size:
            return None
        batch = progress.memory.sample(settings.batch_size, progress.drawing)
        training = progress.dice["training"]
        temperature = networks.log_temperature.detach().exp()

        with torch.no_grad():
            next_actions, density = networks.draw(batch["next_state"], training)
            lowest = values_of(self._targets, batch["next_state"], next_actions).amin(dim=0)
            next_values = td.soft_value(lowest, density, temperature)
            targets = td.targets(batch["reward"], batch["terminated"], next_values, settings.discount)

        critic_loss = losses.critic_loss(networks.values(batch["state"], batch["action"]), targets)
        climb = networks.climb(batch["state"], training, settings.action_entropy * self.action_size)
        progress.descend(critic_loss + climb.actor + climb.temperature)
        td.follow(self._targets, networks.critics, settings.target_rate)

        reported = torch.stack([critic_loss / CRITICS, climb.actor, temperature, climb.entropy, targets.mean()])
        return dict(zip(METRICS, reported.tolist(), strict=True))

    @torch.inference_mode()
    def values(self, state: Array, actions: Array) -> Array:
        """The lower critic's Q(s, u) for state (n,) and each of some actions (k, A) -> (k,).

        Raises:
            AgentError: a shape is wrong or a value not finite.
        """
        stored = np.stack([checked_action(action, self.action_size) for action in actions])
        states = torch.from_numpy(self._encoder.state(state)).expand(len(stored), -1)
        lowest: Array = self._networks.values(states, torch.from_numpy(stored)).amin(dim=0).double().numpy()
        return lowest

    def digest(self) -> str:
        """SHA-256 of the networks: which critic it is that judges."""
        digest = hashlib.sha256()
        for tensor in self._networks.parameters():
            digest.update(tensor.detach().numpy().tobytes())
        return digest.hexdigest()

    def save(self, path: Path) -> None:
        """Write networks, optimiser, transitions, random states and counters atomically."""
        self._progress.save(path, self._fingerprint())

    def load(self, path: Path) -> None:
        """Read what `save` wrote.

        Raises:
            CheckpointError: it is damaged or belongs to something else. Nothing has changed.
        """
        self._progress.load(path, self._fingerprint())

    def _fingerprint(self) -> Mapping[str, Any]:
        settings = self._settings
        hidden = [settings.hidden_size] * settings.hidden_layers
        return {"algorithm": "sac", **self._encoder.fingerprint(), "hidden": hidden}
