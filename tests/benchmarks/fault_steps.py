"""Ten thousand random steps with faults around the Franka: how many motions nobody approved? The bar is none.

What is real: the gate, the robot worker's own door and stop latch, the Franka adapter with its limits, its dead-man
timer, the skills and the video of each motion. The backend and the cameras are doubles without physics
(`tests/simulators/still_arm.py`, `still_worker.py`), which makes as many steps possible, and which keeps every order
that would have moved a real arm. The store and the service's processes aren't part of it:
`tests/server/test_invariants.py` breaks those.
"""

from __future__ import annotations

import contextlib
import math
import time
from collections import Counter
from collections.abc import Callable, Iterator
from typing import TypeVar
from unittest import mock

import numpy as np

from robot_adapters.base import AdapterError, Array, SkillCall, check_call
from robot_adapters.franka import arm, dead_man
from robot_adapters.franka.backend import Mode
from robot_adapters.registry import task
from server import gate
from server.schemas import Lifecycle, Verdict
from server.schemas import Mode as ExperimentMode
from server.workers import robot as worker
from server.workers.channel import Refusal
from tests.benchmarks.result import Result
from tests.simulators.still_arm import StillArm
from tests.simulators.still_worker import HIGH, LOW, StillEyes, still_worker

T = TypeVar("T")

STEPS = 10_000
TASK = task("stacking")
ATTENDED = 0.05
"""s without word of the operator after which a motion ends: shorter than a real one's, so that it happens often."""


def run() -> Result:
    """One arm, one worker, one long random day; the value is how many orders nobody had approved."""
    began = time.monotonic()
    day = Day(np.random.default_rng(7))
    with day.opened():
        for _ in range(STEPS):
            day.step()
    seconds = time.monotonic() - began
    lines = [
        f"{STEPS} steps in {seconds:.0f} s; {day.executed} approved motions ran, {day.refused} were refused at a door, "
        f"{day.homes} went home",
        "steps: " + ", ".join(f"{count} {name}" for name, count in day.kinds.most_common()),
        "faults during motions: " + ", ".join(f"{count} {name}" for name, count in day.faults.most_common()),
        "they ended: " + ", ".join(f"{count} {name}" for name, count in day.ends.most_common()),
        *day.wrong[:10],
    ]
    unapproved = len(day.wrong)
    return Result("fault_steps", unapproved, "unapproved orders", bar=0, ok=unapproved == 0, lines=tuple(lines))


class Day:
    """Whatever may happen to one arm. `wrong` tells every order that nobody had approved."""

    def __init__(self, chance: np.random.Generator) -> None:
        self.chance = chance
        self.arm, self.eyes = StillArm(), StillEyes(("left", "right"))
        self.kinds: Counter[str] = Counter()
        self.faults: Counter[str] = Counter()
        self.ends: Counter[str] = Counter()
        self.wrong: list[str] = []
        self.executed = self.refused = self.homes = 0
        self._proposal = 0
        self._last: dict[str, object] | None = None

    @contextlib.contextmanager
    def opened(self) -> Iterator[None]:
        """The worker with its adapter. What waits in real time waits shorter, or 10,000 steps would take a day."""
        with contextlib.ExitStack() as stack:
            for patched in (
                mock.patch.object(arm, "POLL", 0.0),
                mock.patch.object(arm, "SILENCE", 0.01),
                mock.patch.object(arm, "PERIOD", 0.05),
                mock.patch.object(dead_man, "LOOK", 0.01),
                mock.patch.object(worker, "FRAME_INTERVAL", 0.0),  # a picture after every set-point
            ):
                stack.enter_context(patched)
            self.worker = stack.enter_context(still_worker(self.arm, self.eyes, attended=ATTENDED, dead_man=0.1))
            self.robot = self.worker.robot
            yield

    def step(self) -> None:
        """One thing that happens. Orders come of an approved call or of an operator's wish to go home, else never."""
        kinds: dict[str, tuple[float, Callable[[], bool]]] = {
            "decided by the gate": (0.45, self.decide),
            "sent without approval": (0.2, self.forge),
            "something breaks at rest": (0.07, self.breaks),
            "somebody mends it": (0.18, self.mend),
            "only looked at": (0.07, self.look),
            "home asked for": (0.03, self.home),
        }
        name = str(self.chance.choice(list(kinds), p=[share for share, _ in kinds.values()]))
        self.kinds[name] += 1
        before, place = len(self.arm.orders), self.arm.position.copy()
        approved = kinds[name][1]()
        orders = self.arm.orders[before:]
        moved = not np.array_equal(place, self.arm.position)
        if (orders or moved) and not approved:
            self.wrong.append(f"{name}: {len(orders)} orders, the first {orders[0] if orders else 'a motion'}")
        for order in orders:
            if order.place is not None and not self._allowed(order.place):
                self.wrong.append(f"{name}: a goal at {order.place.round(3).tolist()} lies outside of the workspace")
        del self.arm.orders[:]

    # what may happen; each tells whether orders may follow

    def decide(self) -> bool:
        """A verdict comes in. The gate decides, and what it lets through is sent, while anything may happen."""
        call, facts = self._call(), self._facts()
        facts["workspace_ok"] = self._inside(call)
        sent = gate.decide(**facts).allowed  # type: ignore[arg-type]
        # said a second time, in other words than the gate's
        good = (
            facts["verdict"] is Verdict.GOOD
            and facts["mode"] is ExperimentMode.EXECUTE_APPROVED
            and facts["lifecycle"] is Lifecycle.RUNNING
            and facts["operator_present"]
            and facts["observation_current"]
            and facts["rule_stands"]
            and not facts["unclear"]
            and self._inside(call)
            and not (facts["halted"] or facts["by_critic"] or facts["gold"])
        )
        if not sent:
            return False
        self._proposal += 1
        request = self._request(call, self._proposal)
        may = bool(good) and not self._stopped
        self._send(request, attended=self.chance.random() < 0.9, trouble=True)
        self._last = request
        return may

    def forge(self) -> bool:
        """A call reaches the worker although nobody approved it, or not so: every one must be refused there."""
        call = self._call()
        request = self._request(call, self._proposal + 1)
        match int(self.chance.integers(5)):
            case 0:
                request["proposal_id"] = None
            case 1:
                request["execution_id"] = None
            case 2:  # parameters, however little, other than the approved
                request["parameters"] = [float(p) + float(self.chance.uniform(-0.02, 0.02)) for p in call.parameters]
                if request["parameters"] == list(call.parameters):
                    return False
            case 3:  # a proposal that has had its execution: as after a crash, or a message that comes twice
                if self._last is None:
                    return False
                request = self._last
            case _:
                request["robot"] = 1
        self._send(request, attended=True, trouble=False)
        return False

    def breaks(self) -> bool:
        """Something breaks while nothing moves."""
        match int(self.chance.integers(9)):
            case 0:
                self.arm.mode = self._one_of((Mode.REFLEX, Mode.USER_STOPPED, Mode.DISCONNECTED))
            case 1:
                self.arm.there = False
            case 2:
                self.arm.frozen = True
            case 3:
                self.eyes.lost = True
            case 4:
                self.arm.newtons = float(self.chance.uniform(0.0, 60.0))
            case 5:
                self.eyes.gone = True
            case 6:
                self.eyes.broken = True
            case 7:
                self.arm.stuck = True
            case _:
                self._press_stop()
        return False

    def mend(self) -> bool:
        """An operator recovers, re-arms or releases; the arm must not move by that."""
        if self.chance.random() < 0.5:
            self._told(self.robot.recover)
        if self.chance.random() < 0.9:
            self.robot.rearm(upto=self.worker.stops)
            self._stopped = False
        if self.chance.random() < 0.9:
            self.arm.mode, self.arm.there, self.arm.frozen, self.arm.newtons = Mode.IDLE, True, False, 0.0
            self.arm.stuck = False
            self.eyes.lost = self.eyes.gone = self.eyes.broken = False
        return False

    def look(self) -> bool:
        """What is asked all day long."""
        for ask in (self.robot.refresh, self.robot.observe, lambda: self.robot.reset(seed=None)):
            self._told(ask)
        return False

    def home(self) -> bool:
        """An operator asks for it: the one motion without a proposal. Anything may happen meanwhile."""
        self._attend()
        latched = self._stopped
        kind, late = self._driven(lambda: self._told(self.robot.home), attended=True, trouble=True, most=60)
        self.homes += bool(self.arm.orders)
        self._must_have_ended(f"home, {kind}", kind, late)
        return not latched

    # their parts

    _stopped = False

    def _told(self, ask: Callable[[], object]) -> None:
        with contextlib.suppress(AdapterError, Refusal):
            ask()

    def _send(self, request: dict[str, object], *, attended: bool, trouble: bool) -> None:
        """To the worker. While it moves, something may happen after so many looks at whether to stop."""
        if attended:
            self._attend()
        before = len(self.arm.orders)

        def ask() -> None:
            try:
                result = self.robot.execute(**request)  # type: ignore[arg-type]
            except (Refusal, AdapterError) as error:
                self.refused += 1
                if len(self.arm.orders) > before:
                    self.wrong.append(f"refused after {len(self.arm.orders) - before} orders: {error}")
            else:
                self.executed += 1
                self.ends[str(result["end"])] += 1

        kind, late = self._driven(ask, attended=attended, trouble=trouble, most=250)
        self._must_have_ended(kind, kind, late)

    def _driven(self, ask: Callable[[], object], *, attended: bool, trouble: bool, most: int) -> tuple[str, int]:
        """Ask for a motion, in which something happens at one of the `most` first looks at whether to stop.

        What that was, and how many orders came after it.
        """
        happens, looks = int(self.chance.integers(1, most)), 0
        kind = str(self.chance.choice(["nothing", *_TROUBLE])) if trouble else "nothing"
        must_stop, since = self.robot._must_stop, None

        def asked() -> bool:
            nonlocal looks, since
            looks += 1
            if looks == happens and kind != "nothing":
                self.faults[kind] += 1
                _TROUBLE[kind](self)
                since = len(self.arm.orders)
            if attended and kind != "the operator leaves":
                self._attend()
            return must_stop()

        with mock.patch.object(self.robot, "_must_stop", asked):
            ask()
        if since is None:
            return "nothing", 0
        return kind, len([order for order in self.arm.orders[since:] if order.what != "begin"])

    def _must_have_ended(self, what: str, kind: str, late: int) -> None:
        # the set-point on its way when it happened, and the one that holds still
        if kind in _MUST_END and late > 2:
            self.wrong.append(f"{what}: {late} orders afterwards")
        if self.arm.driven:
            self.wrong.append(f"{what}: the arm is still under control")

    def _request(self, call: SkillCall, proposal: int) -> dict[str, object]:
        return {
            "proposal_id": proposal,
            "execution_id": proposal,
            "digest": call.digest,
            "skill": call.skill,
            "parameters": list(call.parameters),
            "video": True,
        }

    def _facts(self) -> dict[str, object]:
        """What the gate is asked with: mostly all is well, and any of it may be otherwise."""
        usual = self.chance.random() < 0.6

        def other(share: float) -> bool:
            return not usual and bool(self.chance.random() < share)

        return {
            "mode": ExperimentMode.PROPOSE_ONLY if other(0.2) else ExperimentMode.EXECUTE_APPROVED,
            "by_critic": other(0.1),
            "auto_approval": other(0.5),
            "gold": other(0.1),
            "verdict": self._one_of((None, Verdict.BAD, Verdict.NEUTRAL)) if other(0.3) else Verdict.GOOD,
            "lifecycle": self._one_of(tuple(Lifecycle)) if other(0.2) else Lifecycle.RUNNING,
            "halted": other(0.1),
            "simulated": False,
            "operator_present": not other(0.2),
            "observation_current": not other(0.1),
            "rule_stands": not other(0.1),
            "unclear": "not everything is in sight" if other(0.1) else "",
        }

    def _one_of(self, things: tuple[T, ...]) -> T:
        return things[int(self.chance.integers(len(things)))]

    def _call(self) -> SkillCall:
        """Anything a learner may come up with: mostly inside the task's bounds, and what is no number at all."""
        spec = TASK.skills[int(self.chance.integers(len(TASK.skills)))]
        values = spec.denormalise(self.chance.uniform(-1.0, 1.0, len(spec.parameters)))
        if self.chance.random() < 0.1:
            values[int(self.chance.integers(len(values)))] = self.chance.choice([math.nan, math.inf, 3.0, -0.5])
        return SkillCall(spec.name, tuple(float(v) for v in values))

    def _inside(self, call: SkillCall) -> bool:
        try:
            check_call(call, TASK.skills)
        except AdapterError:
            return False
        return True

    def _allowed(self, place: Array) -> bool:
        """Within the workspace, and the centimetre by which a goal may lie aside to take out what stays missing."""
        return bool((place >= np.array(LOW) - 0.011).all() and (place <= np.array(HIGH) + 0.011).all())

    def _attend(self) -> None:
        self.worker.attend()

    def _press_stop(self) -> None:
        self._stopped = True
        self.worker.stop()

    def _in_mode(self, mode: Mode) -> None:
        self.arm.mode = mode

    def _sleep(self) -> None:
        time.sleep(0.15)  # past the dead-man timer

    def _hand_gone(self) -> None:
        self.arm.there = False

    def _freeze(self) -> None:
        self.arm.frozen = True

    def _push(self) -> None:
        self.arm.newtons = 30.0

    def _lose_cameras(self) -> None:
        self.eyes.gone = True

    def _jam(self) -> None:
        self.arm.stuck = True

    def _break_eyes(self) -> None:
        self.eyes.broken = True


_TROUBLE: dict[str, Callable[[Day], None]] = {
    "stop": Day._press_stop,
    "reflex": lambda day: day._in_mode(Mode.REFLEX),
    "user stop": lambda day: day._in_mode(Mode.USER_STOPPED),
    "cable pulled": lambda day: day._in_mode(Mode.DISCONNECTED),
    "hand gone": Day._hand_gone,
    "states stand still": Day._freeze,
    "driver frozen": Day._sleep,
    "pushed": Day._push,
    "fingers stuck": Day._jam,
    "camera gone": Day._lose_cameras,
    "eyes broken": Day._break_eyes,
    "the operator leaves": lambda _: time.sleep(ATTENDED + 0.01),
}
_MUST_END = frozenset(_TROUBLE) - {"pushed", "fingers stuck", "camera gone", "eyes broken"}
"""After these no set-point may follow but the one on its way and the one that holds still; a push brakes by some,
fingers end a motion where they are told to move, and none of it rests on a picture. Whatever happened, nothing may be
under control after its end."""
