"""Blocks on a table and a gripper, without physics: what grasping, dropping and pushing do to positions.

Plain floats instead of arrays: a study takes hundreds of thousands of steps of a few operations each. Positions are
[x, y, z] in m, robot base frame. Blocks don't turn. What isn't modelled: a gripper that comes down beside its target
knocks nothing over, it only grasps nothing.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from robot_adapters.base import Array, Scene
from robot_adapters.skills import LOWEST
from robot_adapters.tasks import table
from robot_adapters.tasks.base import ObjectSpec

Position = list[float]

# what the Panda's fingers (8 cm open, 2 cm wide, 2 cm of pad) forgive around a block's centre, m
GRASP_XY = 0.02
GRASP_Z = 0.015
FINGER_HALF = 0.01
FINGER_BELOW = 0.009
TABLE_HALF = 0.4
FLOOR = -0.9
GAP = 0.002


class World:
    """Where everything is, and what the fingers' acts change."""

    def __init__(self, objects: tuple[ObjectSpec, ...], table_height: float) -> None:
        self.table_height = table_height
        self.half = {spec.name: spec.half_size for spec in objects if spec.shape == "block"}
        self.blocks: dict[str, Position] = {}
        self.gripper: Position = [*table.CENTRE, table_height + 0.25]
        self.closed = False
        self.held: str | None = None

    def reset(self, layout: Mapping[str, Array]) -> None:
        """Put everything where `layout` says, the gripper open and empty."""
        self.blocks = {name: [float(v) for v in layout[name]] for name in self.half}
        self.gripper = [float(v) for v in layout["gripper"]]
        self.closed, self.held = False, None

    def scene(self) -> Scene:
        """A snapshot."""
        return Scene(
            objects={name: np.array(at) for name, at in self.blocks.items()},
            gripper=np.array(self.gripper),
            gripper_closed=self.closed,
            held=self.held,
        )

    def move(self, target: Position) -> float:
        """Take the gripper, with what it holds, towards `target`; returns how far above it contact kept it, m."""
        z = max(target[2], self._lowest(target[0], target[1]))
        dx, dy, dz = target[0] - self.gripper[0], target[1] - self.gripper[1], z - self.gripper[2]
        self.gripper = [target[0], target[1], z]
        if self.held is not None:
            x, y, height = self.blocks[self.held]
            self.blocks[self.held] = [x + dx, y + dy, height + dz]
        return z - target[2]

    def grasp(self) -> bool:
        """Close the fingers around the nearest block within their tolerance; whether they hold one."""
        self.closed = True
        if self.held is None:
            x, y, z = self.gripper
            near = [
                (abs(at[0] - x) + abs(at[1] - y) + abs(at[2] - z), name)
                for name, at in self.blocks.items()
                if abs(at[0] - x) <= GRASP_XY + 1e-9
                and abs(at[1] - y) <= GRASP_XY + 1e-9
                and abs(at[2] - z) <= GRASP_Z + 1e-9
                and not self._riders(name)
            ]
            if near:
                self.held = min(near)[1]
                # the fingers close along y and so centre what they hold; along x it keeps its offset
                self.blocks[self.held][1] = y
        return self.held is not None

    def open(self) -> None:
        """Let go: what was held falls straight down, and off whatever it is not well upon."""
        self.closed = False
        if self.held is None:
            return
        name, self.held = self.held, None
        x, y, z = self.blocks[name]
        support = self._support(name, x, y, z)
        if support is None:
            self.blocks[name] = [x, y, self._surface(x, y) + self.half[name]]
            return
        sx, sy, sz = self.blocks[support]
        if abs(x - sx) <= self.half[support] and abs(y - sy) <= self.half[support]:
            self.blocks[name] = [x, y, sz + self.half[support] + self.half[name]]
        else:
            self._tumble(name, support)

    def push(self, start: Position, end: Position) -> None:
        """Move the closed fingers from `start` to `end` (along x or y), taking along the blocks in their way."""
        self.move(start)
        axis = 0 if abs(end[0] - start[0]) >= abs(end[1] - start[1]) else 1
        sign = 1.0 if end[axis] >= start[axis] else -1.0
        pushers = [(start[1 - axis], FINGER_HALF)]
        back = sign * start[axis]
        front = sign * end[axis] + FINGER_HALF
        for name in sorted(self.blocks, key=lambda n: sign * self.blocks[n][axis]):
            at, half = self.blocks[name], self.half[name]
            level = self.gripper[2] - FINGER_BELOW <= at[2] + half
            aside = all(abs(at[1 - axis] - across) >= half + width for across, width in pushers)
            near = sign * at[axis] - half
            if name == self.held or not level or aside or near < back - half or near >= front:
                continue
            riders = [rider for rider in self._riders(name) if rider != self.held]
            shift = sign * (front - near)
            for moved in (name, *riders):
                self.blocks[moved][axis] += shift
            surface = self._surface(at[0], at[1])
            if surface < self.table_height:
                for moved in (name, *riders):
                    self.blocks[moved][2] = surface + self.half[moved]
            # what it now touches is pushed by it in turn
            pushers.append((at[1 - axis], half))
            front += 2 * half
        self.move(end)

    def opening(self) -> float:
        """Distance between the fingers, m."""
        if self.held is not None:
            return 2 * self.half[self.held]
        return 0.0 if self.closed else 0.08

    def _lowest(self, x: float, y: float) -> float:
        """How low the grip site gets at (x, y): until the fingertips, or what is held, touch something."""
        lowest = self.table_height + LOWEST
        if self.held is None:
            return lowest
        bx, by, bz = self.blocks[self.held]
        ox, oy, hangs = bx - self.gripper[0], by - self.gripper[1], self.gripper[2] - bz + self.half[self.held]
        support = self._support(self.held, x + ox, y + oy, np.inf)
        top = self.table_height if support is None else self.blocks[support][2] + self.half[support]
        return max(lowest, top + hangs)

    def _support(self, name: str, x: float, y: float, z: float) -> str | None:
        """The highest block below `name` if that were at (x, y, z)."""
        half = self.half[name]
        below = [
            (at[2], other)
            for other, at in self.blocks.items()
            if other not in {name, self.held}
            and abs(at[0] - x) < half + self.half[other]
            and abs(at[1] - y) < half + self.half[other]
            and at[2] < z
        ]
        return max(below)[1] if below else None

    def _riders(self, name: str) -> list[str]:
        """The blocks that lie on `name`."""
        x, y, z = self.blocks[name]
        half = self.half[name]
        return [
            other
            for other, at in self.blocks.items()
            if other != name
            and abs(at[0] - x) < half + self.half[other]
            and abs(at[1] - y) < half + self.half[other]
            and abs(at[2] - z - half - self.half[other]) < GAP
        ]

    def _tumble(self, name: str, off: str) -> None:
        """Put `name` on the table beside `off`, on the side it hangs over, or the next one that is free."""
        x, y, _ = self.blocks[name]
        sx, sy, _ = self.blocks[off]
        clear = self.half[name] + self.half[off] + GAP
        over_x = abs(x - sx) >= abs(y - sy)
        to_x = [sx + clear, y] if x >= sx else [sx - clear, y]
        to_y = [x, sy + clear] if y >= sy else [x, sy - clear]
        sides = [to_x, to_y] if over_x else [to_y, to_x]
        for place in (*sides, [2 * sx - to_x[0], y], [x, 2 * sy - to_y[1]]):
            if self._support(name, place[0], place[1], np.inf) is None:
                break
        surface = self._surface(place[0], place[1])
        self.blocks[name] = [place[0], place[1], surface + self.half[name]]

    def _surface(self, x: float, y: float) -> float:
        """The height of the table, or of the floor beside it."""
        on = abs(x - table.CENTRE[0]) <= TABLE_HALF and abs(y - table.CENTRE[1]) <= TABLE_HALF
        return self.table_height if on else FLOOR
