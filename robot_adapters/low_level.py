"""Low-level control of a task as a gymnasium environment: one action is one command to the position controller.

What methods without skills learn from (SAC and TAMER in the paper), on any adapter that offers it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol, SupportsFloat, runtime_checkable

import gymnasium
import numpy as np
from gymnasium.error import ResetNeeded
from gymnasium.spaces import Box

from robot_adapters import registry
from robot_adapters.base import Array, InvalidCall, SafetyViolation, Scene, Unavailable
from robot_adapters.skills import LOWEST, Arm
from robot_adapters.tasks import table
from robot_adapters.tasks.base import NEAR, Task, state_bounds
from robot_adapters.tasks.episode import Episode
from robot_adapters.tasks.low_level import low_level_fields, low_level_state

STRIDE = 0.05
"""m that an action of 1 asks for: the output range of robosuite's OSC position controller (`default_panda.json`)."""
TURN = 0.5
"""rad, likewise for the yaw."""
STEPS_A_SKILL = 100
"""Low-level steps that one skill stands for (paper, section 'Results', on safety). It states no horizon: ours is what
the same episode takes by skills."""
PENALTY = -0.1
"""Affordance penalty (paper, section 'Facilitating learning with affordances')."""

_ENTRIES = 4


class Plant(Arm, Protocol):
    """The controlled system: an arm that takes set-points one by one, and the scene of a task around it."""

    def reset(self, layout: Mapping[str, Array], rng: np.random.Generator) -> None:
        """Put everything where `layout` says (`Task.sample_layout`), with the gripper open."""

    def scene(self) -> Scene:
        """What the task may look at, now."""

    def close(self) -> None:
        """Release what it holds."""


@runtime_checkable
class Commandable(Protocol):
    """What an adapter's factory has beside `AdapterFactory` if its robot can be commanded step by step."""

    def low_level(self, task: Task) -> Plant:
        """Stage the task, without cameras.

        Raises:
            Unavailable: the simulator can't be had; the remedy says what to install.
        """


def make(
    task: str,
    adapter: str,
    *,
    seed: int | None = None,
    layout: Mapping[str, tuple[float, float]] | None = None,
    max_steps: int | None = None,
) -> LowLevelEnv:
    """The environment of a task on an adapter; on robosuite it takes a few seconds, most of it loading the simulator.

    Args:
        task: its name, e.g. `stacking`.
        adapter: `kinematic`, `robosuite`, or one of your own.
        seed: of the first reset that is given none.
        layout: ranges of the start layout, in m, that replace some of the task's.
        max_steps: after which an episode is truncated; None: `STEPS_A_SKILL` for each skill of the task's horizon.

    Raises:
        UnknownName: there is no such task or adapter.
        InvalidLayout: the task has no such range of starts.
        Unavailable: the adapter can't be commanded step by step, doesn't stage this task, or can't load.
    """
    chosen, factory = registry.task(task, layout), registry.adapter(adapter)
    if not isinstance(factory, Commandable):
        able = [name for name, other in registry.adapters().items() if isinstance(other, Commandable)]
        raise Unavailable(
            f"the adapter {adapter!r} takes skills only", remedy=f"give its factory `low_level`, or use {able}"
        )
    if task not in registry.staged(factory):
        raise Unavailable(
            f"the adapter {adapter!r} doesn't stage {task}", remedy=f"use one of: {', '.join(registry.staged(factory))}"
        )
    return LowLevelEnv(chosen, factory.low_level(chosen), seed=seed, max_steps=max_steps)


def register() -> None:
    """Let `gymnasium.make` know every task as e.g. `seed/Collecting-Toy-v0`, with `make`'s other arguments."""
    for name, task in registry.tasks().items():
        gymnasium.register(f"seed/{task.title}-v0", entry_point=f"{__name__}:make", kwargs={"task": name})


class LowLevelEnv(gymnasium.Env[Array, Array]):
    """A task under low-level control, rewarded once it is solved.

    Observation: (4, 10, 10, 10 or 15,) `low_level_state`: gripper x, y, z in m, base frame, whether it is commanded
    closed, then the task's state; `low` and `high` are the range it usually stays in, for scaling.

    Action: (4,) in [-1, 1]: how far the grip site goes from where it is, along x, y and z, in units of `STRIDE`; above
    0 closes the gripper. A fifth entry turns it, in units of `TURN`, where a skill of the task has a yaw.

    Set-points are kept where the arm is free to go (`table.FREE_X` and so on), and no lower than skills go.

    An episode is terminated when the task is solved, with reward 1 (else 0), and truncated after `max_steps`, or where
    a person would have to interfere: `info["violations"]` says why. The same seed gives the same start as
    `Adapter.reset`.
    """

    metadata: dict[str, Any] = {"render_modes": []}  # noqa: RUF012  gymnasium declares it so

    def __init__(self, task: Task, plant: Plant, *, seed: int | None = None, max_steps: int | None = None) -> None:
        self.task = task
        self.max_steps = max_steps or STEPS_A_SKILL * task.horizon
        self.low, self.high = state_bounds(low_level_fields(task))
        turns = any(p.name == "yaw" for spec in task.skills for p in spec.parameters)
        self.observation_space = Box(-np.inf, np.inf, self.low.shape, np.float64)
        self.action_space = Box(-1.0, 1.0, (_ENTRIES + turns,), np.float64)
        self._plant = plant
        self._episode = Episode(task, plant.scene)
        self._first_seed = seed
        self._steps: int | None = None
        self._yaw = 0.0
        self._lowest, self._highest = np.transpose((table.FREE_X, table.FREE_Y, table.FREE_Z))
        self._lowest[2] = task.table_height + LOWEST

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Array, dict[str, Any]]:
        """Start an episode; without a seed, the one that follows from the last. There are no options."""
        first, self._first_seed = self._first_seed, None
        super().reset(seed=first if seed is None else seed, options=options)
        self._plant.reset(self.task.sample_layout(self.np_random), self.np_random)
        self._episode.reset()
        self._steps, self._yaw = 0, self._plant.pose()[1]
        scene = self._episode.scene()
        return low_level_state(self.task, scene), self._info(scene, ())

    def step(self, action: Array) -> tuple[Array, SupportsFloat, bool, bool, dict[str, Any]]:
        """Hold one set-point for one control period.

        Raises:
            ResetNeeded: no episode has begun.
            InvalidCall: the action has another shape than `action_space`, or isn't finite. Nothing has moved.
        """
        if self._steps is None:
            raise ResetNeeded("call reset before step")
        asked = np.asarray(action, dtype=np.float64)
        if asked.shape != self.action_space.shape or not np.isfinite(asked).all():
            raise InvalidCall(
                f"{asked.tolist()} is no action", remedy=f"give {self.action_space.shape} finite numbers from -1 to 1"
            )
        asked = np.clip(asked, -1.0, 1.0)
        target = np.clip(self._plant.pose()[0] + STRIDE * asked[:3], self._lowest, self._highest)
        if len(asked) > _ENTRIES:
            self._yaw += TURN * float(asked[4])
        self._plant.step(target, self._yaw, bool(asked[3] > 0))
        self._steps += 1
        scene = self._episode.scene()
        overload = self._plant.overload()
        damage = () if overload is None else (SafetyViolation("damage", overload),)
        info = self._info(scene, (*damage, *self.task.violations(scene)))
        solved = info["success"]
        truncated = not solved and (bool(info["violations"]) or self._steps >= self.max_steps)
        return low_level_state(self.task, scene), float(solved), solved, truncated, info

    def close(self) -> None:
        """Release the simulator."""
        self._plant.close()

    def _info(self, scene: Scene, violations: tuple[SafetyViolation, ...]) -> dict[str, Any]:
        return {
            "success": self.task.success(scene),
            "violations": list(violations),
            "affordance": affordance(self.task, scene),
        }


def affordance(task: Task, scene: Scene) -> float:
    """`PENALTY` where the gripper is far from every place at which a skill acts on the task's objects, else 0.

    0 also where the task names no such place: there is nothing to be far from.
    """
    places = task.keypoints(task.state(scene))
    if len(places) == 0:
        return 0.0
    away = np.linalg.norm(places[:, :2] - scene.gripper[:2], axis=1)
    return 0.0 if float(away.min()) <= NEAR else PENALTY
