"""What the critics read of calls that the parameter actors imagine, and the gradient's way back, written out.

`agent.grounding` says the same of any calls, one by one. Here all calls of an option are of one skill, so everything
about it is a constant, and the labels come last in memory, so that every operation runs along them.

Shapes: S learners, B labels, O options, P parameters, K skills, M key points.
"""

from __future__ import annotations

from collections.abc import Callable

import torch
from torch import Tensor

from agent.grounding import SCALES, Grounding

Back = Callable[[Tensor], Tensor]
"""From the gradient by what the critics read to that by what the actors put out."""


class Imagining:
    """`Grounding.decode` and `Grounding.read`, of (S, O, B, P) as the parameter actors put it out."""

    def __init__(self, grounding: Grounding) -> None:
        skills, self._width = grounding.option_skill, grounding.half.shape[1]
        self._skills, self._keypoint = skills, grounding.option_keypoint.clamp(min=0)
        self._reads = grounding.features > 0
        grounded = (grounding.option_keypoint >= 0)[:, None, None]
        self._centre, self._half = (of[skills, :3, None] for of in (grounding.centre, grounding.half))
        # parameter = slope * output + share of its key point
        self._slope = torch.where(grounded, grounding.radius / self._half, 1.0)
        self._share = torch.where(grounded, 1.0 / self._half, 0.0)
        # an offset that isn't read is multiplied by 0, and so is its gradient
        read = (grounding.present & grounding.position[:, None])[skills].float()
        self._inverse = read[:, None, :, None, None] / torch.tensor(SCALES, device=skills.device)[:, None, None, None]
        self._ends = self._reads and bool(grounding.pushing)
        self._pushes = torch.tensor(grounding.pushing, dtype=torch.int64, device=skills.device)
        pushing = skills[self._pushes]
        self._delta, self._direction = grounding.delta[pushing], grounding.direction[pushing]
        self._delta_centre, self._delta_half = (
            of[pushing, self._delta, None] for of in (grounding.centre, grounding.half)
        )

    def __call__(self, x: Tensor, keypoints: Tensor) -> tuple[Tensor, Back]:
        """Of x (S, O, B, P) and keypoints (S, B, K, M, 3) m: (S, O, B, P + features), and the way back."""
        local = x.transpose(2, 3).contiguous()
        points = keypoints.permute(0, 2, 3, 4, 1).contiguous()
        parameters = local.clone()
        position = parameters[:, :, :3]
        position.mul_(self._slope).add_((points[:, self._skills, self._keypoint] - self._centre) * self._share)
        if not self._reads:
            return parameters.transpose(2, 3), lambda gradient: self._to_output(gradient.transpose(2, 3).contiguous())
        metres = self._centre + self._half * position
        offsets = metres.unsqueeze(2) - points[:, self._skills]
        seen = torch.tanh(offsets.unsqueeze(2) * self._inverse)
        parts = [parameters, seen.flatten(2, 4)]
        along = self._axes(parameters)
        if self._ends:
            parts.append(self._end(parameters, along))

        def back(gradient: Tensor) -> Tensor:
            turned = gradient.transpose(2, 3).contiguous()
            by_parameters = turned[:, :, : self._width]
            by_seen = turned[:, :, self._width :][:, :, : seen[0, 0, ..., 0].numel()].reshape(seen.shape)
            by_metres = (torch.addcmul(by_seen, by_seen, seen.square(), value=-1) * self._inverse).sum(dim=(2, 3))
            by_parameters[:, :, :3] += self._half * by_metres
            if self._ends:
                self._end_back(by_parameters, turned[:, :, -2:], along)
            return self._to_output(by_parameters)

        return torch.cat(parts, dim=2).transpose(2, 3), back

    def _to_output(self, by_parameters: Tensor) -> Tensor:
        by_parameters[:, :, :3] *= self._slope
        return by_parameters.transpose(2, 3)

    def _axes(self, parameters: Tensor) -> Tensor:
        """(S, Q, 2, B) of the Q options that push: how far x and y move, scaled, when its length grows by 1 m."""
        along_y = parameters[:, self._pushes, self._direction] >= 0
        return torch.stack([~along_y, along_y], dim=2) / self._half[self._pushes, :2]

    def _end(self, parameters: Tensor, along: Tensor) -> Tensor:
        """(S, O, 2, B), as `Grounding.read_end`."""
        end = parameters.new_zeros(*parameters.shape[:2], 2, parameters.shape[-1])
        length = self._delta_centre + self._delta_half * parameters[:, self._pushes, self._delta]
        end[:, self._pushes] = parameters[:, self._pushes, :2] + along * length.unsqueeze(2)
        return end

    def _end_back(self, by_parameters: Tensor, gradient: Tensor, along: Tensor) -> None:
        by_end = gradient[:, self._pushes]
        by_parameters[:, self._pushes, :2] += by_end
        by_parameters[:, self._pushes, self._delta] += (by_end * along).sum(dim=2) * self._delta_half
