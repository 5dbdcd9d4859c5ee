"""The gradients of SEED's losses (`agent.losses`), worked out by hand for S learners at once.

Written out, large networks can go in pieces that stay in the cache, by the quickest products (`agent.kernels`), and
several learners in one pass; a test holds the gradients to autograd's. For one state, with p = pi_phi(a|s),
h_a = min over critics of H(s, a, x_a), alpha temperatures:

  eq. 1  d/dH          2 (H - label) / B
  eq. 2  d/dlogit_a    p_a [(alpha_phi log p_a - h_a) - sum_b p_b (alpha_phi log p_b - h_b)] / B
  eq. 3  d/dH_a        -p_a / B  for the lowest critic, through the frozen critics into x_a
         u = mean + std * noise, x = tanh(u), d log pi(x)/du = 2 tanh(u), d log pi(x)/dlog_std = -1
         d/dmean       p_a alpha_psi 2 x / B + dH/dx (1 - x^2)
         d/dlog_std    d/dmean * std * noise - p_a alpha_psi / B
  d/dlog alpha         entropy - target, mean over states; a parameter actor's weighted by p_a

Shapes: S learners, B labels each, O options, P parameters, E critics, n state entries, K skills, M key points.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import torch
from torch import Tensor

from agent import kernels, losses
from agent.arena import Arena, Stack
from agent.imagining import Back, Imagining
from agent.networks import LOG_STD_MAX, LOG_STD_MIN, LOGIT_BOUND

METRICS = (
    "critic_loss",
    "skill_actor_loss",
    "parameter_actor_loss",
    "skill_temperature",
    "parameter_temperature",
    "skill_entropy",
    "parameter_entropy",
)
"""What a step reports, in order. Entropies in nats; a parameter's is over its range scaled to [-1, 1]."""


@dataclass(frozen=True)
class Lesson:
    """What one step learns from.

    states (S, B, n), skills (S, B), parameters (S, B, P) and targets (S, B) of the labels, keypoints (S, B, K, M, 3) m,
    noise (S, O, B, P) standard normal, for the imagined parameters.
    """

    states: Tensor
    skills: Tensor
    parameters: Tensor
    targets: Tensor
    keypoints: Tensor
    noise: Tensor

    def to(self, device: torch.device) -> Lesson:
        """The same there."""
        return Lesson(**{name: tensor.to(device) for name, tensor in vars(self).items()})


class Gradients:
    """Writes into an arena's gradients what autograd would find, and returns the metrics."""

    def __init__(self, arena: Arena, skill_entropy_target: float, parameter_entropy_target: Tensor) -> None:
        """parameter_entropy_target: (O, 1)."""
        networks = arena.learners[0]
        self._networks = networks
        self._size = len(arena.learners)
        self._imagining = Imagining(networks.grounding) if networks.grounding is not None else None
        self._skill_actor, self._parameter_actors, self._critics = (
            Stack(arena, name) for name in ("skill_actor", "parameter_actors", "critics")
        )
        names = ("log_skill_temperature", "log_parameter_temperature")
        self._log_temperatures = [arena.block(name) for name in names]
        self._temperature_gradients = [arena.block(name, arena.gradients) for name in names]
        self._targets = skill_entropy_target, parameter_entropy_target

    @torch.no_grad()
    def __call__(self, lesson: Lesson, pause: Callable[[], None] = kernels.no_pause) -> tuple[Tensor, Tensor]:
        """(S, 7) `METRICS`, and (S,) the total loss, not finite where training diverged.

        pause: called now and then, so that something else may be done; no weight changes here.
        """
        S, B, _ = lesson.states.shape
        mask = self._networks.mask
        O, _, P = mask.shape  # noqa: E741 - as in the docstring
        skill_alpha, parameter_alpha = (log.exp().view(S, 1, 1) for log in self._log_temperatures)

        # the actors, (S, O, B, ...)
        states = lesson.states.unsqueeze(1)
        skill_pass = self._skill_actor.forward(states, learnt=B, pause=pause)
        actor_pass = self._parameter_actors.forward(states, learnt=B, pause=pause)
        logits = skill_pass.output.transpose(1, 2)
        log_pi = torch.log_softmax(logits.clamp(-LOGIT_BOUND, LOGIT_BOUND), dim=1)
        pi = log_pi.exp()
        mean, raw_log_std = actor_pass.output.view(S, O, B, 2 * P).chunk(2, dim=-1)
        log_std = raw_log_std.clamp(LOG_STD_MIN, LOG_STD_MAX)
        deviation = log_std.exp() * lesson.noise
        before = mean + deviation
        x = torch.tanh(before) * mask
        log_pi_x = losses.tanh_gaussian_log_probability(before, lesson.noise, log_std, mask)

        # the critics judge the labels' calls and the imagined ones in one pass
        imagined, pulled_back = self._imagined(x, lesson.keypoints)
        critic_pass = self._critics.forward(self._inputs(lesson, imagined), learnt=B, pause=pause)
        predicted = critic_pass.output.view(S, -1, 1 + O, B)
        error = predicted[:, :, 0] - lesson.targets.unsqueeze(1)
        every = predicted[:, :, 1:]
        h = every.amin(dim=1)

        # eq. 2
        inside = skill_alpha * log_pi - h
        by_state = (pi * inside).sum(dim=1, keepdim=True)
        by_logits = pi * (inside - by_state) * ((logits.abs() <= LOGIT_BOUND) / B)
        self._skill_actor.backward(skill_pass, by_logits.transpose(1, 2))

        # eq. 1 and 3 meet at the critics' output
        share = pi / B
        lowest = (every == h.unsqueeze(1)).to(h.dtype)
        lowest /= lowest.sum(dim=1, keepdim=True)
        by_predicted = torch.cat([error.unsqueeze(2) * (2 / B), -share.unsqueeze(1) * lowest], dim=2)
        columns = slice(lesson.states.shape[-1] + self._networks.layout.skills, None)
        by_imagined = self._critics.backward(critic_pass, by_predicted.view(-1, (1 + O) * B, 1), columns)
        assert by_imagined is not None  # columns were asked for
        by_x = pulled_back(by_imagined.view(S, -1, O, B, by_imagined.shape[-1]).sum(dim=1)) * mask

        # eq. 3
        bonus = (share * parameter_alpha).unsqueeze(-1) * mask
        by_mean = 2 * bonus * x + by_x * (1 - x.square())
        within = (raw_log_std >= LOG_STD_MIN) & (raw_log_std <= LOG_STD_MAX)
        by_log_std = (by_mean * deviation - bonus) * within
        self._parameter_actors.backward(actor_pass, torch.cat([by_mean, by_log_std], dim=-1).flatten(0, 1))

        surpluses = self._temperatures(pi, log_pi, log_pi_x)
        critic_loss = error.square().mean(dim=-1)
        parts = [
            critic_loss.mean(dim=-1),
            by_state.mean(dim=(1, 2)),
            (pi * (parameter_alpha * log_pi_x - h)).sum(dim=1).mean(dim=-1),
        ]
        total = critic_loss.sum(dim=-1) + parts[1] + parts[2]
        for log, (_, surplus) in zip(self._log_temperatures, surpluses, strict=True):
            total = total + log * surplus
        temperatures = [skill_alpha.view(S), parameter_alpha.view(S)]
        return torch.stack([*parts, *temperatures, *(entropy for entropy, _ in surpluses)], dim=-1), total

    def _temperatures(self, pi: Tensor, log_pi: Tensor, log_pi_x: Tensor) -> list[tuple[Tensor, Tensor]]:
        """Of skills, and of parameters: (S,) entropy, and what it has more than its target, which is the gradient."""
        entropies = [-(pi * log).sum(dim=1).mean(dim=-1) for log in (log_pi, log_pi_x)]
        wanted, wanted_of_each = self._targets
        targets: list[Tensor | float] = [wanted, (pi * wanted_of_each).sum(dim=1).mean(dim=-1)]
        told = [(entropy, entropy - target) for entropy, target in zip(entropies, targets, strict=True)]
        for gradient, (_, surplus) in zip(self._temperature_gradients, told, strict=True):
            gradient.copy_(surplus)
        return told

    def _imagined(self, x: Tensor, keypoints: Tensor) -> tuple[Tensor, Back]:
        """What the critics read of imagined calls beside state and skill, (S, O, B, P + features).

        x: (S, O, B, P) as the parameter actors put it out. Also: from the gradient by the one to that by the other.
        """
        if self._imagining is None or not keypoints.numel():
            return x, lambda gradient: gradient
        return self._imagining(x, keypoints)

    def _inputs(self, lesson: Lesson, imagined: Tensor) -> Tensor:
        """(S, 1, (1 + O) * B, ...) what the critics read: of the labels' calls first, then of the imagined ones."""
        networks = self._networks
        S, O, B, _ = imagined.shape  # noqa: E741
        of_labels = networks.critic_inputs(
            lesson.states.flatten(0, 1),
            lesson.skills.flatten(),
            lesson.parameters.flatten(0, 1),
            lesson.keypoints.flatten(0, 1),
        )
        inputs = of_labels.new_empty(S, 1 + O, B, of_labels.shape[-1])
        n, K = lesson.states.shape[-1], networks.layout.skills
        inputs[:, 0] = of_labels.view(S, B, -1)
        inputs[:, 1:, :, :n] = lesson.states.unsqueeze(1)
        inputs[:, 1:, :, n : n + K] = networks.one_hot[networks.option_skill].view(O, 1, K)
        inputs[:, 1:, :, n + K :] = imagined
        return inputs.view(S, 1, (1 + O) * B, -1)
