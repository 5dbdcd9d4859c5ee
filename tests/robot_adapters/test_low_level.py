"""Low-level control: a gymnasium environment whose action is one command to the position controller."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import gymnasium
import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from gymnasium.utils.env_checker import check_env
from stable_baselines3 import SAC

from robot_adapters import low_level, registry
from robot_adapters.base import Array, InvalidCall, Unavailable
from robot_adapters.low_level import STRIDE, LowLevelEnv
from robot_adapters.tasks.reaching import TARGET
from robot_adapters.tasks.stacking import PLACE_ABOVE
from tests.robot_adapters.test_registry import install

SIZES = {"reaching": 4, "stacking": 10, "sweeping": 10, "collecting_toy": 10, "cooking_hotdog": 15}
BOTH = ("kinematic", "robosuite")
ABOVE = 0.12  # m

_built: dict[tuple[str, str], LowLevelEnv] = {}


def shared(task: str, adapter: str) -> LowLevelEnv:
    """The one environment of all tests here, reset by each: building a simulator takes a second."""
    if (task, adapter) not in _built:
        _built[task, adapter] = low_level.make(task, adapter)
    return _built[task, adapter]


@pytest.fixture(scope="module", autouse=True)
def _close() -> Iterator[None]:
    yield
    while _built:
        _built.popitem()[1].close()


def drive(env: LowLevelEnv, state: Array, target: Array, *, closed: bool, near: float = 0.004) -> Array:
    """Command the gripper straight to `target` (3,) m until it is there or the episode ends; the newest state."""
    for _ in range(60):
        away = target - state[:3]
        if np.abs(away).max() < near:
            break
        # half the way: the arm is still in motion when the next command comes
        action = np.append(np.clip(0.5 * away / STRIDE, -0.4, 0.4), 1.0 if closed else -1.0)
        state, _, terminated, truncated, info = env.step(action)
        assert not info["violations"]
        if terminated or truncated:
            break
    return state


def dwell(env: LowLevelEnv, state: Array, *, closed: bool) -> tuple[Array, bool]:
    """Give the fingers time; whether that has solved the task."""
    for _ in range(6):
        state, reward, terminated, _, _ = env.step(np.array([0.0, 0.0, 0.0, 1.0 if closed else -1.0]))
        if terminated:
            return state, reward == 1.0
    return state, False


@pytest.mark.parametrize("adapter", BOTH)
@pytest.mark.parametrize("task", SIZES)
def test_it_is_a_gymnasium_environment(task: str, adapter: str) -> None:
    env = shared(task, adapter)
    check_env(env, skip_render_check=True, skip_close_check=True)
    state, info = env.reset(seed=5)
    assert state.shape == env.low.shape == env.high.shape == (SIZES[task],)
    assert state.dtype == np.float64
    assert info == {"success": False, "violations": [], "affordance": info["affordance"]}
    # where an adapter that takes skills would start from this seed
    layout = env.task.sample_layout(np.random.default_rng(5))
    assert state[:3] == pytest.approx(layout["gripper"], abs=0.01)


@pytest.mark.parametrize("adapter", BOTH)
def test_the_same_seed_and_actions_give_the_same_episode(adapter: str) -> None:
    env = shared("stacking", adapter)

    def play(seed: int) -> Array:
        states = [env.reset(seed=seed)[0]]
        actions = np.random.default_rng(seed).uniform(-1, 1, (20, 4))
        return np.array(states + [env.step(action)[0] for action in actions])

    first = play(3)
    assert not np.array_equal(first, play(4))
    assert np.array_equal(first, play(3))


def test_the_first_reset_takes_the_seed_of_make_and_the_next_goes_on_from_there() -> None:
    env = low_level.make("stacking", "kinematic", seed=9)
    starts = [env.reset()[0] for _ in range(2)]
    again = shared("stacking", "kinematic")
    assert np.array_equal(starts[0], again.reset(seed=9)[0])
    assert np.array_equal(starts[1], again.reset()[0])
    assert not np.array_equal(starts[0], starts[1])


@pytest.mark.parametrize("adapter", BOTH)
def test_driving_straight_to_the_area_solves_reaching(adapter: str) -> None:
    env = shared("reaching", adapter)
    for seed in range(3):
        state, _ = env.reset(seed=seed)
        rewards = []
        for _ in range(40):
            action = np.append(np.clip((np.array(TARGET) - state[:3]) / STRIDE, -1, 1), -1.0)
            state, reward, terminated, truncated, info = env.step(action)
            rewards.append(reward)
            assert not truncated
            if terminated:
                break
        assert info["success"]
        assert rewards[-1] == 1.0
        assert set(rewards[:-1]) <= {0.0}


@pytest.mark.parametrize("adapter", BOTH)
def test_a_grasp_a_lift_and_a_place_stack_the_blocks(adapter: str) -> None:
    env = shared("stacking", adapter)
    up = np.array([0.0, 0.0, ABOVE])
    for seed in range(3):
        state, _ = env.reset(seed=seed)
        block = state[4:7]
        state = drive(env, state, block + up, closed=False)
        state = drive(env, state, block, closed=False)
        state, _ = dwell(env, state, closed=True)
        assert state[3] == 1.0
        state = drive(env, state, block + up, closed=True)
        assert state[6] > block[2] + 0.1, "the block came along"
        there = state[7:10] + np.array([0.0, 0.0, PLACE_ABOVE])
        state = drive(env, state, there + up, closed=True)
        state = drive(env, state, there, closed=True)
        assert dwell(env, state, closed=False)[1]


def test_closed_fingers_push_the_drawer_shut_but_what_they_pass_above_stays() -> None:
    env = shared("collecting_toy", "kinematic")
    state, _ = env.reset(seed=0)
    opening = state[4 + 3]
    above = np.array([0.45, 0.0, 0.05])
    state = drive(env, state, above, closed=True)
    state = drive(env, state, np.add(above, [0.1, 0.0, 0.0]), closed=True)
    assert state[7] == opening
    state = drive(env, state, above, closed=True)
    state = drive(env, state, np.array([0.45, 0.0, -0.08]), closed=True)
    state = drive(env, state, np.array([0.60, 0.0, -0.08]), closed=True)
    assert state[7] < opening - 0.05


def test_an_episode_ends_after_its_last_step_and_where_a_hand_is_needed() -> None:
    env = low_level.make("sweeping", "kinematic", max_steps=3)
    env.reset(seed=0)
    ends = [env.step(np.zeros(4))[2:4] for _ in range(3)]
    assert ends == [(False, False), (False, False), (False, True)]

    env = shared("sweeping", "kinematic")
    assert env.max_steps == 600
    state, _ = env.reset(seed=0)
    broom = state[4:7]
    side = np.array([0.06, 0.0, 0.0])
    state = drive(env, state, broom + side + [0.0, 0.0, ABOVE], closed=True)
    state = drive(env, state, broom + side, closed=True)
    for _ in range(10):
        _, reward, terminated, truncated, info = env.step(np.array([-0.4, 0.0, 0.0, 1.0]))
        if truncated:
            break
    assert (reward, terminated, truncated) == (0.0, False, True)
    assert [v.kind for v in info["violations"]] == ["manual_reset"]
    assert info["violations"][0].detail == "the broom fell over"


def test_the_affordance_is_a_penalty_away_from_what_the_task_is_about() -> None:
    env = shared("stacking", "kinematic")
    state, _ = env.reset(seed=1)
    drive(env, state, np.add(state[4:7], [0.0, 0.0, ABOVE]), closed=False)
    assert env.step(np.zeros(4))[4]["affordance"] == 0.0
    drive(env, state, np.array([0.36, -0.2, 0.0]), closed=False)
    assert env.step(np.zeros(4))[4]["affordance"] == -0.1


def test_the_gripper_stays_over_the_table() -> None:
    env = shared("reaching", "robosuite")
    for corner in ([-1, -1, -1, 1], [1, 1, 1, -1]):
        state, _ = env.reset(seed=0)
        for _ in range(60):
            state = env.step(np.array(corner))[0]
        assert 0.34 < state[0] < 0.73
        assert abs(state[1]) < 0.23
        assert -0.106 < state[2] < 0.20


def test_what_is_wrong_is_said() -> None:
    env = low_level.make("reaching", "kinematic")
    with pytest.raises(ResetNeeded, match="reset before step"):
        env.step(np.zeros(4))
    env.reset(seed=0)
    for wrong in (np.zeros(3), np.array([np.nan, 0, 0, 0])):
        with pytest.raises(InvalidCall) as error:
            env.step(wrong)
        assert "(4,) finite numbers" in error.value.remedy
    with pytest.raises(registry.UnknownName, match="no adapter called 'nowhere'"):
        low_level.make("reaching", "nowhere")


def test_an_adapter_that_takes_skills_only_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    source = (
        "class Factory:\n"
        "    name, description, simulated, tasks = 'skilled', 'takes skills only', True, ('reaching',)\n"
        "FACTORY = Factory()\n"
    )
    (tmp_path / "skilled.py").write_text(source)
    install(tmp_path, "[seed.adapters]\nskilled = skilled:FACTORY\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    registry._load_all.cache_clear()
    try:
        with pytest.raises(Unavailable, match="takes skills only") as error:
            low_level.make("reaching", "skilled")
        assert "kinematic" in error.value.remedy
    finally:
        registry._load_all.cache_clear()


def test_gymnasium_makes_it_by_name() -> None:
    low_level.register()
    env = gymnasium.make("seed/Cooking-Hotdog-v0", adapter="kinematic", layout={"sausage_x": (0.40, 0.40)})
    state, _ = env.reset(seed=2)
    assert state[4] == 0.40
    env.close()


def test_stable_baselines_learns_on_it() -> None:
    env = low_level.make("reaching", "kinematic", seed=0)
    learner = SAC("MlpPolicy", env, learning_starts=40, batch_size=16, policy_kwargs={"net_arch": [16]}, seed=0)
    learner.learn(60)
    assert learner.num_timesteps == 60
    assert learner.replay_buffer is not None
    assert learner.replay_buffer.size() == 60
