"""A task with several ways to do it, none of which lies between the others: what does cloning make of that?"""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from agent.study.scenes import TwoToys, across_the_table, in_pan
from robot_adapters.base import Array, SafetyViolation, Scene, SkillCall
from robot_adapters.tasks import collecting_toy as collecting
from robot_adapters.tasks import sweeping, table
from robot_adapters.tasks.base import Subgoal, Vector
from robot_adapters.tasks.boxes import EPSILON, Box, Boxed
from robot_adapters.tasks.layout import draw
from robot_adapters.tasks.rules import misplaced

LEFT, RIGHT = "left_pan", "right_pan"
ASIDE = 0.14
"""y of the pans' middles, m, to either side: between them lies the table."""
PANS: dict[str, Vector] = {name: (0.68, y, table.HEIGHT) for name, y in ((LEFT, ASIDE), (RIGHT, -ASIDE))}
NEAR, FAR = "near_toy", "far_toy"
TOYS: dict[str, tuple[float, float]] = {NEAR: (0.38, 0.42), FAR: (0.50, 0.54)}
"""x that each toy starts between, m; y between `TOY_Y`."""
TOY_Y = (-0.10, 0.10)


class TidyUp(Boxed):
    """Two toys, two dustpans: either toy first, into either pan. What is good has two modes at each step, no middle.

    one_way: the demonstrator takes the near toy first, into the left pan; the judge still accepts every way.
    """

    name = "tidy_up"
    title = "Two toys into two dustpans"
    instruction = "Put one toy into each dustpan."
    table_height = table.HEIGHT
    horizon = 8
    objects = (
        *(dataclasses.replace(sweeping.Sweeping.objects[2], name=name, fixed=at) for name, at in PANS.items()),
        *(dataclasses.replace(collecting.CollectingToy.objects[0], name=name) for name in TOYS),
    )
    state_fields = tuple(
        field
        for name in TOYS
        for field in (
            dataclasses.replace(TwoToys.state_fields[-3], name=f"{name}_position", description="its centre"),
            dataclasses.replace(TwoToys.state_fields[-2], name=f"{name}_grasped", description="1 in the hand, else 0"),
            dataclasses.replace(TwoToys.state_fields[-1], name=f"{name}_in_pan", description="1 in a pan, else 0"),
        )
    )
    skills = across_the_table(collecting.CollectingToy.skills[0], collecting.CollectingToy.skills[2])
    subgoals = (Subgoal("pick up a toy", "pick up a toy"), Subgoal("put it away", "put it into an empty dustpan"))

    def __init__(self, *, one_way: bool = False) -> None:
        self.layout = collecting.CollectingToy().layout
        self._one_way = one_way

    def state(self, scene: Scene) -> Array:
        """(10,) of either toy x, y, z in m, base frame; whether it is held, and whether it lies in a pan."""
        parts = [(*scene.objects[name], float(scene.held == name), float(_put_away(scene, name))) for name in TOYS]
        return np.array(parts, dtype=np.float64).ravel()

    def sample_layout(self, rng: np.random.Generator) -> dict[str, Array]:
        """Both toys flat on the table, one behind the other; the gripper open and above them."""
        z = table.HEIGHT + collecting.TOY_HALF
        toys = {name: np.array([*draw(rng, x, TOY_Y), z]) for name, x in TOYS.items()}
        return toys | {"gripper": np.array(draw(rng, (0.46, 0.60), (-0.08, 0.08), table.above(0.20, 0.28)))}

    def success(self, scene: Scene) -> bool:
        """Whether each toy lies in a pan."""
        return all(_put_away(scene, name) for name in TOYS)

    def violations(self, scene: Scene) -> tuple[SafetyViolation, ...]:
        """A toy out of reach."""
        return tuple(v for name in TOYS for v in misplaced(scene, name, table.X, table.Y))

    def subgoal(self, state: Array) -> int:
        """1 while a toy is in the hand, else 0."""
        return int(state.reshape(2, 5)[:, 3].max() > 0.5)

    def boxes(self, state: Array) -> list[Box]:
        """All that is good now: a pick at each toy that isn't put away, or a place over each empty pan."""
        if self.subgoal(state):
            taken = {bool(toy[1] > 0) for toy in state.reshape(2, 5) if toy[4] > 0.5}
            free = [at for at in self.keypoints(state, "place").tolist() if (at[1] > 0) not in taken]
            return [Box("place", (x, y, z), collecting.PLACE_BELOW, collecting.PLACE_ABOVE) for x, y, z in free]
        left = [toy.tolist() for toy in state.reshape(2, 5) if toy[4] < 0.5]
        up = collecting.PICK_ABOVE_CENTRE
        return [Box("pick", (x, y, z + up), collecting.PICK_BELOW, collecting.PICK_ABOVE) for x, y, z, *_ in left]

    def box(self, state: Array) -> Box:
        """The first of the good ones; nothing is left to pick once the task is solved."""
        return (self.boxes(state) or [Box("pick", (*table.CENTRE, table.HEIGHT), (0.0,) * 3, (0.0,) * 3)])[0]

    def margin(self, state: Array, call: SkillCall) -> float:
        """Metres to the nearest face of the box that the call is deepest in, negative outside all."""
        return max((box.margin(call) for box in self.boxes(state)), default=-math.inf)

    def judge(self, state: Array, call: SkillCall) -> int:
        """+1 for a call inside any of the boxes."""
        return 1 if self.margin(state, call) >= -EPSILON else -1

    def sample_good(self, state: Array, rng: np.random.Generator) -> SkillCall:
        """A call drawn from one of the boxes: any, or the first where there is one way only."""
        boxes = self.boxes(state)
        box = boxes[0 if self._one_way else int(rng.integers(len(boxes)))]
        at = rng.uniform(np.subtract(box.centre, box.below), np.add(box.centre, box.above))
        return box.call(self._spec(box.skill), tuple(at.tolist()))

    def keypoints(self, state: Array, skill: str | None = None) -> Array:
        """(4, 3): both toys to pick, over both pans to place; with `skill`, (2, 3)."""
        lift = np.array([0.0, 0.0, collecting.PLACE_HEIGHT])
        points = {"pick": list(state.reshape(2, 5)[:, :3]), "place": [np.array(at) + lift for at in PANS.values()]}
        return np.array([at for name, all_ in points.items() if skill in {None, name} for at in all_]).reshape(-1, 3)


def _put_away(scene: Scene, name: str) -> bool:
    return any(in_pan(scene, name, pan) for pan in PANS.values())
