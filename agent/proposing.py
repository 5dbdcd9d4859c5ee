"""How a proposal is chosen: a skill from the skill actor, its parameters from that skill's actor (Algorithm 1)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import torch

from agent.exploring import disagreement
from agent.networks import Networks
from agent.replay import Float32, Int64
from robot_adapters.base import Array


@dataclass(frozen=True)
class Choice:
    """skill: index. parameters: (P,) in [-1, 1], padded with 0. probabilities: (K,). predicted: H_theta(s, a, x).

    uncertainty: as in `agent.algorithm.Suggestion`.
    """

    skill: int
    parameters: Array
    probabilities: Array
    predicted: float
    uncertainty: float | None


@torch.inference_mode()
def estimate(networks: Networks, state: Float32, keypoints: Float32, *, skills: Int64, parameters: Float32) -> Array:
    """H_theta(s, a, x) of C calls in one state, the mean over the critics: (C,).

    state: (n,) scaled. keypoints: (K, M, 3) m, empty where the networks know none. skills: (C,) indices. parameters:
    (C, P) in [-1, 1], padded with 0.
    """
    count = len(skills)
    states = torch.from_numpy(state).expand(count, -1)
    here = torch.from_numpy(keypoints).expand(count, *keypoints.shape)
    predicted = networks.predict(states, torch.from_numpy(skills), torch.from_numpy(parameters), here)
    return predicted.mean(dim=0).double().numpy()


@torch.inference_mode()
def likeliest(networks: Networks, state: Float32, keypoints: Float32) -> list[Array]:
    """For each skill (P,) in [-1, 1], padded with 0: the middle of its actor, of the likeliest where it has several.

    state: (n,) scaled. keypoints: (K, M, 3) m, empty where the networks know none. Draws nothing.
    """
    states = torch.from_numpy(state).unsqueeze(0)
    here = torch.from_numpy(keypoints).unsqueeze(0)
    chances = networks.skill_log_probabilities(states)[0]
    mean, _ = networks.parameter_distributions(states)
    parameters = networks.decode(torch.tanh(mean), here)[:, 0].clamp(-1.0, 1.0) * networks.mask[:, 0]
    found = []
    for skill in range(networks.layout.skills):
        own = networks.option_skill == skill
        option = int(torch.where(own, chances, -torch.inf).argmax())
        found.append(parameters[option].numpy().astype(np.float64))
    return found


@torch.inference_mode()
def choose(
    networks: Networks, state: Float32, keypoints: Float32, generator: torch.Generator, *, deterministic: bool
) -> Choice:
    """Draw a ~ pi_phi(.|s), x ~ pi_psi(.|s, a); or, deterministic, take the likeliest skill and its actor's middle.

    state: (n,) scaled. keypoints: (K, M, 3) m, empty where the networks know none. A deterministic choice draws nothing
    from `generator`, so evaluating changes no proposal.
    predicted is the mean over the critics.
    """
    states = torch.from_numpy(state).unsqueeze(0)
    here = torch.from_numpy(keypoints).unsqueeze(0)
    probabilities = networks.skill_log_probabilities(states)[0].exp()
    mean, log_std = (part[:, 0] for part in networks.parameter_distributions(states))
    if deterministic:
        option = int(probabilities.argmax())
        before = mean[option]
    else:
        option = int(torch.multinomial(probabilities, 1, generator=generator))
        noise = torch.randn(mean.shape[-1], generator=generator)
        before = mean[option] + log_std[option].exp() * noise
    local = torch.tanh(before).expand(len(probabilities), 1, -1)
    parameters = networks.decode(local, here)[option, 0].clamp(-1.0, 1.0) * networks.mask[option, 0]
    skill = networks.option_skill[option]
    predicted = networks.predict(states, skill.unsqueeze(0), parameters.unsqueeze(0), here)[:, 0]
    by_skill = torch.zeros(networks.layout.skills).index_add_(0, networks.option_skill, probabilities)
    return Choice(
        skill=int(skill),
        parameters=parameters.numpy().astype(np.float64),
        probabilities=by_skill.numpy().astype(np.float64),
        predicted=float(predicted.mean()),
        uncertainty=disagreement(predicted),
    )
