"""A calibration with the cameras that the eyes have open already: what the operator's page leads through."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from robot_adapters.franka.perception import calibrating
from robot_adapters.franka.perception.calibrating import HandPose, Session
from robot_adapters.guiding import CameraLook, CameraResult, GuideLook, GuideResult


class Guided:
    """One calibration of these cameras (`Guide`). Each look takes a picture of every camera."""

    def __init__(
        self,
        session: Session,
        hand: HandPose,
        sources: Mapping[str, str],
        where: Path,
        stored: Callable[[], None],
    ) -> None:
        """Begin. sources: where each camera's pictures come from. stored: told once the files are written."""
        self._session, self._hand, self._sources, self._where = session, hand, sources, where
        self._stored = stored

    def look(self, *, take: bool) -> GuideLook:
        """See `Guide`."""
        step = self._session.step(self._hand, take=take)
        cameras = tuple(
            CameraLook(
                name,
                name in step.corners,
                step.taken[name],
                calibrating.preview(self._session.pictures[name], step.corners.get(name)),
            )
            for name in self._session.watches
        )
        return GuideLook(
            cameras, self._session.wanted, self._session.fewest, step.advice, step.camera, step.said, step.done
        )

    def solve(self) -> GuideResult:
        """See `Guide`."""
        self._session.solve()
        return self._result(stored=False)

    def store(self) -> GuideResult:
        """See `Guide`."""
        self._session.store(self._sources, self._where)
        self._stored()
        return self._result(stored=True)

    def _result(self, *, stored: bool) -> GuideResult:
        cameras = tuple(
            CameraResult(name, found.error, found.used, found.left_out, found.error <= calibrating.GOOD)
            for name, found in self._session.results.items()
        )
        return GuideResult(cameras, self._session.disagreement(), stored)
