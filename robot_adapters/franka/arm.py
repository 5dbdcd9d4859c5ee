"""The `Arm` of `skills.py` over a `FrankaBackend`: one set-point after the other, by the robot's own clock."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from robot_adapters.base import Array, Unavailable
from robot_adapters.franka.backend import READY, ArmFault, ArmState, FingersFault, FrankaBackend, Goal, Mode
from robot_adapters.franka.holding import OPEN
from robot_adapters.franka.limits import Limits, Pacer

CONTROL_HZ = 20.0
PERIOD = 1.0 / CONTROL_HZ
POLL = 0.004
"""s between two looks at the arm and at `should_stop` while a set-point lasts."""
SILENCE = 0.5
"""s of real time without a new state, after which the arm counts as gone; longer where the dead-man timer is."""
HAND_PATIENCE = 6.0
"""s of the robot's clock for the fingers to open or close: all the way takes two."""
HOMING_PATIENCE = 30.0
"""s of the robot's clock for the way to the joints of home."""
HOMING_LIFT = 0.15
"""m above the table from which the way home is free."""
HOMING_SPEED = 0.05
"""m/s of the way up to there: nobody has judged it, and what is in the hand or on it may catch."""
RISING_LIMIT = 200
"""Set-points, 10 s at 20 Hz, for the way up from the table."""
HOME_NEAR = 0.02
"""rad of each joint that count as being there."""
TRIM_RATE = 1.5
"""1/s: how fast an error that stays (friction, a load) is taken out of the goal."""
TRIM_MOST = 0.010
"""m of that, at most: with what it is stiff, a few newtons."""
SETTLED = 0.02
"""m/s of the goal below which what is missing counts as an error that stays."""


class FrankaArm:
    """Moves by set-points. `should_stop` and `while_waiting` are the running skill's; set them before it."""

    def __init__(
        self, backend: FrankaBackend, limits: Limits, *, offset: Array | None = None, silence: float = SILENCE
    ) -> None:
        """Use a connected arm.

        Args:
            backend: the connection.
            limits: in the robot's base frame.
            silence: s of real time without a new state, after which the arm counts as gone.
            offset: (3,) m to add to a position of the task to get one of the robot: labs mount arms at other heights.
        """
        self.backend = backend
        self._silence = silence
        self._limits = limits
        self._offset = np.zeros(3) if offset is None else offset
        self.table_height = limits.table - float(self._offset[2])
        if not backend.hand().there:
            backend.close()
            raise Unavailable(
                "the arm has no hand that answers",
                remedy="mount the Franka Hand, set it as end effector in Desk, and initialise it there",
            )
        self._state = backend.state()
        self._pacer: Pacer | None = None
        # whatever they were asked last, by whomever: also an object that they hold keeps them from being open
        self._closed = backend.hand().width < OPEN
        self._trim = np.zeros(3)
        self._overload: str | None = None
        self.should_stop: Callable[[], bool] = lambda: False
        self.while_waiting: Callable[[], None] = lambda: None

    # the Arm of skills.py, in the task's frame

    def pose(self) -> tuple[Array, float]:
        """Grip site (3,) m and yaw in rad."""
        return self._state.position - self._offset, self._state.yaw

    def gripper_width(self) -> float:
        """Distance between the fingers, m."""
        return self.backend.hand().width

    def gripper_closed(self) -> bool:
        """Whether the fingers were last commanded to close."""
        return self._closed

    def step(self, target: Array, yaw: float, gripper_closed: bool) -> None:
        """Hold the set-point for one control period of the robot's clock, longer where the fingers move.

        Raises:
            ArmFault: the arm has stopped itself, was stopped, or is gone; or the fingers didn't move as they were told.
            Refused: the set-point isn't within the limits.
        """
        if self.should_stop():
            self.halt()
            return
        pacer = self._controlling()
        goal = pacer.next(self._state, target + self._offset, yaw)
        trim = self._correct(goal)
        self.backend.track(replace(goal, position=goal.position + trim, braked=goal.braked + trim))
        if gripper_closed != self._closed:
            self._closed = gripper_closed
            (self.backend.grasp if gripper_closed else self.backend.open)()
            self._wait(lambda _: not self.backend.hand().busy, HAND_PATIENCE, "the fingers don't arrive")
            if self.should_stop():
                self.halt()
                return
            self._fingers_must_have_obeyed()
        until = self._state.time + PERIOD
        self._wait(lambda state: state.time >= until, SILENCE + PERIOD, "")

    def overload(self) -> str | None:
        """A force that was beyond its limit since the last set-point, in words."""
        return self._overload

    # around them

    @property
    def state(self) -> ArmState:
        """What was seen last."""
        return self._state

    def look(self) -> ArmState:
        """The arm now."""
        self._state = self.backend.state()
        return self._state

    def lost(self, mode: Mode) -> None:
        """Note that it doesn't answer, so that what it tells of itself is so."""
        self._state = replace(self._state, mode=mode, errors=())

    def recover(self) -> None:
        """Clear a reflex; returns once the arm says that it is well.

        Raises:
            ArmFault: it can't be cleared.
        """
        self.backend.recover()
        until = time.monotonic() + self._silence
        while self.look().mode is Mode.REFLEX and time.monotonic() < until:
            time.sleep(POLL)
        self._must_be_well(self._state)

    def begin(self) -> None:
        """Look before a skill.

        Raises:
            ArmFault: the arm can't be used now.
        """
        self._overload = None
        self._must_be_well(self.look())
        self._closed = self.backend.hand().width < OPEN  # somebody may have moved them by hand

    def end(self) -> None:
        """Give control back after a skill."""
        if self._pacer is not None:
            self._pacer = None
            self.backend.end()

    def halt(self) -> None:
        """Stop at once."""
        self._pacer = None
        self.backend.halt()

    def rise(self, height: float) -> bool:
        """Straight up to so many m above the table, if it is lower; False if it was stopped, or held back, on the way.

        Raises:
            ArmFault, Refused: as `step`.
        """
        free = self._limits.table + height
        here = self._state.position[:2].copy()
        for _ in range(RISING_LIMIT):
            if self._state.position[2] >= free - 0.005:
                return True
            self.step(np.array([*here, free]) - self._offset, self._state.yaw, self._closed)
            if self.should_stop() or self._overload is not None:
                return False
        return False

    def home(self) -> bool:
        """Slowly straight up where it is low, then to the joints of home.

        False if it was stopped on the way, or pushes against something, which `overload` tells: it stands still then.
        Only the way up is held to the workspace: on the way of the joints nobody calculates where the hand passes.

        Raises:
            ArmFault, Refused: as `step`; or it doesn't arrive.
        """
        state = self.look()
        self._must_be_well(state)
        self.end()
        usual = self._limits
        self._limits = replace(usual, speed=min(usual.speed, HOMING_SPEED))
        try:
            if not self.rise(HOMING_LIFT):
                return False
        finally:
            self._limits = usual
        self.end()
        self.backend.start_joints(READY)
        self._wait(
            lambda _: self._overload is not None or self.backend.joints_arrived(),
            HOMING_PATIENCE,
            "the arm doesn't come home",
        )
        if self._overload is not None:
            self.halt()
            return False
        return not self.should_stop() and bool((np.abs(self._state.joints - READY) < HOME_NEAR).all())

    def _controlling(self) -> Pacer:
        """Have control; the goal begins where the arm is."""
        if self._pacer is None:
            self._must_be_well(self.look())
            self.backend.begin()
            self._pacer = Pacer(self._limits, self.look(), PERIOD)
            self._trim[:] = 0.0
        return self._pacer

    def _correct(self, goal: Goal) -> Array:
        """(3,) m that take out what stays missing once the goal rests; none where something is pushed against."""
        if float(np.linalg.norm(goal.velocity)) > SETTLED or self._state.newtons > self._limits.force / 2:
            self._trim = 0.7 * self._trim
        else:
            missing = goal.position - self._state.position
            self._trim = np.clip(self._trim + TRIM_RATE * PERIOD * missing, -TRIM_MOST, TRIM_MOST)
        return self._trim

    def _wait(self, done: Callable[[ArmState], bool], patience: float, what: str) -> None:
        """Look at the arm until `done`, a stop, or `patience` s of the robot's clock are over."""
        began, heard, since = self._state.time, self._state.time, time.monotonic()
        while True:
            state = self.look()
            self._must_be_well(state)
            if state.newtons > self._limits.force and self._overload is None:
                self._overload = f"the hand pushes with {state.newtons:.0f} N, more than {self._limits.force:.0f} N"
                self._yield(state)
            if done(state):
                return
            if self.should_stop():
                self.halt()
                return
            now = time.monotonic()
            if state.time > heard:
                heard, since = state.time, now
            elif now - since > self._silence:
                raise ArmFault("the arm's clock stands still", mode=Mode.DISCONNECTED)
            if state.time - began > patience:
                raise ArmFault(what or "the arm doesn't follow", mode=state.mode, remedy="look at it, then try again")
            self.while_waiting()
            time.sleep(POLL)

    def _fingers_must_have_obeyed(self) -> None:
        """See what came of the last command, whatever the hand says of it: only the width is sure."""
        width = self.backend.hand().width
        if self._closed == (width < OPEN):
            return
        told = "close" if self._closed else "open"
        raise FingersFault(
            f"the fingers didn't {told}: they are {1000 * width:.0f} mm apart",
            mode=self._state.mode,
            remedy="see what keeps them from it; in Desk, initialise the hand anew if it doesn't move; then resume",
        )

    def _yield(self, state: ArmState) -> None:
        """Stay here instead of pushing on; what asks `overload` then ends the skill."""
        if self._pacer is not None:
            self._pacer.rest(state)
            self.backend.track(Goal(state.position, np.zeros(3), state.position, self._pacer.yaw))

    def _must_be_well(self, state: ArmState) -> None:
        if not self.backend.hand().there:
            raise ArmFault("the hand doesn't answer any more", mode=Mode.DISCONNECTED)
        if state.mode in {Mode.IDLE, Mode.MOVING}:
            return
        self._pacer = None
        why = f": {', '.join(state.errors)}" if state.errors else ""
        raise ArmFault(f"the arm is in state {state.mode}{why}", mode=state.mode)
