"""TAMER+SAC: the paper's low-level baseline from evaluative feedback.

SAC's critic is replaced with one that regresses what a trainer says of every single low-level action (Knox and Stone,
2009; paper, section "Baselines"). No next state is looked at, so there are no targets and the discount has no effect.
The trainer is an oracle: a trained SAC agent that calls an action good when its Q function says that it is about as
good as the oracle's own (paper, "Synthetic human feedback in simulation").
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor

from agent import losses, td
from agent.algorithm import AgentError
from agent.baseline_config import TamerSettings
from agent.gaussian import GaussianActorCritic, checked_action, checked_reward, low_level_encoder
from agent.networks import dice
from agent.replay import shares
from agent.resuming import Progress
from agent.sac import Sac
from robot_adapters.base import Array

METRICS = ("critic_loss", "actor_loss", "temperature", "entropy", "good_share")
"""What `Tamer.update` reports, in order. The entropy is in nats; good_share is of all labels remembered."""


def judge(value: float, best: float, strictness: float) -> int:
    """The oracle's label of an action with Q(s, u) = value, where its own action has Q(s, u*) = best: +1 or -1.

    The paper says: +1 iff Q(s, u) >= alpha Q(s, u*), alpha just below 1. That allows an action to be worse than the
    oracle's by the share 1 - alpha, as long as Q(s, u*) is positive. For a negative one alpha Q(s, u*) lies *above*
    Q(s, u*): the oracle would refuse its own action, and a stricter alpha would accept more. Soft Q values are often
    negative, so what is kept is the meaning, a shortfall of at most (1 - alpha) |Q(s, u*)|: the same for a positive Q.
    """
    return 1 if value >= best - (1.0 - strictness) * abs(best) else -1


class Tamer:
    """state_low, state_high: (n,) usual bounds of the state, for scaling. Actions are (action_size,) in [-1, 1]."""

    def __init__(
        self, state_low: Array, state_high: Array, action_size: int, settings: TamerSettings, seed: int, *, oracle: Sac
    ) -> None:
        """Start untrained, to be judged by `oracle`, whose training should be over.

        Raises:
            AgentError: the bounds don't fit, there is no action, or the oracle is for states or actions of other sizes.
        """
        self._settings = settings
        self._encoder = low_level_encoder(state_low, state_high, action_size)
        n = self._encoder.state_size
        if (oracle.state_size, oracle.action_size) != (n, action_size):
            raise AgentError(
                f"the oracle knows states of {oracle.state_size} and actions of {oracle.action_size} entries,"
                f" not {n} and {action_size}",
                remedy="give a SAC agent that was trained on the same task",
            )
        self._oracle = oracle
        self._judged_by = oracle.digest()
        self.action_size = action_size
        initial, acting, training, drawing = np.random.SeedSequence(seed).spawn(4)
        self._networks = GaussianActorCritic(
            n,
            action_size,
            hidden=[settings.hidden_size] * settings.hidden_layers,
            critics=settings.critics,
            initial_temperature=settings.initial_temperature,
            generator=dice(initial),
        )
        self._progress = Progress(
            networks={"network": self._networks},
            optimiser=torch.optim.Adam(self._networks.parameters(), lr=settings.learning_rate, fused=True),
            memory=td.Memory(settings.replay_size, state=n, action=action_size, label=0, reward=0),
            schedule=settings.schedule(),
            dice={"acting": dice(acting), "training": dice(training)},
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

    @property
    def strictness(self) -> float:
        """The oracle's alpha now: it rises linearly with the labels given."""
        settings = self._settings
        part = min(1.0, self._progress.schedule.seen / settings.strictness_labels)
        return settings.strictness + part * (settings.final_strictness - settings.strictness)

    def act(self, state: Array, *, deterministic: bool = False) -> Array:
        """An action (A,) in [-1, 1] for state (n,): drawn from the policy, or its middle.

        Raises:
            AgentError: the state has the wrong shape or holds a value that is not finite.
        """
        scaled = self._encoder.state(state)
        return self._networks.act(scaled, self._progress.dice["acting"], deterministic=deterministic)

    def observe(self, state: Array, action: Array, reward: float = 0.0) -> int:
        """Have one step judged, remember it, owe its gradient steps, and return the label.

        reward: the environment's, which the critic's target has on top of the label: the paper trains on "dense human
        rewards and sparse environment rewards".

        Raises:
            AgentError: a shape is wrong or a value not finite. Nothing was remembered.
        """
        own = self._oracle.act(state, deterministic=True)
        value, best = self._oracle.values(state, np.stack([np.asarray(action, dtype=np.float64), own]))
        label = judge(float(value), float(best), self.strictness)
        self._progress.memory.add(
            state=self._encoder.state(state),
            action=checked_action(action, self.action_size),
            label=label,
            reward=checked_reward(reward),
        )
        self._progress.schedule.observed()
        return label

    def update(self) -> Mapping[str, float] | None:
        """One gradient step on critic, actor and temperature; None before anything was observed.

        Raises:
            AgentError: losses or gradients are no longer finite. The networks are as before this step.
        """
        progress, networks, settings = self._progress, self._networks, self._settings
        if not progress.memory.size:
            return None
        batch, good_share = self._balanced()
        targets = batch["label"] + batch["reward"]
        critic_loss = losses.critic_loss(networks.values(batch["state"], batch["action"]), targets)  # eq. 1
        target_entropy = settings.action_entropy * self.action_size
        climb = networks.climb(batch["state"], progress.dice["training"], target_entropy)
        temperature = networks.log_temperature.detach().exp()
        progress.descend(critic_loss + climb.actor + climb.temperature)
        reported = torch.stack(
            [critic_loss / settings.critics, climb.actor, temperature, climb.entropy, torch.tensor(good_share)]
        )
        return dict(zip(METRICS, reported.tolist(), strict=True))

    def save(self, path: Path) -> None:
        """Write networks, optimiser, labels, random states and counters atomically; the oracle isn't written."""
        self._progress.save(path, self._fingerprint())

    def load(self, path: Path) -> None:
        """Read what `save` wrote under the same oracle.

        Raises:
            CheckpointError: it is damaged or belongs to something else. Nothing has changed.
        """
        self._progress.load(path, self._fingerprint())

    def _balanced(self) -> tuple[dict[str, Tensor], float]:
        """A batch, half good and half bad where there are both, as SEED's; and the share of good labels."""
        memory, drawing = self._progress.memory, self._progress.drawing
        good = memory.column("label") > 0
        rows = {1: np.flatnonzero(good), -1: np.flatnonzero(~good)}
        wanted = shares({1: len(rows[1]), 0: 0, -1: len(rows[-1])}, self._settings.batch_size)
        drawn = [found[drawing.integers(len(found), size=wanted[v])] for v, found in rows.items() if wanted[v]]
        return memory.rows(np.concatenate(drawn)), float(good.mean())

    def _fingerprint(self) -> Mapping[str, Any]:
        settings = self._settings
        hidden = [settings.hidden_size] * settings.hidden_layers
        return {
            "algorithm": "tamer",
            **self._encoder.fingerprint(),
            "hidden": hidden,
            "critics": settings.critics,
            "oracle": self._judged_by,
        }
