"""What a label is believed to say once those of like calls have voted: trainers err, and disagree.

Two labels are alike if their calls do the same in what looks like the same situation: the same skill at the same key
point, an offset within the tolerance, and alike heights and flags in the state. Where objects lie doesn't matter, for
the key point moves with them. A label counts as its own vote and those of its likes add up to; a tie says nothing.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import torch
from numpy.typing import NDArray

from agent.grounding import Grounding
from agent.replay import Batch, Float32

SITUATION = 0.1
"""State entries that differ by no more than this, scaled to [-1, 1], are alike: a centimetre or two of height."""
OTHER = 0.12
"""The same of a parameter that is no position, such as a yaw."""
APART = 10.0
"""Further than any two that are alike."""


class Consensus:
    """Compares labels of one task."""

    def __init__(self, grounding: Grounding, state_size: int, positions: Sequence[int], tolerance: float) -> None:
        """positions: indices into the state where an x stands with its y right after. tolerance: m."""
        self._grounding, self._tolerance = grounding, tolerance
        planar = {column for x in positions for column in (x, x + 1)}
        self._flags = np.array([column for column in range(state_size) if column not in planar], dtype=np.int64)

    def believed(self, batch: Batch, values: NDArray[np.int8]) -> NDArray[np.int8]:
        """(B,) labels -1, 0, +1 -> what each is believed to say; neutral stays neutral."""
        features = self._features(batch)
        votes = np.zeros(len(values), dtype=np.int64)
        for option in np.unique(features[:, 0]):
            rows = np.flatnonzero(features[:, 0] == option)
            ours = features[rows]
            alike = np.abs(ours[:, None] - ours[None]).max(axis=-1) <= 1.0
            votes[rows] = alike @ values[rows].astype(np.int64)
        return np.where(values == 0, 0, np.sign(votes)).astype(np.int8)

    def _features(self, batch: Batch) -> Float32:
        """(B, D): rows that differ by no more than 1 everywhere are alike; the first column is the option."""
        ground = self._grounding
        skills, parameters = torch.from_numpy(batch.skills), torch.from_numpy(batch.parameters)
        options, local = ground.encode(skills, parameters, torch.from_numpy(batch.keypoints))
        at_keypoint, located = ground.option_keypoint[options] >= 0, ground.position[skills]
        reach = torch.where(at_keypoint[:, None], ground.radius, ground.half[skills, :3])
        scale = torch.full_like(local, 1.0 / OTHER)
        scale[:, :3] = torch.where(located[:, None], reach / self._tolerance, scale[:, :3])
        what = local * scale
        pushes = torch.nonzero(ground.delta[skills] >= 0)[:, 0]
        if len(pushes):
            # of a push, where it ends counts, not how far it goes; of the direction only the sign
            delta, direction = ground.delta[skills[pushes]], ground.direction[skills[pushes]]
            end = ground.read_end(skills[pushes], parameters[pushes]) * ground.half[skills[pushes], :2]
            along_y = parameters[pushes, direction] >= 0
            what[pushes, direction] = torch.where(along_y, APART, -APART)
            what[pushes, delta] = torch.where(along_y, end[:, 1], end[:, 0]) / self._tolerance
        states = torch.from_numpy(batch.states)
        # a place that the state doesn't tell is the same in every state
        placeless = located & ~ground.present[skills].any(dim=1)
        seen = states[:, self._flags] / SITUATION * ~placeless[:, None]
        absolute = located & ~at_keypoint & ~placeless
        everything = states / SITUATION * absolute[:, None]
        told: Float32 = torch.cat([options[:, None].float(), what, seen, everything], dim=1).numpy()
        return told
