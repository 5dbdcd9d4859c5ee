"""Whether this arm, its settings and its cameras are ready, told in plain words: what `seed robot check` asks.

Everything but the dry run only looks. One finding after the other, so that the reader sees how far it came.
"""

from __future__ import annotations

import math
import platform
import socket
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path

import numpy as np

from robot_adapters.base import AdapterError, Array, EndReason, SkillCall, StopCheck, workspace
from robot_adapters.franka import FrankaSettings, connecting
from robot_adapters.franka.arm import FrankaArm
from robot_adapters.franka.backend import WORDS, ArmFault, FrankaBackend, Mode
from robot_adapters.franka.dead_man import DeadMan
from robot_adapters.franka.eyes import Hand, find_eyes
from robot_adapters.franka.limits import OUT_OF_REACH, SHOULDER, Limits, Refused, joint_limits
from robot_adapters.registry import task as task_by_name
from robot_adapters.skills import TRANSIT_CLEARANCE, run_skill
from robot_adapters.tasks.base import Task

ARM_PORT = 1337
"""libfranka's, on the control box."""
LISTENED = 1.0
"""s for which states are counted."""
NEAR_LIMIT = 0.1
"""rad from a joint's limit that are too near to begin from."""
DRY_SPEED, DRY_FORCE = 0.05, 15.0
DRY_LEG = 0.1  # m
"""m/s and N of the dry run: slow enough to jump back, and little enough to be held by hand."""
DRY_HEIGHT = TRANSIT_CLEARANCE + 0.05
"""m above the table."""
EXACT = 0.01
"""m by which an arm in good order misses a place in the air at most."""
READY_MODES = {Mode.IDLE, Mode.MOVING}
GENERATIONS = {5: "a Panda", 10: "an FR3"}


class Verdict(StrEnum):
    """How something was found."""

    GOOD = "good"
    NOTE = "note"
    BAD = "bad"
    SKIPPED = "skipped"


@dataclass(frozen=True)
class Finding:
    """One thing that was looked at: what it is, how it was found, in words, and what helps where it isn't good."""

    what: str
    verdict: Verdict
    said: str
    remedy: str = ""


def check(
    settings: FrankaSettings, task: str, *, permit: Callable[[str], bool], should_stop: StopCheck
) -> Iterator[Finding]:
    """Look at everything in turn, at last with a slow dry run above the table if `permit` says so.

    Args:
        settings: the adapter's.
        task: whose workspace and cameras are meant.
        permit: asked before anything moves, with what is about to happen.
        should_stop: ends the dry run.

    Raises:
        UnknownName: there is no such task.
    """
    chosen = task_by_name(task)
    findings: list[Finding] = []

    def told(finding: Finding) -> Finding:
        findings.append(finding)
        return finding

    if settings.realtime:
        yield told(_kernel(Path("/sys/kernel/realtime"), platform.version()))
    try:
        # listening needs no real-time kernel, and who lacks one still wants to hear of the rest
        backend = connecting.backend(settings.model_copy(update={"realtime": False}))
    except AdapterError as error:
        yield told(Finding("connection", Verdict.BAD, str(error), _why_unreachable(settings) or error.remedy))
        yield from map(told, _cameras(settings, task, None))
        return
    try:
        facts = backend.facts()
        kind = GENERATIONS.get(facts.fci or 0, "an arm")
        version = f"FCI version {facts.fci}" if facts.fci else "its version isn't told"
        said = f"{kind} at {settings.host} answers {facts.backend}: {version}, firmware: {facts.firmware}"
        yield told(Finding("connection", Verdict.GOOD, said))
        for look in (_mode, _clock, _hand):
            yield told(look(backend))
        limits = connecting.limits(settings, chosen)
        yield from map(told, _limits(backend, limits, settings, chosen))
        yield from map(told, _cameras(settings, task, backend))
        yield _dry_run(backend, limits, settings, chosen, findings, permit, should_stop)
    except ArmFault as fault:
        yield Finding("arm", Verdict.BAD, f"it broke off: {fault}", fault.remedy)
    finally:
        backend.close()


def _kernel(flag: Path, version: str) -> Finding:
    if flag.exists() or "PREEMPT_RT" in version or "PREEMPT RT" in version:
        return Finding("real-time kernel", Verdict.GOOD, "this PC has one")
    remedy = "install a PREEMPT_RT kernel and boot it; adapter.realtime=false is for simulated arms only"
    return Finding("real-time kernel", Verdict.BAD, "this PC has none, so commands may come too late", remedy)


def _why_unreachable(settings: FrankaSettings) -> str:
    """What a plain connection says more clearly than a driver; nothing for Deoxys, which has no such port."""
    if settings.backend == "deoxys":
        return ""
    try:
        socket.create_connection((settings.host, ARM_PORT), timeout=2.0).close()
    except socket.gaierror:
        return f"{settings.host!r} is no address that this PC knows: give the control box's, as Desk shows it"
    except ConnectionRefusedError:
        return f"{settings.host} is there but doesn't speak FCI: unlock the joints and activate FCI in Desk"
    except OSError:
        return (
            f"nothing answers at {settings.host}: check power, the cable to the control box (not to the arm), and "
            "that this PC has an address in the same network"
        )
    return "the control box answers, but not this driver: end other programs that use the arm; activate FCI in Desk"


def _mode(backend: FrankaBackend) -> Finding:
    state = backend.state()
    errors = f" It reports: {', '.join(state.errors)}." if state.errors else ""
    if state.mode in READY_MODES:
        return Finding("state", Verdict.GOOD, WORDS[state.mode] + errors)
    remedies = {
        Mode.REFLEX: "look at it, then press `Recover the arm` on the experiment's page, or in Desk",
        Mode.USER_STOPPED: "release the stop button, and let go of the guiding button",
    }
    return Finding("state", Verdict.BAD, WORDS[state.mode] + errors, remedies.get(state.mode, WORDS[Mode.DISCONNECTED]))


def _clock(backend: FrankaBackend) -> Finding:
    """How well states come through: the robot's clock against this PC's, and the longest wait."""
    began, first = time.monotonic(), backend.state().time
    last, newest, longest = began, first, 0.0
    while last - began < LISTENED:
        state = backend.state()
        now = time.monotonic()
        if state.time > newest:
            longest, newest, last = max(longest, now - last), state.time, now
        elif now - last > LISTENED:
            return Finding("states", Verdict.BAD, "the arm's clock stands still", WORDS[Mode.DISCONNECTED])
        else:
            time.sleep(0.0005)
    share = (newest - first) / (last - began)
    said = f"they come through; the longest wait was {1000 * longest:.0f} ms, the robot's clock ran {100 * share:.0f} %"
    if longest > 0.1 or not 0.9 <= share <= 1.1:
        remedy = "a cable straight to the control box, no switch or wireless link; end what else keeps this PC busy"
        return Finding("states", Verdict.NOTE, said, remedy)
    return Finding("states", Verdict.GOOD, said)


def _hand(backend: FrankaBackend) -> Finding:
    hand = backend.hand()
    if hand.there:
        return Finding("hand", Verdict.GOOD, f"it answers, its fingers are {1000 * hand.width:.0f} mm apart")
    remedy = "mount the Franka Hand, set it as end effector in Desk, and initialise it there"
    return Finding("hand", Verdict.BAD, "no hand answers", remedy)


def _limits(backend: FrankaBackend, limits: Limits, settings: FrankaSettings, task: Task) -> Iterator[Finding]:
    state = backend.state()
    left = [
        min(at - low, high - at)
        for at, (low, high) in zip(state.joints, joint_limits(backend.facts().fci), strict=True)
    ]
    near = [
        f"joint {number} is {np.degrees(abs(rad)):.0f}° {'from' if rad > 0 else 'beyond'} its limit"
        for number, rad in enumerate(left, start=1)
        if rad < NEAR_LIMIT
    ]
    if near:
        yield Finding(
            "joints", Verdict.BAD, "; ".join(near), "guide the arm by hand to a pose in the middle of its range"
        )
    else:
        yield Finding("joints", Verdict.GOOD, "every joint is well within its limits")
    box = f"from {_place(limits.low)} to {_place(limits.high)} m, the table at {limits.table:.3f} m"
    far = _unreachable(limits, settings, task)
    if far is not None:
        remedy = "make workspace_high smaller, or move the table nearer: the arm reaches 0.85 m from its shoulder"
        yield Finding("workspace", Verdict.BAD, f"{box}: the arm can't reach {_place(far)}", remedy)
    elif (off := np.clip(state.position, limits.low, limits.high) - state.position).any():
        said = f"{box}: the hand is {100 * np.abs(off).max():.0f} cm outside of it, at {_place(state.position)}"
        yield Finding("workspace", Verdict.NOTE, said, "only the way back in is free; check table_height and workspace")
    else:
        yield Finding("workspace", Verdict.GOOD, box)
    yield Finding(
        "speed",
        Verdict.GOOD,
        f"at most {settings.speed:g} m/s, and "
        f"{limits.approach_speed:g} m/s within {100 * limits.approach:.0f} cm of the table",
    )
    itself = f"the robot stops itself at {settings.reflex:g} N"
    if settings.backend == "deoxys":
        itself = "where the robot stops itself is set on the arm's computer, in Deoxys's own configuration"
    yield Finding("force", Verdict.GOOD, f"a skill, or the way home, ends at {settings.force:g} N; {itself}")
    if state.newtons > settings.force / 2:
        said = f"{state.newtons:.0f} N although nothing moves"
        remedy = "set the hand's mass in Desk, and take away what leans on the arm"
        yield Finding("force at rest", Verdict.BAD, said, remedy)
    else:
        yield Finding("force at rest", Verdict.GOOD, f"{state.newtons:.0f} N")


def _unreachable(limits: Limits, settings: FrankaSettings, task: Task) -> Array | None:
    """(3,) m, the farthest place that a skill may ask for, if the arm can't be there."""
    corners = workspace(task.skills)
    if corners is None:
        return None
    offset = connecting.offset(settings, task)
    low, high = (np.clip(corner + offset, limits.low, limits.high) for corner in corners)
    farthest = np.array([max((low[i], high[i]), key=lambda v: abs(v - SHOULDER[i])) for i in range(3)])
    return farthest if float(np.linalg.norm(farthest - SHOULDER)) > OUT_OF_REACH else None


def _cameras(settings: FrankaSettings, task: str, backend: FrankaBackend | None) -> Iterator[Finding]:
    try:
        eyes = find_eyes(settings.eyes)(task, settings.eyes_settings)
    except AdapterError as error:
        yield Finding("cameras", Verdict.BAD, str(error), error.remedy)
        return
    try:
        names = ", ".join(eyes.cameras) or "none"
        if refusal := eyes.refusal():
            yield Finding("cameras", Verdict.BAD, f"{names}: {refusal}", "see docs/franka-cameras.md")
            return
        for camera in eyes.cameras:
            eyes.frame(camera, still=False)
        yield Finding("cameras", Verdict.GOOD, f"{names}: each gives a picture, and is calibrated")
        if backend is not None:
            state, hand = backend.state(), backend.hand()
            missing = eyes.look(Hand(state.position, state.yaw, hand.width, closed=False)).missing
            lost = "; ".join(f"{name}: {why}" for name, why in sorted(missing.items()))
            if lost:
                yield Finding("objects", Verdict.NOTE, f"not all in sight: {lost}", "lay them out before you start")
            else:
                yield Finding("objects", Verdict.GOOD, "everything of the task is in sight")
    except AdapterError as error:
        yield Finding("cameras", Verdict.BAD, str(error), error.remedy)
    finally:
        eyes.close()


def _dry_run(  # noqa: PLR0917  each is another thing
    backend: FrankaBackend,
    limits: Limits,
    settings: FrankaSettings,
    task: Task,
    before: list[Finding],
    permit: Callable[[str], bool],
    should_stop: StopCheck,
) -> Finding:
    """Slowly over the corners of the task's workspace, well above the table."""
    wrong = [f.what for f in before if f.verdict is Verdict.BAD and f.what not in {"cameras", "objects"}]
    if wrong:
        return Finding("dry run", Verdict.SKIPPED, f"not tried, because of: {', '.join(wrong)}", "put that right first")
    corners = workspace(task.skills)
    if corners is None:
        return Finding("dry run", Verdict.SKIPPED, "this task has no workspace to try", "give --task stacking")
    question = (
        f"The arm will move at {100 * DRY_SPEED:.0f} cm/s over the corners of the workspace, "
        f"{100 * DRY_HEIGHT:.0f} cm above the table (z = {limits.table:.3f} m). "
        "Is the space free, and the stop button in your hand?"
    )
    if not permit(question):
        return Finding("dry run", Verdict.SKIPPED, "not wanted", "run it once before the first experiment")
    slow = replace(limits, speed=DRY_SPEED, approach_speed=min(limits.approach_speed, DRY_SPEED), force=DRY_FORCE)
    arm = FrankaArm(backend, slow, offset=connecting.offset(settings, task))
    dead_man = DeadMan(arm, settings.dead_man)
    try:
        return _over_corners(arm, dead_man.guarding(should_stop), corners, task)
    finally:
        dead_man.rest()
        arm.halt()
        dead_man.close()


def _over_corners(arm: FrankaArm, should_stop: StopCheck, corners: tuple[Array, Array], task: Task) -> Finding:
    low, high = corners
    height = task.table_height + DRY_HEIGHT
    route = [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]
    reach = next((s for s in task.skills if len(s.parameters) >= 3), None)
    assert reach is not None  # a task with a workspace has a skill with a position
    spec = replace(reach, name="reach", parameters=reach.parameters[:3], yaw=None)
    arm.should_stop = should_stop
    worst, hardest, began = 0.0, 0.0, time.monotonic()

    def felt() -> None:
        nonlocal hardest
        hardest = max(hardest, arm.state.newtons)

    for place in _in_short_legs(arm.pose()[0], [np.array([x, y, height]) for x, y in route]):
        try:
            arm.begin()
            end, _ = run_skill(
                arm, SkillCall("reach", tuple(map(float, place))), spec, should_stop=should_stop, on_step=felt
            )
        except (ArmFault, Refused) as fault:
            return Finding("dry run", Verdict.BAD, f"on the way to {_place(place)}: {fault}", fault.remedy)
        if end is EndReason.STOPPED:
            return Finding("dry run", Verdict.SKIPPED, "stopped", "start it again when all is clear")
        if end is not EndReason.ARRIVED:
            why = arm.overload() or f"it ended {end}"
            remedy = "look for what is in the way or leans on the arm; set the hand's mass in Desk"
            return Finding("dry run", Verdict.BAD, f"on the way to {_place(place)}: {why}", remedy)
        worst = max(worst, float(np.linalg.norm(arm.pose()[0] - place)))
    arm.end()
    said = (
        f"four corners in {time.monotonic() - began:.0f} s, at most {1000 * worst:.0f} mm off, "
        f"at most {hardest:.0f} N at the hand"
    )
    if worst > EXACT:
        return Finding("dry run", Verdict.BAD, said, "set the hand as end effector in Desk; raise stiffness")
    return Finding("dry run", Verdict.GOOD, said)


def _in_short_legs(start: Array, route: list[Array]) -> list[Array]:
    """The same way with stops between: a skill gives up when a leg takes longer than it should at usual speed."""
    legs, here = [], start
    for there in route:
        pieces = max(1, math.ceil(float(np.linalg.norm(there - here)) / DRY_LEG))
        legs += [here + (there - here) * (piece / pieces) for piece in range(1, pieces + 1)]
        here = there
    return legs


def _place(at: Array) -> str:
    return "(" + ", ".join(f"{v:.2f}" for v in at) + ")"
