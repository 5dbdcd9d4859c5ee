"""How a proposal is chosen with `candidates`: many calls, judged by the critic, drawn by a softmax.

Candidates come from every option (a skill, or a skill at one of its key points): its actor's middle, draws of the
actor, spots around, and what was called good before. An option that never was called good is tried in the hope that it
is; a call near one that was refused in this very situation is not made again.
"""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor

from agent.grounding import Grounding
from agent.networks import Networks
from agent.proposing import Choice
from agent.replay import Float32, Replay

SAME_SITUATION = 0.02
"""States that differ by no more than this in any entry, scaled to [-1, 1], are the same situation."""
SPREADS = (0.1, 0.3, 0.6)
"""Standard deviations of the spots around an option's middle, shares of its range."""
REFUSED = 2.0
"""What a refused call takes off its own score: the whole range of labels."""
LOCAL_REACH = 0.25
"""How far a refusal reaches around a key point, as a share of the grounding radius."""
OTHER_REACH = 0.25
"""How far it reaches in a parameter that is no position, scaled to [-1, 1]."""

FAR = 2.0
"""Pushes along x and along y are twice this many reaches apart."""


@dataclass(frozen=True)
class Search:
    """What settings say of choosing. spacing: m; the rest as in `SeedSettings`."""

    candidates: int
    temperature: float
    optimism: float
    spacing: float
    recall: int


@torch.inference_mode()
def choose_ranked(
    networks: Networks,
    grounding: Grounding,
    replay: Replay,
    search: Search,
    state: Float32,
    keypoints: Float32,
    generator: torch.Generator,
    *,
    deterministic: bool,
) -> Choice:
    """The best candidate, or one drawn in proportion to exp(score / temperature).

    state: (n,) scaled. keypoints: (K, M, 3) m. Deterministic candidates are the actors' middles and what was good
    before, their scores the critic's alone; nothing is drawn.
    """
    states = torch.from_numpy(state).unsqueeze(0)
    here = torch.from_numpy(keypoints).unsqueeze(0)
    mean, log_std = (part[:, 0] for part in networks.parameter_distributions(states))
    options, local = _remembered(grounding, replay, search.recall)
    promising = torch.zeros(grounding.options, dtype=torch.bool)
    promising[options] = True
    options, local = options[-search.recall :], local[-search.recall :]
    every = torch.arange(grounding.options)
    parts = [(every, torch.tanh(mean)), (options, local)]
    if not deterministic:
        parts += _drawn(mean, log_std, search, grounding, promising, generator)
        jitter = 0.1 * torch.randn(local.shape, generator=generator)
        parts.append((options, local + jitter))
    options = torch.cat([o for o, _ in parts])
    local = torch.cat([x for _, x in parts]) * networks.mask[options, 0]
    parameters = _decoded(grounding, options, local, here).clamp(-1.0, 1.0) * networks.mask[options, 0]
    skills = grounding.option_skill[options]
    size = len(options)
    predicted = networks.predict(
        states.expand(size, -1), skills, parameters, here.expand(size, *here.shape[1:])
    )
    score = predicted.amin(dim=0)
    if deterministic:
        weights = torch.zeros(size)
        at = int(score.argmax())
        weights[at] = 1.0
    else:
        score = score + search.optimism * ~promising[options] - _refused(grounding, replay, search, state, skills, parameters)
        # an option counts once, however many candidates it has
        weights = torch.softmax(score / search.temperature, dim=0)
        at = int(torch.multinomial(weights, 1, generator=generator))
    probabilities = torch.zeros(networks.layout.skills).index_add_(0, skills, weights)
    return Choice(
        skill=int(skills[at]),
        parameters=parameters[at].double().numpy(),
        probabilities=(probabilities / probabilities.sum()).double().numpy(),
        predicted=float(predicted[:, at].mean()),
    )


def _drawn(
    mean: Tensor,
    log_std: Tensor,
    search: Search,
    grounding: Grounding,
    promising: Tensor,
    generator: torch.Generator,
) -> list[tuple[Tensor, Tensor]]:
    """Draws of the actors, spots around their middles, and for what never was good, spots everywhere."""
    O, P = mean.shape
    count = max(1, search.candidates // 2)
    every = torch.arange(O).repeat_interleave(count)
    noise = torch.randn((O, count, P), generator=generator)
    drawn = torch.tanh(mean[:, None] + log_std.exp()[:, None] * noise)
    spread = torch.tensor(SPREADS)[torch.randint(len(SPREADS), (O, count, 1), generator=generator)]
    around = torch.tanh(mean)[:, None] + spread * torch.randn((O, count, P), generator=generator)
    anywhere = _inner(grounding, search.spacing)[:, None] * (2 * torch.rand((O, count, P), generator=generator) - 1)
    free = (grounding.option_keypoint < 0)[:, None, None]
    placed = torch.where(free, anywhere[..., :3], around[..., :3])
    looked = torch.cat([placed, anywhere[..., 3:]], dim=-1)
    around = torch.where(promising[:, None, None], around, looked).clamp(-1.0, 1.0)
    parts = [(every, drawn.flatten(0, 1)), (every, around.flatten(0, 1))]
    lost = torch.arange(O)[~promising].repeat_interleave(count)
    if len(lost):
        # other parameters, at the key point itself
        centred = anywhere.clone()
        centred[..., :3] = torch.where(free, anywhere[..., :3], 0.0)
        parts.append((lost, centred[~promising].flatten(0, 1)))
    return parts


def _inner(grounding: Grounding, spacing: float) -> Tensor:
    """(O, P) the share of each range where looking pays: an area as wide as `spacing` lies off the border."""
    inner = torch.ones_like(grounding.half)
    where = grounding.position
    inner[where, :3] = (1.0 - spacing / grounding.half[where, :3]).clamp(min=0.5)
    return inner[grounding.option_skill]


def _decoded(grounding: Grounding, options: Tensor, local: Tensor, here: Tensor) -> Tensor:
    """(C,) options and (C, P) of their actors -> (C, P) parameters."""
    if not here.numel():
        return local
    every = grounding.decode(local.expand(grounding.options, -1, -1), here.expand(len(local), *here.shape[1:]))
    return every[options, torch.arange(len(local))]


def _remembered(grounding: Grounding, replay: Replay, recall: int) -> tuple[Tensor, Tensor]:
    """Options and local parameters of what was called good, the newest last."""
    good = replay.good()
    skills, parameters, keypoints = map(torch.from_numpy, (good.skills, good.parameters, good.keypoints))
    return grounding.encode(skills, parameters, keypoints)


def _refused(
    grounding: Grounding, replay: Replay, search: Search, state: Float32, skills: Tensor, parameters: Tensor
) -> Tensor:
    """(C,) what each candidate loses for being near something that was refused in this situation."""
    refused = replay.refused(state, SAME_SITUATION)
    if not len(refused.skills):
        return torch.zeros(len(skills))
    their_skills, theirs = torch.from_numpy(refused.skills), torch.from_numpy(refused.parameters)
    grounded = torch.zeros(len(grounding.half), dtype=torch.bool)
    grounded[grounding.option_skill[grounding.option_keypoint >= 0]] = True
    reach = torch.where(grounded, LOCAL_REACH * grounding.radius, search.spacing)
    scale = torch.full_like(grounding.half, 1.0 / OTHER_REACH)
    where = grounding.position
    scale[where, :3] = grounding.half[where, :3] / reach[where, None]
    ours = _coordinates(grounding, scale, skills, parameters)
    away = ours[:, None] - _coordinates(grounding, scale, their_skills, theirs)[None]
    near = torch.exp(-0.5 * away.square().sum(dim=-1)) * (skills[:, None] == their_skills)
    return REFUSED * near.amax(dim=1)


def _coordinates(grounding: Grounding, scale: Tensor, skills: Tensor, parameters: Tensor) -> Tensor:
    """(C, P) parameters in units of how far a refusal reaches; of a direction only its sign matters."""
    scaled = parameters * scale[skills]
    rows = torch.nonzero(grounding.direction[skills] >= 0)[:, 0]
    columns = grounding.direction[skills[rows]]
    scaled[rows, columns] = torch.where(parameters[rows, columns] < 0, -FAR, FAR)
    return scaled
