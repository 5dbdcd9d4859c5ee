"""The kinematic adapter's honesty: skills do what their parameters say, and miss where fingers would."""

from __future__ import annotations

import io
import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from robot_adapters import registry
from robot_adapters.base import Adapter, EndReason, SkillCall, SkillResult, Unavailable
from robot_adapters.kinematic import KinematicSettings
from robot_adapters.kinematic.adapter import KinematicAdapter
from robot_adapters.kinematic.pencil import CALIBRATIONS
from robot_adapters.kinematic.world import World
from robot_adapters.projection import project
from robot_adapters.tasks import table
from robot_adapters.tasks.base import Task
from robot_adapters.tasks.stacking import HALF_A, HALF_B, Stacking

SEEDS = st.integers(0, 2**31 - 1)


def build(task: str, **chosen: float) -> Adapter:
    return registry.adapter("kinematic")(task, KinematicSettings.model_validate(chosen))


def run(adapter: Adapter, skill: str, *parameters: float) -> SkillResult:
    return adapter.execute(SkillCall(skill, parameters), should_stop=lambda: False, on_step=lambda: None)


def solve(adapter: Adapter, task: Task, calls: int) -> SkillResult:
    for _ in range(calls):
        call = task.true_call(adapter.observe().state)
        result = adapter.execute(call, should_stop=lambda: False, on_step=lambda: None)
    return result


@pytest.fixture(scope="module")
def blocks() -> Adapter:
    return build("stacking", draw=False)


@settings(deadline=None)
@given(SEEDS)
def test_true_calls_stack_from_any_seed(seed: int) -> None:
    adapter = build("stacking", draw=False)
    adapter.reset(seed)
    result = solve(adapter, registry.task("stacking"), 2)
    assert result.success
    assert adapter.success()
    assert result.low_level_steps > 0


@settings(deadline=None)
@given(SEEDS)
def test_true_calls_reach_from_any_seed(seed: int) -> None:
    adapter = build("reaching", draw=False)
    adapter.reset(seed)
    assert solve(adapter, registry.task("reaching"), 1).success


@pytest.mark.parametrize(
    ("dx", "dy", "dz", "end"),
    [
        (0, 0, 0, EndReason.ARRIVED),
        (0.019, 0.019, 0, EndReason.ARRIVED),
        (0, 0, 0.014, EndReason.ARRIVED),
        (0.021, 0, 0, EndReason.NOTHING_GRASPED),
        (0, -0.021, 0, EndReason.NOTHING_GRASPED),
        (0, 0, 0.016, EndReason.NOTHING_GRASPED),
    ],
)
def test_a_pick_holds_what_is_between_the_fingers(
    blocks: Adapter, dx: float, dy: float, dz: float, end: EndReason
) -> None:
    x, y, z = blocks.reset(3).state[:3].tolist()
    result = run(blocks, "pick", x + dx, y + dy, z + dz)
    assert result.end is end
    raised = blocks.observe().state[2] > z + 0.1
    assert raised == (end is EndReason.ARRIVED)


def test_a_block_let_go_beside_the_other_falls_to_the_table(blocks: Adapter) -> None:
    state = blocks.reset(3).state
    run(blocks, "pick", *state[:3].tolist())
    result = run(blocks, "place", 0.43, -0.13, 0.0)
    x, y, z = blocks.observe().state[:3].tolist()
    assert (x, y, z) == pytest.approx((0.43, -0.13, table.HEIGHT + HALF_A))
    assert not result.success


def test_a_block_that_hangs_over_the_edge_tumbles_off(blocks: Adapter) -> None:
    state = blocks.reset(3).state
    run(blocks, "pick", *state[:3].tolist())
    b = state[3:].tolist()
    result = run(blocks, "place", b[0] + 0.03, b[1], b[2] + 0.05)
    after = blocks.observe().state
    assert after[2] == pytest.approx(table.HEIGHT + HALF_A)
    assert after[0] - b[0] >= HALF_A + HALF_B
    assert not result.success


def test_a_place_inside_the_other_block_stalls_and_holds_on(blocks: Adapter) -> None:
    state = blocks.reset(3).state
    run(blocks, "pick", *state[:3].tolist())
    b = state[3:].tolist()
    result = run(blocks, "place", *b)
    assert result.end is EndReason.STALLED
    assert not result.success
    retry = run(blocks, "place", b[0], b[1], b[2] + 0.047)
    assert retry.end is EndReason.ARRIVED
    assert retry.success


def test_a_covered_block_cannot_be_picked(blocks: Adapter) -> None:
    state = blocks.reset(3).state
    a, b = state[:3].tolist(), state[3:].tolist()
    run(blocks, "pick", *b)
    run(blocks, "place", a[0], a[1], a[2] + 0.047)
    assert run(blocks, "pick", *a).end is EndReason.NOTHING_GRASPED


def test_a_pick_lets_go_of_what_was_held(blocks: Adapter) -> None:
    state = blocks.reset(3).state
    run(blocks, "pick", *state[3:].tolist())
    assert run(blocks, "pick", *state[:3].tolist()).end is EndReason.ARRIVED
    after = blocks.observe().state
    assert after[5] == pytest.approx(table.HEIGHT + HALF_B)
    assert after[2] > table.HEIGHT + 0.1


def test_a_push_takes_along_what_is_in_its_way() -> None:
    world = World(Stacking.objects, table.HEIGHT)
    low_a, low_b = table.HEIGHT + HALF_A, table.HEIGHT + HALF_B
    layout = {"block_a": np.array([0.5, 0.0, low_a]), "block_b": np.array([0.6, 0.01, low_b])}
    world.reset({**layout, "gripper": np.array([0.4, 0.0, low_a])})
    world.closed = True
    world.push([0.53, 0.0, low_a])
    assert world.at["block_a"] == pytest.approx([0.53 + 0.01 + HALF_A, 0.0, low_a])
    assert world.at["block_b"][0] >= world.at["block_a"][0] + HALF_A + HALF_B - 1e-9
    world.move([0.4, 0.2, low_a])
    world.push([0.7, 0.2, low_a])
    assert world.at["block_a"][0] == pytest.approx(0.56)


def test_a_push_takes_as_many_set_points_as_a_slow_arm_would_need() -> None:
    adapter = build("sweeping", draw=False)
    sweeping = registry.task("sweeping")
    state = adapter.reset(1).state
    run(adapter, "pick", *sweeping.true_call(state).parameters)
    push = sweeping.true_call(adapter.observe().state)
    # 0.08 m/s at 20 Hz, and the way there and up
    assert run(adapter, "push", *push.parameters).low_level_steps >= push.parameters[4] / 0.004


def test_a_block_pushed_over_the_edge_falls() -> None:
    world = World(Stacking.objects, table.HEIGHT)
    low_a = table.HEIGHT + HALF_A
    layout = {"block_a": np.array([0.9, 0.0, low_a]), "block_b": np.array([0.4, 0.2, table.HEIGHT + HALF_B])}
    world.reset({**layout, "gripper": np.array([0.8, 0.0, low_a])})
    world.push([0.95, 0.0, low_a])
    assert world.at["block_a"][2] < table.HEIGHT - 0.1
    assert Stacking().violations(world.scene())[0].kind == "manual_reset"


def test_a_paced_skill_stops_within_its_set_point_and_keeps_its_hold() -> None:
    adapter = build("stacking", draw=False, step_seconds=1.0)
    state = adapter.reset(3).state
    polls = 0

    def should_stop() -> bool:
        nonlocal polls
        polls += 1
        return polls == 3  # in the midst of the first set-point's second

    result = adapter.execute(SkillCall("pick", tuple(state[:3].tolist())), should_stop=should_stop, on_step=pytest.fail)
    assert result.end is EndReason.STOPPED
    assert result.low_level_steps == 1
    assert polls == 3, "the wait ended with the poll that said stop"


def test_a_paced_skill_moves_in_small_steps_and_ends_like_an_instant_one() -> None:
    paced, instant = build("stacking", step_seconds=0.0002), build("stacking")
    assert isinstance(paced, KinematicAdapter)
    heights: list[float] = []
    call = registry.task("stacking").true_call(paced.reset(3).state)
    instant.reset(3)
    slow = paced.execute(
        call,
        should_stop=lambda: False,
        on_step=lambda: heights.append(paced._world.gripper[2]),
    )
    fast = instant.execute(call, should_stop=lambda: False, on_step=lambda: None)
    assert slow == fast
    assert np.allclose(paced.observe().state, instant.observe().state)
    assert len(heights) == slow.low_level_steps
    assert max(abs(a - b) for a, b in itertools.pairwise(heights)) < 0.05


@pytest.mark.parametrize("camera", ["left", "right"])
@pytest.mark.parametrize(("block", "channel"), [("block_a", 0), ("block_b", 1)])
def test_a_block_is_drawn_where_the_overlay_points(camera: str, block: str, channel: int) -> None:
    adapter = build("stacking")
    observation = adapter.reset(5)
    centre = observation.state[:3] if block == "block_a" else observation.state[3:]
    picture = np.asarray(Image.open(io.BytesIO(observation.frames[camera].jpeg)), dtype=int)
    others = [c for c in range(3) if c != channel]
    mask = picture[..., channel] - picture[..., others].max(axis=2) > 50
    v, u = np.nonzero(mask)
    # a drawn cube's silhouette centres on its centre but for perspective
    pixels, _ = project(CALIBRATIONS[camera], centre[None])
    assert np.hypot(u.mean() + 0.5 - pixels[0, 0], v.mean() + 0.5 - pixels[0, 1]) < 2


def test_pictures_are_drawn_only_when_read() -> None:
    adapter = build("stacking")
    frames = adapter.reset(1).frames
    first = frames["left"]
    run(adapter, "pick", *adapter.observe().state[:3].tolist())
    assert frames["left"] is first
    assert frames["right"].taken_at == first.taken_at
    assert adapter.observe().frames["left"].jpeg != first.jpeg
    with pytest.raises(KeyError):
        frames["top"]


def test_an_unread_observation_still_shows_its_own_moment() -> None:
    """Trainers judge the image that the overlay was made for, however late it is drawn."""
    adapter = build("stacking")
    before = adapter.reset(1)
    run(adapter, "pick", *before.state[:3].tolist())
    assert before.frames["left"].jpeg == adapter.reset(1).frames["left"].jpeg


def test_without_drawing_there_are_no_cameras() -> None:
    adapter = build("stacking", draw=False)
    assert adapter.info.cameras == ()
    assert not adapter.reset(1).frames
    with pytest.raises(Unavailable, match="left") as raised:
        adapter.frame("left")
    assert "draw" in raised.value.remedy


def after(adapter: Adapter, name: str, calls: int) -> list[float]:
    """The state after that many right calls."""
    solve(adapter, registry.task(name), calls)
    state: list[float] = adapter.observe().state.tolist()
    return state


def test_a_broom_sweeps_only_what_its_head_meets() -> None:
    adapter = build("sweeping", draw=False)
    adapter.reset(3)
    state = after(adapter, "sweeping", 1)
    assert abs(state[4]) > 0.005
    toy_x, toy_y = state[3:5]
    run(adapter, "push", toy_x - 0.075, -0.07 if toy_y > 0 else 0.07, table.HEIGHT + 0.08, -0.5, 0.15)
    assert adapter.observe().state[3:5].tolist() == [toy_x, toy_y]
    run(adapter, "push", toy_x - 0.075, toy_y, table.HEIGHT + 0.08, -0.5, 0.10)
    moved = adapter.observe().state[3:5].tolist()
    # the head's front is 20 mm before the grip site, the toy's middle 20 mm before that
    assert moved == pytest.approx([toy_x - 0.075 + 0.10 + 0.04, toy_y], abs=0.001)


def test_a_knocked_or_dropped_broom_lies_and_cannot_be_picked() -> None:
    adapter = build("sweeping", draw=False)
    x, y, z = adapter.reset(3).state[:3].tolist()
    run(adapter, "pick", x, y, z)
    result = run(adapter, "pick", 0.50, 0.0, z)
    assert [v.detail for v in result.violations] == ["the broom fell over"]
    x, y = adapter.observe().state[:2].tolist()
    assert run(adapter, "pick", x, y, z).end is EndReason.NOTHING_GRASPED


def test_a_drawer_closes_as_far_as_it_is_pushed_and_takes_the_toy_along() -> None:
    adapter = build("collecting_toy", draw=False)
    adapter.reset(3)
    before = after(adapter, "collecting_toy", 2)
    assert before[5] == 1
    x, y, z, direction, delta = registry.task("collecting_toy").true_call(np.array(before)).parameters
    assert not run(adapter, "push", x, y, z, direction, delta - 0.08).success
    half = adapter.observe().state.tolist()
    assert half[3] == pytest.approx(0.07)
    assert half[0] - before[0] == pytest.approx(before[3] - half[3])
    assert run(adapter, "push", x, y, z, direction, delta).success
    assert adapter.observe().state[3] == 0


def test_a_push_that_misses_the_handle_moves_nothing_and_one_far_beyond_stalls() -> None:
    adapter = build("collecting_toy", draw=False)
    adapter.reset(3)
    before = np.array(after(adapter, "collecting_toy", 2))
    x, y, z, direction, delta = registry.task("collecting_toy").true_call(before).parameters
    run(adapter, "push", x, 0.06, z, direction, delta)
    assert adapter.observe().state[3] == before[3]
    assert run(adapter, "push", x, y, z, direction, delta + 0.03).end is EndReason.STALLED


def test_a_drawer_closed_too_early_needs_a_hand() -> None:
    adapter = build("collecting_toy", draw=False)
    opening = adapter.reset(3).state[3]
    result = run(adapter, "push", 0.46, 0.0, table.HEIGHT + 0.03, -0.5, 0.2)
    assert opening > 0.1
    assert "the drawer is closed and the toy outside" in [v.detail for v in result.violations]


def test_a_skillet_carries_what_lies_in_it() -> None:
    adapter = build("cooking_hotdog", draw=False)
    adapter.reset(3)
    state = after(adapter, "cooking_hotdog", 4)
    run(adapter, "pick", state[3] - 0.125, state[4], state[5] + 0.015)
    lifted = adapter.observe().state.tolist()
    assert lifted[6] == 1
    assert lifted[5] > state[5] + 0.05
    assert np.subtract(lifted[:3], lifted[3:6]) == pytest.approx(np.subtract(state[:3], state[3:6]))


def test_a_sausage_beside_the_bun_lies_on_the_table() -> None:
    adapter = build("cooking_hotdog", draw=False)
    adapter.reset(3)
    after(adapter, "cooking_hotdog", 5)
    result = run(adapter, "place", 0.42, 0.06 + 0.02, table.HEIGHT + 0.05)
    state = adapter.observe().state.tolist()
    assert not result.success
    assert state[10] == 0
    assert state[2] == pytest.approx(table.HEIGHT + 0.012)


@pytest.mark.parametrize("name", ["sweeping", "collecting_toy", "cooking_hotdog"])
@pytest.mark.parametrize("camera", ["left", "right"])
def test_what_a_right_call_is_about_is_drawn_under_its_dot(name: str, camera: str) -> None:
    """Every pick of an episode points at something that isn't table."""
    adapter, task = build(name), registry.task(name)
    adapter.reset(5)
    for _ in task.subgoals:
        observation = adapter.observe()
        call = task.true_call(observation.state)
        if call.skill == "pick":
            u, v = adapter.overlays(call)[camera].dot or (-1, -1)
            picture = np.asarray(Image.open(io.BytesIO(observation.frames[camera].jpeg)), dtype=int)
            around = picture[int(v) - 2 : int(v) + 3, int(u) - 2 : int(u) + 3].reshape(-1, 3).mean(axis=0)
            assert around.max() - around.min() > 30, "table and hand are grey"
        adapter.execute(call, should_stop=lambda: False, on_step=lambda: None)


@pytest.mark.parametrize("name", ["sweeping", "collecting_toy", "cooking_hotdog"])
def test_paced_episodes_end_like_instant_ones(name: str) -> None:
    task, paced, instant = registry.task(name), build(name, draw=False, step_seconds=1e-4), build(name, draw=False)
    paced.reset(3)
    state = instant.reset(3).state
    for _ in task.subgoals:
        call = task.true_call(state)
        results = [
            adapter.execute(call, should_stop=lambda: False, on_step=lambda: None) for adapter in (paced, instant)
        ]
        assert results[0] == results[1]
        state = instant.observe().state
        assert np.allclose(paced.observe().state, state, atol=1e-9)
