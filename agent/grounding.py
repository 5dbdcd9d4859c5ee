"""Skill parameters seen from the task's key points: what the critic reads, and where a grounded actor starts from.

Shapes: B states, K skills, P parameters of the longest skill, M key points of the skill that has most, O options.
An option is a skill at one of its key points; a skill without any, or an actor that isn't grounded, is one option.
Key points are (B, K, M, 3) m, robot base frame; a skill with fewer than M repeats its last one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from robot_adapters.base import SkillSpec

SCALES = (0.02, 0.1)
"""m. An offset is read through tanh at both: the size of what a grasp forgives, and of the way between objects."""
NO_KEYPOINT = -1
POSITION = ("x", "y", "z")


@dataclass(frozen=True)
class Grounding:
    """One task's skills and key points as tensors.

    option_skill, option_keypoint: (O,) indices; the latter is `NO_KEYPOINT` where the actor's output is the parameter
    vector itself. centre, half: (K, P): a parameter in its unit is centre + half * its value in [-1, 1].
    position: (K,) whether the first three parameters are x, y, z. present: (K, M) whether a skill has that key point.
    delta, direction: (K,) column of a push's parameters, -1 for other skills.
    """

    option_skill: Tensor
    option_keypoint: Tensor
    centre: Tensor
    half: Tensor
    position: Tensor
    present: Tensor
    delta: Tensor
    direction: Tensor
    relative: bool
    radius: float

    def to(self, device: torch.device) -> Grounding:
        """The same with its tensors there."""
        parts = {field.name: getattr(self, field.name) for field in fields(self)}
        moved: dict[str, Any] = {name: part.to(device) for name, part in parts.items() if isinstance(part, Tensor)}
        there = replace(self, **moved)
        # found out here once: asked there, each would wait for the card
        there.__dict__.update(pushing=self.pushing, features=self.features)
        return there

    @property
    def options(self) -> int:
        """O."""
        return len(self.option_skill)

    @cached_property
    def pushing(self) -> list[int]:
        """The options whose skill pushes. A skill has at least one option."""
        return torch.nonzero(self.delta[self.option_skill] >= 0)[:, 0].tolist()

    @cached_property
    def features(self) -> int:
        """Entries of `read`."""
        if not self.relative or not bool((self.present & self.position[:, None]).any()):
            return 0
        return self.present.shape[1] * 3 * len(SCALES) + (2 if self.pushing else 0)

    def decode(self, local: Tensor, keypoints: Tensor) -> Tensor:
        """What the actors put out, (O, B, P) in [-1, 1] -> parameters scaled as the skill's bounds are.

        A grounded option's x, y, z are offsets of up to `radius` from its key point. The result may lie outside
        [-1, 1] where a key point is near the border.
        """
        grounded = self.option_keypoint >= 0
        if not bool(grounded.any()):
            return local
        skills = self.option_skill
        at = keypoints[:, skills, self.option_keypoint.clamp(min=0)].transpose(0, 1)
        metres = at + self.radius * local[..., :3]
        scaled = (metres - self.centre[skills, None, :3]) / self.half[skills, None, :3]
        placed = torch.where(grounded[:, None, None], scaled, local[..., :3])
        return torch.cat([placed, local[..., 3:]], dim=-1)

    def encode(self, skills: Tensor, parameters: Tensor, keypoints: Tensor) -> tuple[Tensor, Tensor]:
        """The reverse of `decode` for calls (B,), (B, P): the option at the nearest key point (B,), local (B, P)."""
        matches = self.option_skill == skills[:, None]
        if not bool((self.option_keypoint >= 0).any()):
            return matches.int().argmax(dim=1), parameters
        rows = torch.arange(len(skills), device=skills.device)
        metres = self.centre[skills, :3] + self.half[skills, :3] * parameters[:, :3]
        offsets = metres[:, None] - keypoints[rows, skills]
        distance = offsets.norm(dim=-1).masked_fill(~self.present[skills], torch.inf)
        nearest = distance.argmin(dim=1)
        option = (matches & ((self.option_keypoint == nearest[:, None]) | (self.option_keypoint < 0))).int().argmax(1)
        grounded = (self.option_keypoint[option] >= 0)[:, None]
        placed = torch.where(grounded, offsets[rows, nearest] / self.radius, parameters[:, :3])
        return option, torch.cat([placed, parameters[:, 3:]], dim=-1)

    def read(self, skills: Tensor, parameters: Tensor, keypoints: Tensor) -> Tensor:
        """Calls (B,), (B, P) scaled, with their key points -> (B, features): offsets, and where a push ends."""
        rows = torch.arange(len(skills), device=skills.device)
        metres = self.centre[skills, :3] + self.half[skills, :3] * parameters[:, :3]
        offsets = metres[:, None] - keypoints[rows, skills]
        used = (self.present[skills] & self.position[skills, None]).unsqueeze(-1)
        parts = [torch.where(used, torch.tanh(offsets / scale), 0.0).flatten(1) for scale in SCALES]
        if self.pushing:
            parts.append(self.read_end(skills, parameters))
        return torch.cat(parts, dim=-1)

    def read_end(self, skills: Tensor, parameters: Tensor) -> Tensor:
        """(B, 2) x and y where a push ends, scaled as its start is: what matters to whatever it pushes against."""
        rows, column = torch.arange(len(skills), device=skills.device), self.delta[skills]
        pushes = column >= 0
        at = column.clamp(min=0)
        delta = self.centre[skills, at] + self.half[skills, at] * parameters[rows, at]
        along_y = parameters[rows, self.direction[skills].clamp(min=0)] >= 0
        axes = torch.stack([~along_y, along_y], dim=1)
        moved = parameters[:, :2] + axes * delta[:, None] / self.half[skills, :2]
        return torch.where(pushes[:, None], moved, 0.0)

    def ending_alike(self, skills: Tensor, parameters: Tensor, options: Tensor, local: Tensor, here: Tensor) -> Tensor:
        """Pushes (B,), (B, P) as `encode` told them -> (B, P) local, from the key point as it is now to the same end.

        here: (K, M, 3) m. Where the same end is out of a push's bounds, the nearest.
        """
        rows = torch.arange(len(skills), device=skills.device)
        delta, axis = self.delta[skills], (parameters[rows, self.direction[skills]] >= 0).long()
        end = self.centre[skills, axis] + self.half[skills, axis] * self.read_end(skills, parameters)[rows, axis]
        start = here[skills, self.option_keypoint[options], axis] + self.radius * local[rows, axis]
        again = local.clone()
        length = (end - start - self.centre[skills, delta]) / self.half[skills, delta]
        again[rows, delta] = length.clamp(-1.0, 1.0)
        return again


def grounding(
    skills: Sequence[SkillSpec], counts: Sequence[int], *, grounded: bool, relative: bool, radius: float
) -> Grounding:
    """Set up for these skills, of which each has so many key points. radius: m."""
    width, most = max(1, *(len(s.parameters) for s in skills)), max(1, *counts)
    centre, half = np.zeros((len(skills), width)), np.ones((len(skills), width))
    for k, spec in enumerate(skills):
        span = spec.high - spec.low
        centre[k, : len(span)] = (spec.low + spec.high) / 2
        half[k, : len(span)] = np.where(span > 0, span / 2, 1.0)
    position = np.array([located(spec) for spec in skills])
    options = [
        (k, m)
        for k, count in enumerate(counts)
        for m in (range(count) if grounded and count and position[k] else [NO_KEYPOINT])
    ]
    return Grounding(
        option_skill=torch.tensor([k for k, _ in options]),
        option_keypoint=torch.tensor([m for _, m in options]),
        centre=_float(centre),
        half=_float(half),
        position=torch.from_numpy(position),
        present=torch.tensor([[m < count for m in range(most)] for count in counts]),
        delta=torch.tensor([column(spec, "delta") if _pushes(spec) else -1 for spec in skills]),
        direction=torch.tensor([column(spec, "direction") if _pushes(spec) else -1 for spec in skills]),
        relative=relative,
        radius=radius,
    )


def located(spec: SkillSpec) -> bool:
    """Whether the first three parameters are a position."""
    return tuple(p.name for p in spec.parameters[:3]) == POSITION


def column(spec: SkillSpec, name: str) -> int:
    """Which parameter of the skill is called so; -1 for none."""
    names = [p.name for p in spec.parameters]
    return names.index(name) if name in names else -1


def _pushes(spec: SkillSpec) -> bool:
    return located(spec) and column(spec, "delta") >= 0 and column(spec, "direction") >= 0


def _float(values: NDArray[np.float64]) -> Tensor:
    return torch.from_numpy(values.astype(np.float32))
