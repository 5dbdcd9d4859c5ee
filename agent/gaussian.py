"""A tanh-Gaussian actor with critics over low-level actions: what SAC and TAMER have in common.

Shapes: B states, n state entries, A action entries, E critics. Actions are in [-1, 1].
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import torch
from torch import Tensor, nn

from agent import losses
from agent.algorithm import AgentError, Problem
from agent.encoding import Encoder
from agent.networks import ACTOR_OUTPUT_RANGE, CRITIC_OUTPUT_RANGE, LOG_STD_MAX, LOG_STD_MIN, StackedMLP
from agent.replay import Float32
from robot_adapters.base import Array, ParameterSpec, SkillSpec


class Climb(NamedTuple):
    """The actor's loss, its temperature's, and the entropy in nats, each a number."""

    actor: Tensor
    temperature: Tensor
    entropy: Tensor


class GaussianActorCritic(nn.Module):
    """pi(u|s) and critics of (s, u), with the logarithm of the entropy's temperature."""

    def __init__(
        self,
        state_size: int,
        action_size: int,
        *,
        hidden: Sequence[int],
        critics: int,
        initial_temperature: float,
        generator: torch.Generator,
    ) -> None:
        super().__init__()
        self.actor = StackedMLP(1, [state_size, *hidden, 2 * action_size], ACTOR_OUTPUT_RANGE, generator)
        self.critics = StackedMLP(critics, [state_size + action_size, *hidden, 1], CRITIC_OUTPUT_RANGE, generator)
        self.log_temperature = nn.Parameter(torch.tensor(initial_temperature).log())
        self.mask: Tensor
        self.register_buffer("mask", torch.ones(1, 1, action_size), persistent=False)

    @torch.inference_mode()
    def act(self, state: Float32, generator: torch.Generator, *, deterministic: bool) -> Array:
        """(n,) scaled -> (A,): drawn from pi, or its middle, for which nothing is drawn from `generator`."""
        mean, log_std = self._distribution(torch.from_numpy(state).unsqueeze(0))
        noise = torch.zeros_like(mean) if deterministic else torch.randn(mean.shape, generator=generator)
        action: Float32 = torch.tanh(mean + log_std.exp() * noise)[0, 0].numpy()
        return action.astype(np.float64)

    def draw(self, states: Tensor, generator: torch.Generator) -> tuple[Tensor, Tensor]:
        """(B, n) -> u ~ pi(.|s) (B, A), through which gradients flow, and log pi(u|s) (B,)."""
        mean, log_std = self._distribution(states)
        noise = torch.randn(mean.shape, generator=generator)
        actions, density = losses.sample_parameters(mean, log_std, self.mask, noise)
        return actions[0], density[0]

    def values(self, states: Tensor, actions: Tensor, *, frozen: bool = False) -> Tensor:
        """What each critic says: (B, n), (B, A) -> (E, B). frozen: gradients reach the actions only."""
        return values_of(self.critics, states, actions, frozen=frozen)

    def climb(self, states: Tensor, generator: torch.Generator, target_entropy: float) -> Climb:
        """SAC's actor and temperature losses; the actor climbs the lowest critic under its entropy bonus.

        It is the parameter actors' loss (eq. 3) with one skill, which is certain.
        """
        actions, density = self.draw(states, generator)
        lowest = self.values(states, actions, frozen=True).amin(dim=0)
        certain = states.new_zeros(len(states), 1)
        target = states.new_full((1, 1), target_entropy)
        return Climb(
            losses.parameter_actor_loss(certain, density[None], lowest[None], self.log_temperature.exp()),
            losses.parameter_temperature_loss(self.log_temperature, certain, density[None], target),
            -density.detach().mean(),
        )

    def _distribution(self, states: Tensor) -> tuple[Tensor, Tensor]:
        mean, log_std = self.actor(states).chunk(2, dim=-1)
        return mean, log_std.clamp(LOG_STD_MIN, LOG_STD_MAX)


def values_of(critics: StackedMLP, states: Tensor, actions: Tensor, *, frozen: bool = False) -> Tensor:
    """What each of some critics says: (B, n), (B, A) -> (E, B)."""
    values: Tensor = critics(torch.cat([states, actions], dim=-1), frozen=frozen)
    return values.squeeze(-1)


def low_level_encoder(state_low: Array, state_high: Array, action_size: int) -> Encoder:
    """Checks and scales low-level states: to the encoder, an action is the one skill, with A parameters in [-1, 1].

    Raises:
        AgentError: the bounds don't fit, or there is no action.
    """
    if action_size < 1:
        raise AgentError(f"action_size is {action_size}", remedy="give the length of the environment's actions")
    entries = tuple(ParameterSpec(f"u{i}", "", -1.0, 1.0) for i in range(action_size))
    return Encoder(Problem("low_level", state_low, state_high, (SkillSpec("act", entries),)))


def checked_action(action: Array, size: int) -> Float32:
    """(A,) as it is stored, held within [-1, 1].

    Raises:
        AgentError: wrong shape, or an entry that is not finite.
    """
    action = np.asarray(action, dtype=np.float64)
    if action.shape != (size,) or not np.isfinite(action).all():
        raise AgentError(f"action is {action.tolist()}", remedy=f"give {size} finite numbers in [-1, 1], as `act` does")
    return np.clip(action, -1.0, 1.0).astype(np.float32)


def checked_reward(reward: float) -> float:
    """The reward itself.

    Raises:
        AgentError: it is not finite.
    """
    if not np.isfinite(reward):
        raise AgentError(f"reward is {reward}", remedy="give a finite number; check what computes it")
    return float(reward)
