"""What a label is believed to say once those of like calls have voted: trainers err, and disagree.

Two labels are alike if their calls do the same in what looks like the same situation: the same skill at the same key
point, an offset within the tolerance, and alike heights and flags in the state. Where objects lie doesn't matter, for
the key point moves with them. At no key point the whole state must be alike, unless the skill has none: then nothing of
the state counts. A label counts as its own vote and those of its likes add up to; a tie says nothing.
Where trainers differ in how far they can be believed (`agent.reliability`), a vote weighs as much as its trainer.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import torch
from numpy.typing import NDArray

from agent.grounding import Grounding
from agent.reliability import Likeness, weights
from agent.replay import Batch, Float32, Int64

SITUATION = 0.1
"""State entries that differ by no more than this, scaled to [-1, 1], are alike: a centimetre or two of height."""
OTHER = 0.12
"""The same of a parameter that is no position, such as a yaw."""
APART = 10.0
"""Further than any two that are alike."""
SAYS_SOMETHING = 0.5
"""Votes that add up to less are as good as a tie; a vote of the trainer who can be believed most weighs 1."""


class Consensus:
    """Compares labels of one task."""

    def __init__(
        self,
        grounding: Grounding,
        state_size: int,
        positions: Sequence[int],
        tolerance: float,
        *,
        weighed: bool = False,
    ) -> None:
        """positions: indices into the state where an x stands with its y right after. tolerance: m.

        weighed: votes weigh as much as their trainers can be believed; otherwise all alike.
        """
        self._grounding, self._tolerance, self._weighed = grounding, tolerance, weighed
        planar = {column for x in positions for column in (x, x + 1)}
        self._flags = np.array([column for column in range(state_size) if column not in planar], dtype=np.int64)

    def believed(self, batch: Batch, values: NDArray[np.int8], trainers: Int64) -> NDArray[np.int8]:
        """(B,) labels -1, 0, +1 and whose they are -> what each is believed to say; neutral stays neutral."""
        what, situation = self._features(batch)
        likenesses = []
        for option in np.unique(what[:, 0]):
            rows = np.flatnonzero(what[:, 0] == option)
            seen = _apart(situation[rows]) <= 1.0
            likenesses.append(Likeness(rows, np.where(seen, _apart(what[rows]), APART)))
        votes = values.astype(np.float64)
        if self._weighed:
            votes *= weights(likenesses, values, trainers)
        told = np.zeros(len(values))
        for likeness in likenesses:
            told[likeness.rows] = (likeness.apart <= 1.0) @ votes[likeness.rows]
        believed = np.sign(np.where(np.abs(told) < SAYS_SOMETHING, 0.0, told))
        return np.where(values == 0, 0, believed).astype(np.int8)

    def _features(self, batch: Batch) -> tuple[Float32, Float32]:
        """What calls do (B, D) and what the situation is (B, E): alike are rows that differ by no more than 1.

        The first column of the former is the option.
        """
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
        done = torch.cat([options[:, None].float(), what], dim=1).numpy()
        return done, torch.cat([seen, everything], dim=1).numpy()


def _apart(features: Float32) -> Float32:
    """(N, D) -> (N, N) how far two differ at most."""
    apart: Float32 = np.abs(features[:, None] - features[None]).max(axis=-1, initial=0.0)
    return apart
