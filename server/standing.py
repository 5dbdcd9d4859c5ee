"""Where one experiment stands: what is stored, what goes on right now, and what is true but not stored yet."""

from __future__ import annotations

import contextlib
from collections.abc import Callable

from server import lifecycle
from server.crew import Crew
from server.messages import ExperimentChanged, StreamEvent
from server.owed import Owed
from server.schemas import Experiment, Lifecycle, Phase
from server.store import Conflict, Store, StoreError

_MOST_TOLD = (
    Phase.EVALUATING,
    Phase.AWAITING_FEEDBACK,
    Phase.EXECUTING,
    Phase.DECIDING,
    Phase.PROPOSING,
    Phase.OBSERVING,
    Phase.LEARNING,
    Phase.STARTING,
    Phase.IDLE,
)
"""Where robots do different things, the first of these that one of them does is the experiment's phase."""


class Standing:
    """The experiment as everyone is told of it. A stop and a failure count from when they happen, stored or not."""

    def __init__(
        self,
        experiment: Experiment,
        store: Store,
        crew: Crew,
        *,
        publish: Callable[[StreamEvent], None],
    ) -> None:
        self._stored = experiment
        self._store = store
        self._publish = publish
        self._crew = crew
        self._failure: str | None = None
        self._phases = [experiment.phase] * experiment.num_envs
        self.owed = Owed(experiment.id)

    @property
    def experiment(self) -> Experiment:
        """As it is now."""
        return self.live(self._stored)

    @property
    def phase(self) -> Phase:
        """What goes on right now."""
        return min(self._phases, key=_MOST_TOLD.index)

    def phase_of(self, robot: int) -> Phase:
        """What goes on with this robot right now."""
        return self._phases[robot]

    def live(self, stored: Experiment) -> Experiment:
        """A stored state, with what the store doesn't know."""
        now: dict[str, object] = {"phase": self.phase, "catching_up": self._crew.recollection.progress}
        ran = stored.lifecycle is Lifecycle.RUNNING
        if self._crew.halted:
            now |= {"halted": True} | ({"lifecycle": Lifecycle.PAUSED} if ran else {})
        if self._failure is not None and ran:
            now |= {"lifecycle": Lifecycle.FAILED, "failure": self._failure}
        return stored.model_copy(update=now)

    def changed(self, stored: Experiment) -> None:
        """Take over what is stored, unless something newer is known, and tell everyone."""
        if stored.updated_at >= self._stored.updated_at:
            self._stored = stored
            self.tell()

    def tell(self) -> None:
        """Tell everyone how it stands."""
        self._publish(ExperimentChanged(experiment=self.experiment))

    def enter(self, phase: Phase, robot: int) -> None:
        """Change the live phase of a robot, and tell everyone if the experiment's changes with it."""
        before, self._phases[robot] = self.phase, phase
        if self.phase is not before:
            self.tell()

    def must_be_armed(self, verb: lifecycle.Verb) -> None:
        """Nothing that moves is begun while a stop is latched here, whatever the database says.

        Raises:
            Conflict: one is.
        """
        if self._crew.halted:
            state = lifecycle.State(self.experiment.lifecycle, halted=True)
            raise Conflict(
                f"can't {verb} while the emergency stop is latched",
                remedy="look at the robot, then re-arm",
                current=state.lifecycle.value,
                allowed=lifecycle.allowed(state),
            )

    def owe_halt(self) -> None:
        """The robot is stopped and stays so; only the database doesn't know it yet."""
        if not self._stored.halted:
            self.owed.add("the emergency stop", self._store_halt)
            self.tell()

    async def fail(self, why: str) -> None:
        """It has failed, unless a verb that ended its run was quicker: told at once, stored when it can be."""
        try:
            with contextlib.suppress(Conflict):
                self.changed(await self._store.transition(self._stored.id, "fail", failure=why))
        except StoreError:
            if self.experiment.lifecycle is Lifecycle.RUNNING:
                self._failure = why
                self.owed.add("the failure", self._store_failure)
                self.tell()

    async def _store_halt(self) -> None:
        if self._crew.halted:  # else it was re-armed, and that is stored
            self.changed(await self._store.halt(self._stored.id))

    async def _store_failure(self) -> None:
        with contextlib.suppress(Conflict):  # a verb was quicker
            stored = await self._store.transition(self._stored.id, "fail", failure=self._failure)
            self._failure = None
            self.changed(stored)
        self._failure = None
