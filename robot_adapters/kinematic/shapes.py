"""What the world needs to know of each object: its outline, where it is held, and where others rest on it."""

from __future__ import annotations

from dataclasses import dataclass

from robot_adapters.tasks.base import Grip, ObjectSpec, Part, Vector

# what the Panda's fingers (8 cm open, 2 cm wide, 2 cm of pad) forgive around a block's centre, m
GRASP_XY = 0.02
GRASP_Z = 0.015
BLOCK_GRIP = Grip((0.0, 0.0, 0.0), (GRASP_XY, GRASP_XY, GRASP_Z), (GRASP_XY, GRASP_XY, GRASP_Z))


@dataclass(frozen=True, slots=True)
class Shape:
    """An object as an upright box of half sizes `half` (x, y). All lengths in m, heights from its origin.

    below: how far down it reaches. rim: how high. seat: height of the place where others rest, with half sizes
    `seat_half` (negative: nothing rests there) and `funnel` (`Seat`). dish: whether fingers can touch the seat.
    """

    half: tuple[float, float]
    below: float
    rim: float
    seat: float
    seat_half: tuple[float, float]
    funnel: tuple[float, float] = (0.0, 0.0)
    grip: Grip = BLOCK_GRIP
    movable: bool = True
    dish: bool = False
    tips: bool = False
    fixed: Vector | None = None
    handle: Part | None = None

    @classmethod
    def of(cls, spec: ObjectSpec) -> Shape:
        """The shape of a task's object."""
        if spec.shape == "block":
            half = spec.half_size
            return cls((half, half), half, half, half, (half, half), grip=spec.grip or BLOCK_GRIP, tips=spec.tips)
        rim = spec.half[2] + spec.middle[2]
        seat = spec.seat
        return cls(
            half=spec.half[:2],
            below=spec.half[2] - spec.middle[2],
            rim=rim,
            seat=seat.at[2] if seat else rim,
            seat_half=seat.half if seat else (-1.0, -1.0),
            funnel=seat.funnel if seat else (0.0, 0.0),
            grip=spec.grip or BLOCK_GRIP,
            movable=spec.movable,
            dish=seat is not None,
            tips=spec.tips,
            fixed=spec.fixed,
            handle=spec.handle,
        )
