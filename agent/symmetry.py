"""Labels seen elsewhere: a call that was good stays good when the whole scene is moved, mirrored or turned.

Everything is moved together: positions in the state, key points (so also those of fixtures, which the state leaves
out) and the call. Heights, flags and whatever else the state holds stay. What the scene does not share is left alone:
- how far a push goes depends on where it must end, which neither state nor key points tell. Such a label is moved and
  mirrored across its direction only;
- where the gripper keeps its yaw, or pushes along x or y, there is a front: nothing is turned.
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from numpy.typing import NDArray

from agent.algorithm import Problem
from agent.config import SeedSettings
from agent.encoding import Encoder
from agent.grounding import column, located
from agent.replay import Batch, Float32

Float = NDArray[np.float64]


class Symmetries:
    """Draws one motion for each label of a batch and applies it."""

    def __init__(self, problem: Problem, *, translation: float, flip: bool, rotation: bool) -> None:
        """translation: m, at most so far in x and in y."""
        self._translation, self._flip = translation, flip
        fronted = any(s.yaw is not None or column(s, "direction") >= 0 for s in problem.skills)
        self._rotation = rotation and not fronted
        self._fields = np.array(problem.position_fields, dtype=np.int64)
        low, high = np.asarray(problem.state_low), np.asarray(problem.state_high)
        self._low, self._half = low, np.where(high > low, (high - low) / 2, 1.0)
        self._skills = problem.skills
        placed = [s for s in problem.skills if located(s)]
        self._middle = np.mean([(s.low[:2] + s.high[:2]) / 2 for s in placed], axis=0) if placed else np.zeros(2)

    def applied(self, batch: Batch, rng: np.random.Generator) -> Batch:
        """The batch (B labels) with each label moved its own way."""
        return self.moved(batch, *self.motions(batch, rng))

    def motions(self, batch: Batch, rng: np.random.Generator) -> tuple[Float, Float, Float]:
        """For each label one that it allows, as `moved` takes them."""
        size = len(batch.skills)
        shift = rng.uniform(-self._translation, self._translation, (size, 2))
        mirrored = rng.random(size) < (0.5 if self._flip else 0.0)
        angle = rng.uniform(-math.pi, math.pi, size) if self._rotation else np.zeros(size)
        for k, spec in enumerate(self._skills):
            direction = column(spec, "direction")
            if direction >= 0:
                along_y = batch.parameters[:, direction] >= 0
                shift[(batch.skills == k) & ~along_y, 0] = 0.0
                shift[(batch.skills == k) & along_y, 1] = 0.0
                mirrored[(batch.skills == k) & along_y] = False
        return shift, np.where(mirrored, -1.0, 1.0), angle

    def moved(self, batch: Batch, shift: Float, flip: Float, angle: Float) -> Batch:
        """Mirror y where flip (B,) is -1, turn by angle (B,) rad about the workspace's middle, shift by (B, 2) m."""
        c, s = np.cos(angle), np.sin(angle)
        turn = np.stack([np.stack([c, -s * flip], -1), np.stack([s, c * flip], -1)], -2)

        def move(points: Float) -> Float:
            """(B, n, 2) m."""
            there: Float = np.einsum("bij,bnj->bni", turn, points - self._middle)
            return there + (self._middle + shift)[:, None]

        states = batch.states.astype(np.float64)
        if len(self._fields):
            at = np.stack([self._fields, self._fields + 1], axis=-1)
            metres = self._low[at] + (states[:, at] + 1.0) * self._half[at]
            states[:, at] = (move(metres) - self._low[at]) / self._half[at] - 1.0
        keypoints = batch.keypoints.astype(np.float64)
        if keypoints.size:
            flat = keypoints.reshape(len(states), -1, 3)
            flat[..., :2] = move(flat[..., :2])
            keypoints = flat.reshape(keypoints.shape)
        return dataclasses.replace(
            batch,
            states=states.astype(np.float32),
            parameters=self._calls(batch, turn, shift, flip, angle),
            keypoints=keypoints.astype(np.float32),
        )

    def _calls(self, batch: Batch, turn: Float, shift: Float, flip: Float, angle: Float) -> Float32:
        """The parameters (B, P), moved alike."""
        moved = batch.parameters.astype(np.float64)
        for k, spec in enumerate(self._skills):
            rows = np.flatnonzero(batch.skills == k)
            if not len(rows) or not located(spec):
                continue
            half = np.where(spec.high > spec.low, (spec.high - spec.low) / 2, 1.0)
            middle = (spec.low + spec.high) / 2
            metres = middle[:2] + half[:2] * moved[rows, :2]
            there = np.einsum("bij,bj->bi", turn[rows], metres - self._middle) + self._middle + shift[rows]
            moved[rows, :2] = (there - middle[:2]) / half[:2]
            yaw = column(spec, "yaw")
            if yaw >= 0:
                turned = flip[rows] * (middle[yaw] + half[yaw] * moved[rows, yaw]) + angle[rows]
                # two fingers: half a turn is no turn
                turned = (turned - middle[yaw] + math.pi / 2) % math.pi - math.pi / 2
                moved[rows, yaw] = turned / half[yaw]
        return moved.astype(np.float32)


def symmetries(problem: Problem, settings: SeedSettings, encoder: Encoder) -> Symmetries | None:
    """None where nothing is augmented, and where the state names no objects: what matters may then stand still."""
    asked = settings.augment_translation > 0 or settings.augment_flip or settings.augment_rotation
    if not asked or not any(encoder.keypoint_counts):
        return None
    return Symmetries(
        problem,
        translation=settings.augment_translation,
        flip=settings.augment_flip,
        rotation=settings.augment_rotation,
    )
