"""How a proposal is chosen with `candidates`: many calls, judged by the critic, drawn by a softmax.

Candidates come from every option (a skill, or a skill at one of its key points): its actor's middle, draws of the
actor, spots around, and what was called good before. An option that never was called good is tried in the hope that it
is; a call near one that was refused in this very situation is not made again.
"""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor

from agent.config import SeedSettings
from agent.exploring import disagreement, promise
from agent.grounding import Grounding
from agent.networks import Networks
from agent.proposing import Choice
from agent.replay import Batch, Float32, Replay
from agent.search import Elimination, PushElimination

SAME_SITUATION = 0.02
"""States that differ by no more than this in any entry, scaled to [-1, 1], are the same situation."""
SPREADS = (0.0, 0.1, 0.3, 0.6)
"""Standard deviations of the spots around an option's middle, drawn for each parameter, shares of its range."""
JITTER = 0.1
"""Standard deviation of the spots around what was good before, likewise."""
REFUSED = 3.0
"""What a refused call takes off its own score: more than all that may speak for it."""
LOCAL_REACH = 0.125
"""How far a refusal reaches around a key point, as a share of the grounding radius."""
KNOWN_REACH = 0.25
"""How far it reaches without one once the skill was called good, as a share of `explore_spacing`."""
PUSH_LOCALITY = 4.0
"""So many times `explore_locality`, while no push was called good: its direction and length are looked for first, its
start later."""
FATIGUE = (0.1, 0.5)
"""What each refusal in this situation takes off all candidates of its option, so that others get their turn: of one
that never was called good, and of one whose good calls were elsewhere, which is probably not due here."""
MOST_TIRED = 1.0
"""Less than `REFUSED`: a call without parameters, once refused, doesn't come back because there is much to search."""
OTHER_REACH = 0.12
"""How far a refusal reaches in a parameter that is no position, scaled to [-1, 1]."""
ELIMINATED = 3.0
"""So many times less far, where elimination keeps a push's lengths apart: only the same push gets another start."""
FAR = 2.0
"""Pushes along x and along y are twice this many reaches apart."""


@dataclass(frozen=True)
class Search:
    """What settings say of choosing, as in `SeedSettings`. curiosity: 0 unless `explore` is `uncertainty`."""

    candidates: int
    temperature: float
    optimism: float
    spacing: float
    recall: int
    curiosity: float
    eliminate: bool
    avoid: bool
    locality: float
    fatigue: bool


def search_of(settings: SeedSettings) -> Search:
    """Those of the settings that this module reads."""
    return Search(
        candidates=settings.candidates,
        temperature=settings.candidate_temperature,
        optimism=settings.explore_optimism,
        spacing=settings.explore_spacing,
        recall=settings.recall,
        curiosity=settings.explore_curiosity if settings.explore == "uncertainty" else 0.0,
        eliminate=settings.explore_elimination,
        avoid=settings.avoid_refused,
        locality=settings.explore_locality,
        fatigue=settings.explore_fatigue,
    )


class Chooser:
    """Draws candidates and chooses among them. Holds what it reads, changes none of it."""

    def __init__(self, networks: Networks, grounding: Grounding, replay: Replay, search: Search) -> None:
        self._networks, self._grounding, self._replay, self._search = networks, grounding, replay, search
        free = torch.nonzero((grounding.option_keypoint < 0) & grounding.position[grounding.option_skill])[:, 0]
        self._eliminations: dict[int, Elimination] = {}
        self._pushes: dict[int, PushElimination] = {}
        if search.eliminate:
            skills = grounding.option_skill
            self._eliminations = {o: Elimination(grounding, int(skills[o]), search.spacing) for o in free.tolist()}
            at_keypoint = (grounding.option_keypoint >= 0) & (grounding.delta[skills] >= 0)
            pushes = torch.nonzero(at_keypoint)[:, 0].tolist()
            self._pushes = {o: PushElimination(grounding, int(skills[o]), search.spacing) for o in pushes}

    @torch.inference_mode()
    def choose(
        self,
        state: Float32,
        keypoints: Float32,
        generator: torch.Generator,
        *,
        deterministic: bool,
        pending: Batch | None = None,
    ) -> Choice:
        """The best candidate, or one drawn in proportion to exp(score / temperature).

        state: (n,) scaled. keypoints: (K, M, 3) m. Deterministic candidates are the actors' middles and what was good
        before; nothing is drawn. pending: calls in this state that count as refused, though nobody has refused them.
        """
        networks, grounding, search = self._networks, self._grounding, self._search
        states, here = (torch.from_numpy(array).unsqueeze(0) for array in (state, keypoints))
        mean, log_std = (part[:, 0] for part in networks.parameter_distributions(states))
        options, local = _remembered(grounding, self._replay, here[0])
        promising = torch.zeros(grounding.options, dtype=torch.bool)
        promising[options] = True
        recalled = max(0, len(options) - search.recall)
        options, local = good = options[recalled:], local[recalled:]
        parts = [(torch.arange(grounding.options), torch.tanh(mean)), (options, local)]
        refused, bad = self._replay.refused(state, SAME_SITUATION), self._replay.bad()
        if pending is not None and len(pending.skills):
            refused, bad = Batch.joined([refused, pending]), Batch.joined([bad, pending])
        if not deterministic:
            parts += self._drawn((mean, log_std), promising, generator)
            self._look(parts, promising, (refused, bad), here[0], generator)
            parts.append((options, local + JITTER * torch.randn(local.shape, generator=generator)))
            # the same position, other parameters: how far a push goes may differ from state to state
            anew = 2 * torch.rand(local[:, 3:].shape, generator=generator) - 1
            parts.append((options, torch.cat([local[:, :3], anew], dim=-1)))
        options = torch.cat([o for o, _ in parts])
        local = torch.cat([x for _, x in parts]) * networks.mask[options, 0]
        parameters = _decoded(grounding, options, local, here).clamp(-1.0, 1.0) * networks.mask[options, 0]
        skills, size = grounding.option_skill[options], len(options)
        predicted = networks.predict(states.expand(size, -1), skills, parameters, here.expand(size, *here.shape[1:]))
        score = promise(predicted, 0.0 if deterministic else search.curiosity)
        score = score - search.locality * _away(grounding, good, options, local)
        if deterministic:
            at = int(score.argmax())
            weights = torch.zeros(size)
            weights[at] = 1.0
        else:
            score = score + search.optimism * ~promising[options]
            score = score - self._lost(refused, promising, options, parameters)
            weights = torch.softmax(score / search.temperature, dim=0)
            at = int(torch.multinomial(weights, 1, generator=generator))
        probabilities = torch.zeros(networks.layout.skills).index_add_(0, skills, weights)
        return Choice(
            skill=int(skills[at]),
            parameters=parameters[at].double().numpy(),
            probabilities=(probabilities / probabilities.sum()).double().numpy(),
            predicted=float(predicted[:, at].mean()),
            uncertainty=disagreement(predicted[:, at]),
        )

    def _drawn(
        self, actors: tuple[Tensor, Tensor], promising: Tensor, generator: torch.Generator
    ) -> list[tuple[Tensor, Tensor]]:
        """Draws of the actors, spots around their middles, and for what never was good, spots everywhere."""
        mean, log_std = (part[:, None] for part in actors)
        shape = (len(promising), max(1, self._search.candidates // 2), mean.shape[-1])
        every = torch.arange(shape[0]).repeat_interleave(shape[1])
        drawn = torch.tanh(mean + log_std.exp() * torch.randn(shape, generator=generator))
        spread = torch.tensor(SPREADS)[torch.randint(len(SPREADS), shape, generator=generator)]
        around = torch.tanh(mean) + spread * torch.randn(shape, generator=generator)
        inner = _inner(self._grounding, self._search.spacing)[:, None]
        anywhere = inner * (2 * torch.rand(shape, generator=generator) - 1)
        free = (self._grounding.option_keypoint < 0)[:, None, None]
        placed = torch.where(free, anywhere[..., :3], around[..., :3])
        looked = torch.cat([placed, anywhere[..., 3:]], dim=-1)
        around = torch.where(promising[:, None, None], around, looked).clamp(-1.0, 1.0)
        # other parameters, at the key point itself
        centred = torch.cat([torch.where(free, anywhere[..., :3], 0.0), anywhere[..., 3:]], dim=-1)
        lost = torch.nonzero(~promising)[:, 0].repeat_interleave(shape[1])
        parts = ((every, drawn), (every, around), (lost, centred[~promising]))
        return [(options, local.flatten(0, 1)) for options, local in parts]

    def _look(
        self,
        parts: list[tuple[Tensor, Tensor]],
        promising: Tensor,
        refused: tuple[Batch, Batch],
        keypoints: Tensor,
        generator: torch.Generator,
    ) -> None:
        """Put the candidates of every skill that is still looked for where looking decides most.

        refused: in this situation, and in any.
        """
        for option, elimination in self._eliminations.items():
            if promising[option]:
                continue
            skill = int(self._grounding.option_skill[option])
            here, anywhere = (torch.from_numpy(batch.parameters[batch.skills == skill, :3]) for batch in refused)
            at = elimination.next(here, anywhere, generator)
            for options, local in parts:
                local[options == option, :3] = at
        for option, pushing in self._pushes.items():
            if promising[option]:
                continue
            calls = [self._of_option(batch, option) for batch in refused]
            keypoint = keypoints[self._grounding.option_skill[option], self._grounding.option_keypoint[option]]
            at = pushing.next(calls[0], calls[1], keypoint, generator)
            for options, local in parts:
                local[torch.nonzero(options == option), pushing.columns] = at

    def _of_option(self, batch: Batch, option: int) -> Tensor:
        """(R, P) the scaled parameters of those calls that are of this option."""
        skills, parameters, keypoints = map(torch.from_numpy, (batch.skills, batch.parameters, batch.keypoints))
        return parameters[self._grounding.encode(skills, parameters, keypoints)[0] == option]

    def _lost(self, refused: Batch, promising: Tensor, options: Tensor, parameters: Tensor) -> Tensor:
        """`_refused` as far as it is wanted, but where elimination looks, it has heeded the refused spots already."""
        search = self._search
        near, tired = _refused(self._grounding, refused, search, promising, (options, parameters))
        looked_for = torch.tensor([o in self._eliminations and not promising[o] for o in range(len(promising))])
        return search.avoid * torch.where(looked_for[options], 0.0, near) + search.fatigue * tired


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
    decoded: Tensor = every[options, torch.arange(len(local))]
    return decoded


def _remembered(grounding: Grounding, replay: Replay, here: Tensor) -> tuple[Tensor, Tensor]:
    """Options and local parameters of what was called good, the newest last.

    here: (K, M, 3) m, where the key points are now. A push is remembered twice: as long as it was, and ending there.
    """
    good = replay.good()
    skills, parameters, keypoints = map(torch.from_numpy, (good.skills, good.parameters, good.keypoints))
    options, local = grounding.encode(skills, parameters, keypoints)
    rows = torch.nonzero((grounding.option_keypoint[options] >= 0) & (grounding.delta[skills] >= 0))[:, 0]
    if not len(rows):
        return options, local
    again = grounding.ending_alike(skills[rows], parameters[rows], options[rows], local[rows], here)
    order = torch.argsort(torch.cat([torch.arange(len(options)), rows]), stable=True)
    return torch.cat([options, options[rows]])[order], torch.cat([local, again])[order]


def _away(grounding: Grounding, good: tuple[Tensor, Tensor], options: Tensor, local: Tensor) -> Tensor:
    """(C,) distance from what was good, or else from the key point, as a share of the range: near comes first."""
    from_keypoint: Tensor = local[:, :3].norm(dim=-1) * (grounding.option_keypoint[options] >= 0)
    pushes = grounding.delta[grounding.option_skill[options]] >= 0
    from_keypoint = torch.where(pushes, PUSH_LOCALITY, 1.0) * from_keypoint
    if not len(good[0]):
        return from_keypoint
    distance = (local[:, None, :3] - good[1][None, :, :3]).norm(dim=-1)
    from_good = distance.masked_fill(options[:, None] != good[0], torch.inf).amin(dim=1)
    nearest: Tensor = torch.where(from_good.isfinite(), from_good, from_keypoint)
    return nearest


def _refused(
    grounding: Grounding, refused: Batch, search: Search, promising: Tensor, calls: tuple[Tensor, Tensor]
) -> tuple[Tensor, Tensor]:
    """(C,) each: what candidates lose for what was refused in this situation nearby, and of the same option at all."""
    options, parameters = calls
    skills = grounding.option_skill[options]
    if not len(refused.skills):
        return torch.zeros(len(skills)), torch.zeros(len(skills))
    their_skills, theirs = torch.from_numpy(refused.skills), torch.from_numpy(refused.parameters)
    grounded = torch.zeros(len(grounding.half), dtype=torch.bool)
    grounded[grounding.option_skill[grounding.option_keypoint >= 0]] = True
    known = torch.zeros(len(grounding.half), dtype=torch.bool)
    known[grounding.option_skill[promising]] = True
    reach = torch.where(grounded, LOCAL_REACH * grounding.radius, torch.where(known, KNOWN_REACH, 1.0) * search.spacing)
    scale = torch.full_like(grounding.half, 1.0 / OTHER_REACH)
    if search.eliminate:
        scale[grounded & (grounding.delta >= 0) & ~known] *= ELIMINATED
    where = grounding.position
    scale[where, :3] = grounding.half[where, :3] / reach[where, None]
    ours = _coordinates(grounding, scale, skills, parameters)
    away = ours[:, None] - _coordinates(grounding, scale, their_skills, theirs)[None]
    near = torch.exp(-0.5 * away.square().sum(dim=-1)) * (skills[:, None] == their_skills)
    their_options, _ = grounding.encode(their_skills, theirs, torch.from_numpy(refused.keypoints))
    times = (options[:, None] == their_options).sum(dim=1)
    tired = (torch.tensor(FATIGUE)[promising[options].long()] * times).clamp(max=MOST_TIRED)
    return REFUSED * near.amax(dim=1), tired


def _coordinates(grounding: Grounding, scale: Tensor, skills: Tensor, parameters: Tensor) -> Tensor:
    """(C, P) parameters in units of how far a refusal reaches; of a direction only its sign matters."""
    scaled = parameters * scale[skills]
    rows = torch.nonzero(grounding.direction[skills] >= 0)[:, 0]
    columns = grounding.direction[skills[rows]]
    scaled[rows, columns] = torch.where(parameters[rows, columns] < 0, -FAR, FAR)
    return scaled
