"""Between the outside and the networks: states scaled to about [-1, 1], skills as indices, parameters padded."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np

from agent.algorithm import AgentError, Label, Problem
from agent.replay import Entry, Float32, Int64
from robot_adapters.base import Array, InvalidCall, SkillCall, check_call


class Encoder:
    """What one task's numbers look like inside. Checks everything that enters."""

    def __init__(self, problem: Problem, *, keypoints: Literal["none", "all", "skill"] = "none") -> None:
        """Check the problem. keypoints: whether each skill has none, all that the task names, or its own.

        Raises:
            AgentError: no skills, two of one name, or bounds that are not finite or not one each for every state entry.
        """
        self._problem = problem
        self._low = np.asarray(problem.state_low, dtype=np.float64)
        self._high = np.asarray(problem.state_high, dtype=np.float64)
        names = [spec.name for spec in problem.skills]
        if not names or len(set(names)) != len(names):
            raise AgentError(
                f"task {problem.task!r} offers the skills {names}",
                remedy="give it one or more, each under its own name",
            )
        bounds = np.stack([self._low, self._high]) if self._low.shape == self._high.shape else np.empty(0)
        if bounds.ndim != 2 or not bounds.size or not np.isfinite(bounds).all() or (self._low > self._high).any():
            raise AgentError(
                f"task {problem.task!r} has state bounds of shapes {self._low.shape} and {self._high.shape}",
                remedy="give a finite low and high for every entry of the state, low at most high",
            )
        self._index = {name: index for index, name in enumerate(names)}
        middle = (self._low + self._high) / 2
        self._keypoints = keypoints
        self._keypoint_counts = tuple(len(self._keypoints_of(middle, spec.name)) for spec in problem.skills)

    @property
    def state_size(self) -> int:
        """Entries of the state vector."""
        return len(self._low)

    @property
    def parameter_counts(self) -> tuple[int, ...]:
        """Parameters of each skill."""
        return tuple(len(spec.parameters) for spec in self._problem.skills)

    @property
    def skill_names(self) -> tuple[str, ...]:
        """In the order of the networks' outputs."""
        return tuple(self._index)

    @property
    def keypoint_counts(self) -> tuple[int, ...]:
        """Key points of each skill."""
        return self._keypoint_counts

    @property
    def keypoint_shape(self) -> tuple[int, int, int]:
        """(K, M, 3) of `keypoints`; empty where no skill has any."""
        return (len(self._index), max(self._keypoint_counts), 3) if any(self._keypoint_counts) else (0, 0, 3)

    def keypoints(self, state: Array) -> Float32:
        """(n,) in its own units -> (K, M, 3) m, robot base frame; a skill with fewer than M repeats its last one.

        Raises:
            AgentError: there are not as many as before, or one is not finite.
        """
        points = np.zeros(self.keypoint_shape, dtype=np.float32)
        if not points.size:
            return points
        for k, (name, count) in enumerate(zip(self._index, self._keypoint_counts, strict=True)):
            found = self._keypoints_of(np.asarray(state, dtype=np.float64), name)
            if found.shape != (count, 3) or not np.isfinite(found).all():
                raise AgentError(
                    f"task {self._problem.task!r} has the key points {found.tolist()} for {name!r}, not {count}",
                    remedy="let the task's `keypoints` give as many finite (x, y, z) in every state",
                )
            if count:
                points[k] = found[np.minimum(np.arange(points.shape[1]), count - 1)]
        return points

    def _keypoints_of(self, state: Array, skill: str) -> Array:
        if self._keypoints == "none" or self._problem.keypoints is None:
            return np.zeros((0, 3))
        return self._problem.keypoints(state, skill if self._keypoints == "skill" else None)

    def state(self, state: Array) -> Float32:
        """(n,) in its own units -> (n,) scaled; an entry whose bounds coincide becomes 0.

        Raises:
            AgentError: wrong shape, or an entry that is not finite; the message names it.
        """
        state = np.asarray(state, dtype=np.float64)
        if state.shape != self._low.shape:
            raise AgentError(
                f"state has the shape {state.shape}, task {self._problem.task!r} has {self._low.shape}",
                remedy="give the state exactly as the task's `state_fields` list it",
            )
        bad = np.flatnonzero(~np.isfinite(state))
        if bad.size:
            named = ", ".join(f"{self._entry_name(int(i))} = {state[i]}" for i in bad)
            raise AgentError(
                f"state is not finite: {named}", remedy="check what perceives this value, then observe again"
            )
        span = self._high - self._low
        safe = np.where(span > 0, span, 1.0)
        scaled = np.where(span > 0, 2.0 * (state - self._low) / safe - 1.0, 0.0)
        return scaled.astype(np.float32)

    def entry(self, label: Label, *, affordance_penalty: float) -> Entry:
        """A label for the replay. Where the call is near no object its target is lowered by the penalty.

        Raises:
            AgentError: the state, the call or the value doesn't fit the task; the message names the label.
        """
        if label.value not in (-1, 0, 1):
            raise AgentError(f"label {label.id} has the value {label.value}", remedy="use -1, 0 or +1")
        try:
            spec = check_call(label.call, self._problem.skills)
        except InvalidCall as error:
            raise AgentError(f"label {label.id}: {error}", remedy=error.remedy) from error
        unit = spec.normalise(np.asarray(label.call.parameters, dtype=np.float64))
        parameters = np.zeros(max(1, *self.parameter_counts), dtype=np.float32)
        parameters[: len(unit)] = np.clip(unit, -1.0, 1.0)
        return Entry(
            id=label.id,
            state=self.state(label.state),
            skill=self._index[spec.name],
            parameters=parameters,
            value=int(label.value),
            target=float(label.value) - (0.0 if label.near else affordance_penalty),
            keypoints=self.keypoints(label.state),
            trainer=label.trainer,
        )

    def call(self, skill: int, parameters: Array) -> SkillCall:
        """Skill index and (P,) in [-1, 1], padded -> the call in metres and radians."""
        spec = self._problem.skills[skill]
        values = spec.denormalise(np.asarray(parameters, dtype=np.float64)[: len(spec.parameters)])
        return SkillCall(spec.name, tuple(float(v) for v in values))

    def calls(self, calls: Sequence[SkillCall]) -> tuple[Int64, Float32]:
        """C calls in metres and radians -> (C,) skill indices and (C, P) parameters in [-1, 1], padded with 0.

        Raises:
            AgentError: one doesn't fit the task.
        """
        skills = np.zeros(len(calls), dtype=np.int64)
        parameters = np.zeros((len(calls), max(1, *self.parameter_counts)), dtype=np.float32)
        for row, call in enumerate(calls):
            try:
                spec = check_call(call, self._problem.skills)
            except InvalidCall as error:
                raise AgentError(str(error), remedy=error.remedy) from error
            unit = spec.normalise(np.asarray(call.parameters, dtype=np.float64))
            skills[row] = self._index[spec.name]
            parameters[row, : len(unit)] = np.clip(unit, -1.0, 1.0)
        return skills, parameters

    def fingerprint(self) -> Mapping[str, Any]:
        """What a checkpoint must agree on to mean the same thing: the task, its state bounds and its skills."""
        return {
            "task": self._problem.task,
            "state": [[float(low), float(high)] for low, high in zip(self._low, self._high, strict=True)],
            "skills": [
                [spec.name, [[p.name, float(p.low), float(p.high)] for p in spec.parameters]]
                for spec in self._problem.skills
            ],
        }

    def _entry_name(self, index: int) -> str:
        names = self._problem.state_names
        return names[index] if index < len(names) else f"state[{index}]"
