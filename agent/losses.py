"""The paper's equations 1-3 and both temperature losses as pure functions of tensors.

Shapes: B states, K skills, P parameters of the longest skill, E critics. Expectations over skills are exact sums
weighted by pi_phi(a|s), so no skill has to be sampled.
"""

from __future__ import annotations

import math

import torch
from torch import Tensor
from torch.nn.functional import softplus


def critic_loss(predicted: Tensor, labels: Tensor) -> Tensor:
    """Eq. 1: mean over the batch of (H_theta(s, a, x) - H)^2, summed over critics.

    predicted: (E, B). labels: (B,), affordance penalty already taken off.
    """
    return (predicted - labels).square().mean(dim=1).sum()


def skill_actor_loss(log_probabilities: Tensor, predicted: Tensor, temperature: Tensor) -> Tensor:
    """Eq. 2: mean over states of sum_a pi(a|s) [alpha_phi log pi(a|s) - H(s, a, x_a)].

    log_probabilities: (B, K). predicted: (K, B), with x_a ~ pi_psi(.|s, a). Gradients reach the skill actor only.
    """
    inside = temperature.detach() * log_probabilities - predicted.detach().T
    return (log_probabilities.exp() * inside).sum(dim=1).mean()


def parameter_actor_loss(
    log_probabilities: Tensor, parameter_log_probabilities: Tensor, predicted: Tensor, temperature: Tensor
) -> Tensor:
    """Eq. 3: mean over states of sum_a pi(a|s) [alpha_psi log pi(x_a|s, a) - H(s, a, x_a)].

    log_probabilities: (B, K). parameter_log_probabilities, predicted: (K, B). Gradients reach the parameter actors
    only, through x_a and its density.
    """
    inside = temperature.detach() * parameter_log_probabilities - predicted
    return (log_probabilities.detach().exp().T * inside).sum(dim=0).mean()


def skill_temperature_loss(log_temperature: Tensor, log_probabilities: Tensor, target_entropy: float) -> Tensor:
    """Log alpha_phi (entropy - target): raises alpha_phi while the entropy is below its target (SAC, MAPLE)."""
    return log_temperature * (skill_entropy(log_probabilities) - target_entropy).mean().detach()


def parameter_temperature_loss(
    log_temperature: Tensor, log_probabilities: Tensor, parameter_log_probabilities: Tensor, target_entropy: Tensor
) -> Tensor:
    """The same for alpha_psi, weighted by pi(a|s). target_entropy: (K, 1), zero for a skill without parameters."""
    surplus = -parameter_log_probabilities - target_entropy
    return log_temperature * (log_probabilities.exp().T * surplus).sum(dim=0).mean().detach()


def skill_entropy(log_probabilities: Tensor) -> Tensor:
    """(B, K) log pi(a|s) -> (B,) entropy in nats."""
    return -(log_probabilities.exp() * log_probabilities).sum(dim=1)


def sample_parameters(mean: Tensor, log_std: Tensor, mask: Tensor, noise: Tensor) -> tuple[Tensor, Tensor]:
    """Reparametrised x = tanh(mean + std * noise) and log pi(x), with gradients through x.

    mean, log_std, noise: (K, B, P). mask: (K, 1, P); masked parameters are 0 and add nothing to the density.
    Returns x (K, B, P) in (-1, 1) and its log-probability (K, B) in the space of x.
    """
    before = mean + log_std.exp() * noise
    return torch.tanh(before) * mask, tanh_gaussian_log_probability(before, noise, log_std, mask)


def tanh_gaussian_log_probability(before: Tensor, noise: Tensor, log_std: Tensor, mask: Tensor) -> Tensor:
    """Log density of tanh(before), where before ~ N(mean, std) and noise = (before - mean) / std, summed over P.

    The correction log(1 - tanh(u)^2) is written 2 (log 2 - u - softplus(-2u)), which stays finite for any u.
    """
    gaussian = -0.5 * noise.square() - log_std - 0.5 * math.log(2.0 * math.pi)
    correction = 2.0 * (math.log(2.0) - before - softplus(-2.0 * before))
    return ((gaussian - correction) * mask).sum(dim=-1)
