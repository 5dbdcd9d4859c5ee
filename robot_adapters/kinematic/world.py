"""Objects on a table and a gripper, without physics: what grasping, dropping and pushing do to positions.

Plain floats instead of arrays: a study takes hundreds of thousands of steps of a few operations each. Positions are
[x, y, z] in m, robot base frame. Objects don't turn, except that what `tips` can fall over. What isn't modelled: a
gripper that comes down beside its target knocks nothing over, it only grasps nothing.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from robot_adapters.base import Array, Scene
from robot_adapters.kinematic.shapes import Shape
from robot_adapters.skills import LOWEST
from robot_adapters.tasks import table
from robot_adapters.tasks.base import ObjectSpec

Position = list[float]

FINGER_HALF = 0.01
FINGER_BELOW = 0.009
TABLE_HALF = 0.4
FLOOR = -0.9
GAP = 0.002
DROP = 0.04
"""What tips falls over when it is dropped from higher than this, m."""


class World:
    """Where everything is, and what the fingers' acts change."""

    def __init__(self, objects: tuple[ObjectSpec, ...], table_height: float) -> None:
        self.table_height = table_height
        self.shapes = {spec.name: Shape.of(spec) for spec in objects if spec.shape != "area"}
        self.movable = [name for name, shape in self.shapes.items() if shape.movable]
        self.sliders = [name for name, shape in self.shapes.items() if shape.handle]
        self._dishes = [name for name, shape in self.shapes.items() if shape.dish]
        self.at: dict[str, Position] = {}
        self.joints: dict[str, float] = {}
        self.tilts: dict[str, float] = {}
        self.gripper: Position = [*table.CENTRE, table_height + 0.25]
        self.closed = False
        self.held: str | None = None
        self._load: list[str] = []
        """What lies on the held object and comes along."""

    def reset(self, layout: Mapping[str, Array]) -> None:
        """Put everything where `layout` says, the gripper open and empty."""
        self.at = {
            name: list(shape.fixed) if shape.fixed else [float(v) for v in layout[name]]
            for name, shape in self.shapes.items()
        }
        self.joints, self.tilts = {}, {}
        for name in self.sliders:
            self._slide(name, float(layout[name][0]))
        self.gripper = [float(v) for v in layout["gripper"]]
        self.closed, self.held, self._load = False, None, []

    def scene(self) -> Scene:
        """A snapshot."""
        return Scene(
            objects={name: np.array(self.at[name]) for name in self.movable},
            gripper=np.array(self.gripper),
            gripper_closed=self.closed,
            held=self.held,
            joints=dict(self.joints),
            tilts=dict(self.tilts),
        )

    def move(self, target: Position) -> float:
        """Take the gripper, with what it holds, towards `target`; returns how far above it contact kept it, m."""
        z = max(target[2], self._lowest(target[0], target[1]))
        self._carry([target[0], target[1], z])
        return z - target[2]

    def grasp(self) -> bool:
        """Close the fingers around the nearest object within their tolerance; whether they hold one."""
        self.closed = True
        if self.held is None:
            near = [(away, name) for name in self.movable if (away := self._graspable(name)) is not None]
            if near:
                self.held = min(near)[1]
                self._load = self._riders(self.held)
                # the fingers close along y and so centre what they hold; along x it keeps its offset
                by = self.gripper[1] - self.shapes[self.held].grip.at[1] - self.at[self.held][1]
                for name in (self.held, *self._load):
                    self.at[name][1] += by
        return self.held is not None

    def open(self) -> None:
        """Let go: what was held falls straight down, and off whatever it is not well upon."""
        self.closed = False
        if self.held is None:
            return
        name, load = self.held, self._load
        self.held, self._load = None, []
        shape, (x, y, z) = self.shapes[name], self.at[name]
        support = self._support(name, x, y, z)
        if support is None:
            stands, ground = True, self._surface(x, y)
        else:
            stands, ground = self._upon(support, x, y), self.at[support][2] + self.shapes[support].seat
            if stands and self.shapes[support].funnel[1]:
                self.at[name][1] = self.at[support][1]
        if shape.tips and (not stands or z - shape.below - ground > DROP):
            self._tip(name)
        elif stands:
            self.at[name][2] = ground + shape.below
        elif support is not None:
            self._tumble(name, support)
        for rider in load:
            self.at[rider][2] += self.at[name][2] - z

    def push(self, end: Position) -> float:
        """Move the closed fingers, or what they hold, level to `end` (along x or y), pushing what is in the way.

        Returns how far before `end` something that can't give way stopped it, m.
        """
        start = self.gripper
        axis = 0 if abs(end[0] - start[0]) >= abs(end[1] - start[1]) else 1
        sign = 1.0 if end[axis] >= start[axis] else -1.0
        if self.held is None:
            tool, half, low = self.gripper, (FINGER_HALF, FINGER_HALF), self.gripper[2] - FINGER_BELOW
        else:
            shape = self.shapes[self.held]
            tool, half, low = self.at[self.held], shape.half, self.at[self.held][2] - shape.below
        pushers = [(tool[1 - axis], half[1 - axis])]
        back = sign * tool[axis]
        front = back + abs(end[axis] - start[axis]) + half[axis]
        blocked = self._push_sliders(axis, sign, pushers[0], front, low)
        front -= blocked
        for name in sorted(self.movable, key=lambda n: sign * self.at[n][axis]):
            at, shape = self.at[name], self.shapes[name]
            depth, width = shape.half[axis], shape.half[1 - axis]
            aside = all(abs(at[1 - axis] - across) >= width + wide for across, wide in pushers)
            near = sign * at[axis] - depth
            if name == self.held or name in self._load or low > at[2] + shape.rim or aside:
                continue
            if near < back - depth or near >= front:
                continue
            if shape.tips and not self.tilts.get(name):
                self._tip(name)
            blocked = max(blocked, self._shove(name, axis, sign, front - near))
            # what it now touches is pushed by it in turn
            pushers.append((at[1 - axis], width))
            front += 2 * depth
        stop = list(end)
        stop[axis] -= sign * blocked
        # level, whatever is below: a tool glides over the lip of what it sweeps into
        self._carry([stop[0], stop[1], self.gripper[2]])
        return blocked

    def drive(self, target: Position) -> None:
        """Go to `target` without planning: sideways, pushing if the fingers are closed, then up, or down to contact."""
        if self.closed:
            for axis in (0, 1):
                end = list(self.gripper)
                end[axis] = target[axis]
                self.push(end)
        here = self.gripper
        x, y = here[:2] if self.closed else target[:2]
        # what glides over a lip isn't lifted by it
        lowest = min(self._lowest(x, y), here[2])
        self._carry([x, y, max(target[2], lowest)])

    def opening(self) -> float:
        """Distance between the fingers, m."""
        if self.held is not None:
            return min(2 * self.shapes[self.held].half[1], 0.03 if self.shapes[self.held].tips else 0.08)
        return 0.0 if self.closed else 0.08

    def _carry(self, to: Position) -> None:
        """Put the gripper there, with what it holds and what lies on that."""
        by = [a - b for a, b in zip(to, self.gripper, strict=True)]
        self.gripper = to
        if self.held is not None:
            for name in (self.held, *self._load):
                self.at[name] = [a + b for a, b in zip(self.at[name], by, strict=True)]

    def _graspable(self, name: str) -> float | None:
        """How far off its best the fingers would hold an object, or None where they wouldn't."""
        grip, at = self.shapes[name].grip, self.at[name]
        away = 0.0
        for i in range(3):
            offset = self.gripper[i] - at[i] - grip.at[i]
            if not -grip.below[i] - 1e-9 <= offset <= grip.above[i] + 1e-9:
                return None
            away += abs(offset)
        # what lies on it is in the way, unless it is held by a handle aside
        covered = grip.at[0] == grip.at[1] == 0 and self._riders(name)
        return None if covered or self.tilts.get(name) else away

    def _lowest(self, x: float, y: float) -> float:
        """How low the grip site gets at (x, y): until the fingertips, or what is held, touch something."""
        lowest = self.table_height + LOWEST
        for name in self._dishes:
            at, shape = self.at[name], self.shapes[name]
            if name != self.held and abs(x - at[0]) < shape.half[0] and abs(y - at[1]) < shape.half[1]:
                lowest = max(lowest, at[2] + self._height(name, x, y) + FINGER_BELOW)
        if self.held is None:
            return lowest
        shape, (bx, by, bz) = self.shapes[self.held], self.at[self.held]
        ox, oy, hangs = bx - self.gripper[0], by - self.gripper[1], self.gripper[2] - bz + shape.below
        support = self._support(self.held, x + ox, y + oy, math.inf)
        if support is None:
            return max(lowest, self.table_height + hangs)
        return max(lowest, self.at[support][2] + self._height(support, x + ox, y + oy) + hangs)

    def _upon(self, name: str, x: float, y: float) -> bool:
        """Whether what comes down at (x, y) rests on this object, and not on its edge."""
        shape, at = self.shapes[name], self.at[name]
        dx, dy = abs(x - at[0]), abs(y - at[1])
        seat, funnel = shape.seat_half, shape.funnel
        return (dx <= seat[0] and dy <= seat[1]) or (funnel[1] > 0 and dx <= funnel[0] and dy <= funnel[1])

    def _height(self, name: str, x: float, y: float) -> float:
        """How high above its origin this object is at (x, y), m."""
        return self.shapes[name].seat if self._upon(name, x, y) else self.shapes[name].rim

    def _support(self, name: str, x: float, y: float, z: float) -> str | None:
        """The highest object below `name` if that were at (x, y, z)."""
        half = self.shapes[name].half
        below = []
        for other, shape in self.shapes.items():
            at = self.at[other]
            if (
                abs(at[0] - x) < half[0] + shape.half[0]
                and abs(at[1] - y) < half[1] + shape.half[1]
                and at[2] + shape.seat < z + GAP
                and other not in {name, self.held}
                and other not in self._load
            ):
                below.append((at[2] + shape.seat, other))
        return max(below)[1] if below else None

    def _riders(self, name: str) -> list[str]:
        """The objects that lie on `name`."""
        x, y, z = self.at[name]
        shape = self.shapes[name]
        found = []
        for other in self.movable:
            at, on = self.at[other], self.shapes[other]
            if (
                other != name
                and abs(at[0] - x) < shape.half[0] + on.half[0]
                and abs(at[1] - y) < shape.half[1] + on.half[1]
                and abs(at[2] - on.below - z - shape.seat) < GAP
            ):
                found.append(other)
        return found

    def _shove(self, name: str, axis: int, sign: float, by: float) -> float:
        """Push an object with what lies on it `by` m; how much of that a wall behind it didn't allow."""
        at, shape = self.at[name], self.shapes[name]
        was = self._ground(at)
        blocked = 0.0
        for other in self._dishes:
            wall, end = self.shapes[other], self.at[other]
            stop = end[axis] + sign * (wall.seat_half[axis] - shape.half[axis])
            through = sign * (at[axis] + sign * by - stop)
            if (
                not wall.movable
                and wall.rim > wall.seat
                and abs(at[1 - axis] - end[1 - axis]) < wall.half[1 - axis]
                and through > 0
                and sign * (stop - at[axis]) >= -GAP
                and at[2] - shape.below < end[2] + wall.rim
            ):
                blocked = max(blocked, through)
        riders = [rider for rider in self._riders(name) if rider != self.held]
        for moved in (name, *riders):
            self.at[moved][axis] += sign * (by - blocked)
        ground = self._ground(at)
        if abs(at[2] - shape.below - was) < GAP and ground != was:
            for moved in (name, *riders):
                self.at[moved][2] += ground - was
        return blocked

    def _push_sliders(self, axis: int, sign: float, across: tuple[float, float], front: float, low: float) -> float:
        """Push on handles towards closed; how far before the end of the push a closed one stops it, m."""
        blocked = 0.0
        for name in self.sliders:
            handle, at = self.shapes[name].handle, self.at[name]
            if handle is None or axis != 0 or sign < 0:
                continue
            level = low <= at[2] + handle.centre[2] + handle.half[2]
            beside = abs(at[1] + handle.centre[1] - across[0]) >= handle.half[1] + across[1]
            tip = at[0] + handle.centre[0] - handle.half[0]
            if not level or beside or tip >= front:
                continue
            blocked = max(blocked, front - tip - self.joints[name])
            self._slide(name, max(0.0, self.joints[name] - (front - tip)))
        return max(0.0, blocked)

    def _slide(self, name: str, opening: float) -> None:
        """Open a slider this far, with what lies in it."""
        riders = self._riders(name) if name in self.joints else []
        fixed = self.shapes[name].fixed
        if fixed is None:
            raise ValueError(f"{name} slides from nowhere: give the ObjectSpec its `fixed` place, closed")
        by = fixed[0] - opening - self.at[name][0]
        for moved in (name, *riders):
            self.at[moved][0] += by
        self.joints[name] = opening

    def _tip(self, name: str) -> None:
        """Let an object fall over, onto the table."""
        at = self.at[name]
        self.tilts[name] = math.pi / 2
        at[2] = self._surface(at[0], at[1]) + min(self.shapes[name].half)

    def _tumble(self, name: str, off: str) -> None:
        """Put `name` on the table beside `off`, on the side it hangs over, or the next one that is free."""
        x, y, _ = self.at[name]
        sx, sy, _ = self.at[off]
        shape, under = self.shapes[name], self.shapes[off]
        clear_x, clear_y = shape.half[0] + under.half[0] + GAP, shape.half[1] + under.half[1] + GAP
        over_x = abs(x - sx) - under.half[0] >= abs(y - sy) - under.half[1]
        to_x = [sx + clear_x, y] if x >= sx else [sx - clear_x, y]
        to_y = [x, sy + clear_y] if y >= sy else [x, sy - clear_y]
        sides = [to_x, to_y] if over_x else [to_y, to_x]
        for place in (*sides, [2 * sx - to_x[0], y], [x, 2 * sy - to_y[1]]):
            if self._support(name, place[0], place[1], math.inf) is None:
                break
        self.at[name] = [place[0], place[1], self._surface(place[0], place[1]) + shape.below]

    def _ground(self, at: Position) -> float:
        """The height of the low dish, the table or the floor under a position."""
        for name in self._dishes:
            shape, z = self.shapes[name], self.at[name][2]
            if z + shape.seat < at[2] and self._upon(name, at[0], at[1]):
                return z + shape.seat
        return self._surface(at[0], at[1])

    def _surface(self, x: float, y: float) -> float:
        """The height of the table, or of the floor beside it."""
        on = abs(x - table.CENTRE[0]) <= TABLE_HALF and abs(y - table.CENTRE[1]) <= TABLE_HALF
        return self.table_height if on else FLOOR
