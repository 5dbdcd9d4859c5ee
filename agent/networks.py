"""Skill actor, parameter actors and human critic as stacks of small networks evaluated together.

Shapes: B states, n state entries, K skills, P parameters of the longest skill, E critics, O options. An option is what
the skill actor chooses and a parameter actor fills in: a skill, or with a grounded actor a skill at one of its key
points (`agent.grounding`). Without one, options and skills are the same, as in the paper.
"""

from __future__ import annotations

import copy
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn

from agent.grounding import Grounding

LOG_STD_MIN, LOG_STD_MAX = -20.0, 2.0  # SAC's and MAPLE's bounds
LOGIT_BOUND = 10.0  # MAPLE: keeps every skill's probability above zero
ACTOR_OUTPUT_RANGE = 1e-3  # MAPLE: a fresh actor is near uniform over skills and centred in the workspace
CRITIC_OUTPUT_RANGE = 3e-3  # MAPLE


def dice(seed: np.random.SeedSequence) -> torch.Generator:
    """Torch's random state for a seed."""
    return torch.Generator().manual_seed(int(seed.generate_state(1, np.uint32)[0]))


class StackedMLP(nn.Module):
    """`count` networks of the same shape with ReLU, run as one batched product a layer.

    sizes: input, hidden ..., output. output_range: bound of the last layer's initial weights.
    """

    def __init__(self, count: int, sizes: Sequence[int], output_range: float, generator: torch.Generator) -> None:
        super().__init__()
        self.weights = nn.ParameterList()
        self.biases = nn.ParameterList()
        layers = list(pairwise(sizes))
        for index, (fan_in, fan_out) in enumerate(layers):
            bound = output_range if index == len(layers) - 1 else fan_in**-0.5
            weight = torch.empty(count, fan_in, fan_out).uniform_(-bound, bound, generator=generator)
            self.weights.append(nn.Parameter(weight))
            self.biases.append(nn.Parameter(torch.zeros(count, 1, fan_out)))

    def forward(self, x: Tensor, *, frozen: bool = False) -> Tensor:
        """(B, input), the same for every network -> (count, B, output).

        frozen: gradients reach `x` but not the weights, so that one backward pass can serve actors and critic.
        """
        weights = [w.detach() for w in self.weights] if frozen else list(self.weights)
        biases = [b.detach() for b in self.biases] if frozen else list(self.biases)
        h = x.expand(weights[0].shape[0], *x.shape)
        for weight, bias in zip(weights[:-1], biases[:-1], strict=True):
            h = torch.baddbmm(bias, h, weight).relu_()  # in place: half the memory traffic
        return torch.baddbmm(biases[-1], h, weights[-1])


@dataclass(frozen=True)
class Layout:
    """Sizes of a task's networks. parameter_counts: parameters of each skill, K entries."""

    state_size: int
    parameter_counts: tuple[int, ...]

    @property
    def skills(self) -> int:
        """K."""
        return len(self.parameter_counts)

    @property
    def width(self) -> int:
        """P, at least 1: a task whose skills take no parameters has one padded column."""
        return max(1, *self.parameter_counts)

    def mask(self) -> Tensor:
        """(K, 1, P) 1 where a skill has that parameter, 0 where the vector is padded."""
        rows = [[1.0] * count + [0.0] * (self.width - count) for count in self.parameter_counts]
        return torch.tensor(rows).unsqueeze(1)


class Networks(nn.Module):
    """Everything SEED learns: actors, critics and the logarithms of both temperatures (figure 2 of the paper)."""

    def __init__(
        self,
        layout: Layout,
        *,
        hidden: Sequence[int],
        critics: int,
        initial_temperature: float,
        generator: torch.Generator,
        grounding: Grounding | None = None,
    ) -> None:
        super().__init__()
        n, K, P = layout.state_size, layout.skills, layout.width
        options, features = (grounding.options, grounding.features) if grounding else (K, 0)
        self.layout = layout
        self.grounding = grounding
        self.option_skill = grounding.option_skill if grounding else torch.arange(K)
        self.skill_actor = StackedMLP(1, [n, *hidden, options], ACTOR_OUTPUT_RANGE, generator)
        self.parameter_actors = StackedMLP(options, [n, *hidden, 2 * P], ACTOR_OUTPUT_RANGE, generator)
        self.critics = StackedMLP(critics, [n + K + P + features, *hidden, 1], CRITIC_OUTPUT_RANGE, generator)
        log_temperature = torch.tensor(initial_temperature).log()
        self.log_skill_temperature = nn.Parameter(log_temperature.clone())
        self.log_parameter_temperature = nn.Parameter(log_temperature.clone())
        self.mask: Tensor
        self.one_hot: Tensor
        self.register_buffer("mask", layout.mask()[self.option_skill], persistent=False)
        self.register_buffer("one_hot", torch.eye(K), persistent=False)

    def twin(self, device: torch.device) -> Networks:
        """Networks there that begin with the same weights. Constants may be shared."""
        memo: dict[int, Any] = {id(part): part.to(device) for part in (self.mask, self.one_hot, self.option_skill)}
        if self.grounding is not None:
            memo[id(self.grounding)] = self.grounding.to(device)
        memo |= {id(p): nn.Parameter(p.detach().to(device, copy=True)) for p in self.parameters()}
        return copy.deepcopy(self, memo)

    def skill_log_probabilities(self, states: Tensor) -> Tensor:
        """(B, n) -> (B, O) log pi_phi(a|s)."""
        logits = self.skill_actor(states)[0].clamp(-LOGIT_BOUND, LOGIT_BOUND)
        return torch.log_softmax(logits, dim=-1)

    def parameter_distributions(self, states: Tensor) -> tuple[Tensor, Tensor]:
        """(B, n) -> mean and log standard deviation (O, B, P) before tanh; padded columns are meaningless."""
        mean, log_std = self.parameter_actors(states).chunk(2, dim=-1)
        return mean, log_std.clamp(LOG_STD_MIN, LOG_STD_MAX)

    def predict(self, states: Tensor, skills: Tensor, parameters: Tensor, keypoints: Tensor | None = None) -> Tensor:
        """H_theta(s, a, x) of each critic: (B, n), (B,) indices, (B, P) in [-1, 1], padded with 0 -> (E, B)."""
        predicted: Tensor = self.critics(self.critic_inputs(states, skills, parameters, keypoints))
        return predicted.squeeze(-1)

    def predict_every_skill(self, states: Tensor, local: Tensor, keypoints: Tensor | None = None) -> Tensor:
        """The lowest H_theta(s, a, x_a) for every option: (B, n), (O, B, P) -> (O, B). The critics get no gradient.

        local: as the parameter actors put it out. keypoints: (B, K, M, 3), where the grounding has any.
        """
        count, B = local.shape[0], states.shape[0]
        parameters = self.decode(local, keypoints)
        predicted: Tensor = self.critics(
            self.critic_inputs(
                states.expand(count, B, -1).reshape(count * B, -1),
                self.option_skill.repeat_interleave(B),
                parameters.reshape(count * B, -1),
                None if keypoints is None else keypoints.expand(count, *keypoints.shape).flatten(0, 1),
            ),
            frozen=True,
        )
        return predicted.squeeze(-1).amin(dim=0).view(count, B)

    def decode(self, local: Tensor, keypoints: Tensor | None) -> Tensor:
        """(O, B, P) of the parameter actors -> (O, B, P) parameters scaled as the skill's bounds are."""
        if self.grounding is None or keypoints is None or not keypoints.numel():
            return local
        return self.grounding.decode(local, keypoints) * self.mask

    def critic_inputs(self, states: Tensor, skills: Tensor, parameters: Tensor, keypoints: Tensor | None) -> Tensor:
        """What the critics read of calls: as `predict` takes them -> (B, n + K + P + features)."""
        parts = [states, self.one_hot[skills], parameters]
        if self.grounding is not None and self.grounding.features and keypoints is not None:
            parts.append(self.grounding.read(skills, parameters, keypoints))
        return torch.cat(parts, dim=-1)
