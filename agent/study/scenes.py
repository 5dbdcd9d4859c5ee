"""Scenes and orders that no built-in task has, put together from the objects and rules of those that exist.

Not installed as tasks: they are for asking what a learner of the built-in ones can do where it was never trained.
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from robot_adapters.base import Array, ParameterSpec, SafetyViolation, Scene, SkillSpec
from robot_adapters.tasks import collecting_toy as collecting
from robot_adapters.tasks import cooking_hotdog as hotdog
from robot_adapters.tasks import stacking, sweeping, table
from robot_adapters.tasks.base import ObjectSpec, StateField, Subgoal, Vector
from robot_adapters.tasks.boxes import Box, Boxed
from robot_adapters.tasks.layout import draw
from robot_adapters.tasks.rules import TILTED, misplaced

WORKSPACE = {"x": table.X, "y": table.Y, "z": table.Z}


def across_the_table(*skills: SkillSpec) -> tuple[SkillSpec, ...]:
    """The same skills, their positions bounded by the table's workspace instead of by one task's scene."""

    def widened(p: ParameterSpec) -> ParameterSpec:
        low, high = WORKSPACE.get(p.name, (p.low, p.high))
        return dataclasses.replace(p, low=low, high=high)

    return tuple(dataclasses.replace(s, parameters=tuple(map(widened, s.parameters))) for s in skills)


C = "block_c"
ON_A = 2 * stacking.HALF_A + 0.002
"""C's centre is let go so far above A's; `stacking.PLACE_ABOVE` is the same for A and B."""


class ThreeBlocks(Boxed):
    """A goes on B, then C on A: twice what Stacking asks, the second time one storey higher."""

    name = "three_blocks"
    title = "Three blocks"
    instruction = "Stack the red block on the green one, then the blue block on the red one."
    table_height = table.HEIGHT
    horizon = 2 * stacking.Stacking.horizon
    objects = (*stacking.Stacking.objects, ObjectSpec(C, "block", stacking.HALF_A, (0.13, 0.36, 0.85)))
    state_fields = (
        *stacking.Stacking.state_fields,
        dataclasses.replace(
            stacking.Stacking.state_fields[0], name=f"{C}_position", description="centre of the small blue block"
        ),
    )
    skills = across_the_table(*stacking.Stacking.skills)
    subgoals = (
        *stacking.Stacking.subgoals,
        Subgoal("pick C", "pick up the blue block"),
        Subgoal("place C", "place it on the red block"),
    )

    def __init__(self) -> None:
        self._two = stacking.Stacking()
        self.layout = self._two.layout

    def state(self, scene: Scene) -> Array:
        """(9,) centres of A, B and C, m, robot base frame."""
        return np.concatenate([scene.objects[name] for name in (stacking.A, stacking.B, C)], dtype=np.float64)

    def sample_layout(self, rng: np.random.Generator) -> dict[str, Array]:
        """As in Stacking, with C flat on the table and as far from each of the others."""
        while True:
            layout = self._two.sample_layout(rng)
            at = draw(rng, self.layout.x, self.layout.y)
            if min(math.dist(at, layout[n][:2]) for n in (stacking.A, stacking.B)) >= stacking.SEPARATION:
                return layout | {C: np.array([*at, table.HEIGHT + stacking.HALF_A])}

    def success(self, scene: Scene) -> bool:
        """Whether C rests on A, A on B, and nothing holds any."""
        s = self.state(scene)
        return scene.held is None and _rests(s[:3], s[3:6], stacking.HALF_B) and _rests(s[6:], s[:3], stacking.HALF_A)

    def violations(self, scene: Scene) -> tuple[SafetyViolation, ...]:
        """A block off the table, or where no skill of Stacking can take it."""
        names = (spec.name for spec in self.objects)
        return tuple(v for name in names for v in misplaced(scene, name, stacking.X, stacking.Y))

    def subgoal(self, state: Array) -> int:
        """0, 1 as in Stacking until A rests on B; then 2 (pick C), and 3 (place it) while C is in the hand."""
        raised = table.HEIGHT + stacking.HALF_A + stacking.RAISED
        if not _rests(state[:3], state[3:6], stacking.HALF_B):
            return int(state[2] > raised)
        return 2 + int(state[8] > raised)

    def box(self, state: Array) -> Box:
        """Pick at A or C while it is on the table, place on B or A."""
        stage = self.subgoal(state)
        x, y, z = self.keypoints(state, "place" if stage % 2 else "pick")[stage // 2].tolist()
        if stage % 2:
            return Box("place", (x, y, z), stacking.PLACE_BELOW, stacking.PLACE_OVER)
        return Box("pick", (x, y, z), stacking.PICK_BELOW, stacking.PICK_ABOVE)

    def keypoints(self, state: Array, skill: str | None = None) -> Array:
        """(4, 3): centres of A and C, and where each goes, m, robot base frame; with `skill`, (2, 3)."""
        up = np.array([0.0, 0.0, 1.0])
        points = {
            "pick": [state[:3], state[6:]],
            "place": [state[3:6] + stacking.PLACE_ABOVE * up, state[:3] + ON_A * up],
        }
        return np.array([at for name, all_ in points.items() if skill in {None, name} for at in all_]).reshape(-1, 3)


def _rests(upper: Array, lower: Array, half: float) -> bool:
    """Whether a small block's centre is where it would be on a block of this half size."""
    x, y, z = upper - lower
    return bool(math.hypot(x, y) <= stacking.STACKED_XY and abs(z - stacking.HALF_A - half) <= stacking.STACKED_Z)


STOVE_ELSEWHERE: Vector = (0.60, 0.13, table.HEIGHT)
"""8 cm nearer to the robot than the stove of Cooking-Hotdog."""
ON_IT: Vector = (*STOVE_ELSEWHERE[:2], table.HEIGHT + 2 * hotdog.STOVE_HALF[2] + hotdog.PAN_HALF_HEIGHT)
"""The skillet's origin when it stands on that stove's middle."""


class SwappedHotdog(Boxed):
    """The stove stands elsewhere, and the sausage goes into the skillet before the skillet goes on the stove."""

    name = "swapped_hotdog"
    title = "Cooking-Hotdog, stove moved, order swapped"
    instruction = "Put the sausage into the skillet, the skillet on the stove, and the cooked sausage into the bun."
    table_height = table.HEIGHT
    horizon = hotdog.CookingHotdog.horizon
    state_fields = hotdog.CookingHotdog.state_fields
    objects = tuple(
        dataclasses.replace(o, fixed=STOVE_ELSEWHERE) if o.name == hotdog.STOVE else o
        for o in hotdog.CookingHotdog.objects
    )
    skills = across_the_table(*hotdog.CookingHotdog.skills)
    subgoals = tuple(hotdog.CookingHotdog.subgoals[i] for i in (2, 3, 0, 1, 4, 5))

    def __init__(self) -> None:
        self._usual = hotdog.CookingHotdog()
        self.layout = self._usual.layout
        self.sample_layout = self._usual.sample_layout
        self.violations = self._usual.violations
        self.success = self._usual.success

    def state(self, scene: Scene) -> Array:
        """(11,) as in Cooking-Hotdog, its flags about the stove where it stands now."""
        state = self._usual.state(scene)
        state[7:10] = (self._on_stove(scene), state[8], hotdog.COOKED in scene.latched or self._cooks(scene))
        return state

    def events(self, scene: Scene) -> frozenset[str]:
        """The sausage is cooked once it lay in the skillet on the stove, both let go of."""
        return frozenset({hotdog.COOKED}) if self._cooks(scene) else frozenset()

    def subgoal(self, state: Array) -> int:
        """The first of the six that is left to do: sausage, skillet, and the sausage again."""
        skillet_held, _, sausage_held, cooked, _ = (bool(flag > 0.5) for flag in state[6:])
        if cooked:
            return 5 if sausage_held else 4
        if not sausage_held and _liesin_pan(state[:3], state[3:6]):
            return 3 if skillet_held else 2
        return int(sausage_held)

    def box(self, state: Array) -> Box:
        """Pick at sausage or handle, place where it will rest."""
        pick, place = (self.keypoints(state, skill).tolist() for skill in ("pick", "place"))
        match self.subgoal(state):
            case 1:
                return Box("place", tuple(place[1]), hotdog.PLACE_BELOW, hotdog.PLACE_ABOVE)
            case 2:
                return Box("pick", tuple(pick[0]), hotdog.HANDLE_BELOW, hotdog.HANDLE_ABOVE)
            case 3:
                x, y, z = place[0]
                return Box("place", (x, y, z + hotdog.SETTLE), hotdog.PLACE_BELOW, hotdog.PLACE_ABOVE)
            case 5:
                return Box("place", tuple(place[2]), hotdog.BUN_BELOW, hotdog.BUN_ABOVE)
            case _:
                x, y, z = pick[1]
                return Box("pick", (x, y, z + hotdog.SAUSAGE_GRASP_Z), hotdog.SAUSAGE_BELOW, hotdog.SAUSAGE_ABOVE)

    def keypoints(self, state: Array, skill: str | None = None) -> Array:
        """(5, 3) as in Cooking-Hotdog, the place over the stove where that is now."""
        points = self._usual.keypoints(state, skill)
        if skill != "pick":
            points[-3] = np.add(ON_IT, hotdog.SKILLET_GRASP)
        return points

    def _on_stove(self, scene: Scene) -> bool:
        """Whether the skillet stands upright on the stove, let go of."""
        x, y, z = np.asarray(scene.objects[hotdog.SKILLET]) - ON_IT
        stands = math.hypot(x, y) <= hotdog.ON_STOVE and abs(z) <= hotdog.ON_STOVE_Z
        return bool(stands and scene.held != hotdog.SKILLET and scene.tilts.get(hotdog.SKILLET, 0.0) <= TILTED)

    def _cooks(self, scene: Scene) -> bool:
        """Whether the sausage lies in the skillet on the stove, both let go of."""
        lies = _liesin_pan(scene.objects[hotdog.SAUSAGE], scene.objects[hotdog.SKILLET])
        return lies and scene.held != hotdog.SAUSAGE and self._on_stove(scene)


def _liesin_pan(sausage: Array, skillet: Array) -> bool:
    x, y, z = np.asarray(sausage) - skillet
    level = abs(z - hotdog.FLOOR_Z - hotdog.SAUSAGE_HALF[2]) <= hotdog.COOKING_Z
    return bool(math.hypot(x, y) <= hotdog.COOKING and level)


FURTHER = 0.04
"""m in x that the dustpan of `FurtherPan` stands beyond that of Sweeping."""
PAN_THERE: Vector = (sweeping.PAN_AT[0] + FURTHER, *sweeping.PAN_AT[1:])


class FurtherPan(Boxed):
    """Sweeping with the dustpan further away: the push must go further, from where it always started."""

    name = "further_pan"
    title = "Sweeping, dustpan moved"
    instruction = sweeping.Sweeping.instruction
    table_height = table.HEIGHT
    horizon = sweeping.Sweeping.horizon
    objects = tuple(
        dataclasses.replace(o, fixed=PAN_THERE) if o.name == sweeping.PAN else o for o in sweeping.Sweeping.objects
    )
    state_fields = sweeping.Sweeping.state_fields
    skills = across_the_table(*sweeping.Sweeping.skills)
    subgoals = sweeping.Sweeping.subgoals

    def __init__(self) -> None:
        self._usual = usual = sweeping.Sweeping()
        self.layout = usual.layout
        self.state, self.sample_layout = usual.state, usual.sample_layout
        self.subgoal, self.keypoints = usual.subgoal, usual.keypoints

    def success(self, scene: Scene) -> bool:
        """Whether the toy lies inside the dustpan's rectangle."""
        return in_pan(scene, sweeping.TOY, PAN_THERE)

    def violations(self, scene: Scene) -> tuple[SafetyViolation, ...]:
        """Those of Sweeping, but for a toy in the pan where that is now."""
        return () if self.success(scene) else self._usual.violations(scene)

    def box(self, state: Array) -> Box:
        """Sweeping's, a push ending as much further as the dustpan stands."""
        box = self._usual.box(state)
        if box.skill != "push":
            return box
        return dataclasses.replace(box, centre=(*box.centre[:3], box.centre[3] + FURTHER))


GUEST = "collected_toy"
GUEST_X, GUEST_Y = (0.36, 0.40), (-0.05, 0.05)
"""Where Collecting's toy starts: before the broom and the toy of Sweeping, m."""
OVER_PAN: Vector = (*sweeping.PAN_AT[:2], table.HEIGHT + collecting.PLACE_HEIGHT)


class TwoToys(Boxed):
    """Collecting's toy in Sweeping's scene: it is put into the dustpan by hand, then the other one is swept there."""

    name = "two_toys"
    title = "Collecting's toy in Sweeping's scene"
    instruction = "Put the near toy into the dustpan, then pick up the broom and sweep the other one into it."
    table_height = table.HEIGHT
    horizon = 2 * sweeping.Sweeping.horizon
    objects = (*sweeping.Sweeping.objects, dataclasses.replace(collecting.CollectingToy.objects[0], name=GUEST))
    state_fields = (
        *sweeping.Sweeping.state_fields,
        StateField(
            f"{GUEST}_position",
            3,
            "m",
            "centre of Collecting's toy, base frame",
            (0.35, -0.17, table.HEIGHT),
            (0.80, 0.17, table.HEIGHT + 0.20),
        ),
        StateField(f"{GUEST}_grasped", 1, "", "1 while Collecting's toy is in the hand, else 0", (0.0,), (1.0,)),
        StateField(f"{GUEST}_in_pan", 1, "", "1 while Collecting's toy lies in the dustpan, else 0", (0.0,), (1.0,)),
    )
    skills = across_the_table(*sweeping.Sweeping.skills, collecting.CollectingToy.skills[2])
    subgoals = (*collecting.CollectingToy.subgoals[:2], *sweeping.Sweeping.subgoals)

    def __init__(self) -> None:
        self._one = sweeping.Sweeping()
        self.layout = self._one.layout

    def state(self, scene: Scene) -> Array:
        """(11,) as in Sweeping; Collecting's toy x, y, z in m, whether it is held, and whether it lies in the pan."""
        flags = [float(scene.held == GUEST), float(in_pan(scene, GUEST))]
        return np.concatenate((self._one.state(scene), scene.objects[GUEST], flags), dtype=np.float64)

    def sample_layout(self, rng: np.random.Generator) -> dict[str, Array]:
        """Sweeping's, and Collecting's toy flat on the table before it."""
        at = draw(rng, GUEST_X, GUEST_Y)
        return self._one.sample_layout(rng) | {GUEST: np.array([*at, table.HEIGHT + collecting.TOY_HALF])}

    def success(self, scene: Scene) -> bool:
        """Whether both toys lie in the dustpan."""
        return self._one.success(scene) and in_pan(scene, GUEST)

    def violations(self, scene: Scene) -> tuple[SafetyViolation, ...]:
        """Those of Sweeping, and Collecting's toy out of reach."""
        found = () if in_pan(scene, GUEST) else misplaced(scene, GUEST, table.X, table.Y, "Collecting's toy")
        return (*self._one.violations(scene), *found)

    def subgoal(self, state: Array) -> int:
        """0 and 1 until Collecting's toy lies in the pan, then 2 and 3 as Sweeping's 0 and 1."""
        if state[10] < 0.5:
            return int(state[9] > 0.5)
        return 2 + self._one.subgoal(state[:6])

    def box(self, state: Array) -> Box:
        """Pick at Collecting's toy, place it over the pan; then as in Sweeping."""
        x, y, z = state[6:9].tolist()
        match self.subgoal(state):
            case 0:
                at = (x, y, z + collecting.PICK_ABOVE_CENTRE)
                return Box("pick", at, collecting.PICK_BELOW, collecting.PICK_ABOVE)
            case 1:
                return Box("place", OVER_PAN, collecting.PLACE_BELOW, collecting.PLACE_ABOVE)
            case _:
                return self._one.box(state[:6])

    def keypoints(self, state: Array, skill: str | None = None) -> Array:
        """(4, 3): toy and broom to pick, before the other toy to push, over the pan; with `skill`, (2, 3) or (1, 3)."""
        broom, before = self._one.keypoints(state[:6])
        points = {"pick": [state[6:9], broom], "push": [before], "place": [np.array(OVER_PAN)]}
        return np.array([at for name, all_ in points.items() if skill in {None, name} for at in all_]).reshape(-1, 3)


def in_pan(scene: Scene, name: str, pan: Vector = sweeping.PAN_AT) -> bool:
    """Whether this toy lies in the dustpan, and nothing holds it."""
    x, y, z = scene.objects[name]
    inside = abs(x - pan[0]) <= sweeping.PAN_HALF[0] and abs(y - pan[1]) <= sweeping.PAN_HALF[1]
    return bool(inside and table.HEIGHT <= z <= table.HEIGHT + sweeping.SWEPT_Z and scene.held != name)
