"""Worker processes as the server sees them: commands, stop, frames, death, deadline."""

from __future__ import annotations

import asyncio
import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any

import pytest

from robot_adapters.base import SkillCall
from server.worker import CommandFailed, Worker, WorkerDied, WorkerTimeout
from tests.live import gone

DEADLINE = 60.0
PICK = SkillCall("pick", (0.6, 0.1, -0.05))
SLOW = 0.3
"""s of a set-point: a skill takes some five seconds, and still moves when it is killed or stopped."""


class Robot:
    """A built robot worker, slow enough to be interrupted."""

    def __init__(self, worker: Worker, frames: list[tuple[dict[str, Any], bytes]], moved: asyncio.Event) -> None:
        self.worker, self.frames, self.moved = worker, frames, moved

    async def call(self, command: str, **arguments: Any) -> dict[str, Any]:
        return await self.worker.call(command, deadline=DEADLINE, **arguments)

    async def execute(self, proposal_id: int | None = 1, **changes: Any) -> dict[str, Any]:
        arguments = {
            "proposal_id": proposal_id,
            "execution_id": 7,
            "digest": PICK.digest,
            "skill": PICK.skill,
            "parameters": list(PICK.parameters),
        }
        return await self.call("execute", **(arguments | changes))


async def build(data_dir: Path, step_seconds: float = 0.02) -> Robot:
    frames: list[tuple[dict[str, Any], bytes]] = []
    moved = asyncio.Event()

    def on_frame(header: bytes, jpeg: bytes) -> None:
        frames.append((json.loads(header), jpeg))
        moved.set()

    worker = await Worker.spawn("robot", "server.workers.robot", on_frame=on_frame)
    robot = Robot(worker, frames, moved)
    settings = {"step_seconds": step_seconds}
    await robot.call("build", adapter="kinematic", task="stacking", settings=settings, data_dir=str(data_dir))
    await robot.call("reset", seed=3)
    return robot


@pytest.fixture
async def robot(tmp_path: Path) -> AsyncIterator[Robot]:
    built = await build(tmp_path)
    yield built
    await built.worker.close()


async def learner() -> Worker:
    worker = await Worker.spawn("learner", "server.workers.learner")
    settings = {"hidden_size": 16, "batch_size": 8}
    await worker.call(
        "configure",
        deadline=DEADLINE,
        task="stacking",
        algorithm="seed",
        settings=settings,
        seed=1,
        lockstep=False,
        threads=1,
        device="cpu",
    )
    return worker


def label(number: int, value: int) -> dict[str, Any]:
    state = [0.56, 0.0, -0.09, 0.6, 0.1, -0.087]
    call = {"skill": "pick", "parameters": [0.56, 0.0, -0.09]}
    return {"id": number, "state": state, **call, "value": value, "trainer": 1}


async def test_an_observation_comes_with_its_pictures(robot: Robot, tmp_path: Path) -> None:
    seen = await robot.call("observe")
    assert len(seen["state"]) == 6
    assert {view["camera"] for view in seen["views"]} == {"left", "right"}
    for view in seen["views"]:
        assert (tmp_path / "images" / view["image"][:2] / f"{view['image']}.jpg").read_bytes()[:2] == b"\xff\xd8"
    drawn = await robot.call("overlay", skill=PICK.skill, parameters=list(PICK.parameters))
    assert drawn["overlays"]["left"]["dot"] is not None
    assert (await robot.call("observe"))["id"] == seen["id"], "nothing has moved"


async def test_an_approved_call_runs_and_is_filmed_by_both_cameras(robot: Robot) -> None:
    before = await robot.call("observe")
    done = await robot.execute()
    assert done["low_level_steps"] > 0
    assert done["first_set_point_at"] < done["last_set_point_at"] <= time.monotonic()
    assert {header["camera"] for header, _ in robot.frames} == {"left", "right"}
    assert all(header["execution_id"] == 7 and jpeg[:2] == b"\xff\xd8" for header, jpeg in robot.frames)
    assert (await robot.call("observe"))["id"] != before["id"]


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"proposal_id": None}, "without a proposal"),
        ({"digest": "0" * 64}, "not the approved parameters"),
        ({"parameters": [0.6, 0.1, -0.04]}, "not the approved parameters"),
        ({"execution_id": None}, "without a proposal"),
        ({"robot": 1}, "approved for robot 2, and this is robot 1"),
    ],
)
async def test_a_call_that_nobody_approved_never_moves(robot: Robot, changes: dict[str, Any], why: str) -> None:
    before = await robot.call("observe")
    with pytest.raises(CommandFailed, match=why) as refused:
        await robot.execute(**changes)
    assert refused.value.remedy
    assert (await robot.call("observe"))["id"] == before["id"]


async def test_a_proposal_has_one_execution(robot: Robot) -> None:
    await robot.execute(4)
    for again in (4, 3):
        with pytest.raises(CommandFailed, match="has had its execution"):
            await robot.execute(again)


async def test_a_call_outside_the_workspace_is_refused_and_the_worker_stays(robot: Robot) -> None:
    wild = SkillCall("pick", (9.0, 0.0, 0.0))
    with pytest.raises(CommandFailed) as refused:
        await robot.execute(digest=wild.digest, parameters=list(wild.parameters))
    assert refused.value.kind == "InvalidCall"
    assert (await robot.execute(2))["low_level_steps"] > 0


async def test_stop_ends_a_moving_skill_and_stays_until_rearmed(tmp_path: Path) -> None:
    robot = await build(tmp_path, SLOW)
    running = asyncio.create_task(robot.execute())
    await robot.moved.wait()
    robot.worker.stop(1)
    done = await running
    assert done["stopped"]
    assert done["end"] == "stopped"
    with pytest.raises(CommandFailed, match="latched"):
        await robot.execute(2)
    with pytest.raises(CommandFailed, match="latched"):
        await robot.call("reset", seed=1)
    await robot.call("rearm", upto=1)
    assert not (await robot.execute(3))["stopped"]
    await robot.worker.close()


async def test_rearming_lifts_no_later_stop(robot: Robot) -> None:
    robot.worker.stop(2)
    assert (await robot.call("rearm", upto=1))["stopped"]
    with pytest.raises(CommandFailed, match="latched"):
        await robot.execute()


async def test_a_death_is_noticed_by_whoever_waits(tmp_path: Path) -> None:
    robot = await build(tmp_path, SLOW)
    running = asyncio.create_task(robot.execute())
    await robot.moved.wait()
    os.kill(robot.worker.pid, signal.SIGKILL)
    with pytest.raises(WorkerDied, match="signal 9"):
        await running
    assert not robot.worker.alive
    with pytest.raises(WorkerDied):
        await robot.call("observe")
    assert (await robot.worker.death()).worker == "robot"
    await robot.worker.close()


async def test_a_death_is_noticed_by_a_command_that_finds_the_pipe_broken(robot: Robot) -> None:
    os.kill(robot.worker.pid, signal.SIGKILL)
    # blocking, so that the event loop can't see the end first
    os.waitid(os.P_PID, robot.worker.pid, os.WEXITED | os.WNOWAIT)  # noqa: ASYNC222
    with pytest.raises(WorkerDied, match="signal 9"):
        await robot.call("observe")
    async with asyncio.timeout(DEADLINE):
        assert "signal 9" in str(await robot.worker.death())


async def test_a_worker_that_does_not_answer_is_killed(robot: Robot) -> None:
    os.kill(robot.worker.pid, signal.SIGSTOP)
    with pytest.raises(WorkerTimeout, match="did not answer 'observe'"):
        await robot.worker.call("observe", deadline=0.2)
    await robot.worker.death()
    assert gone(robot.worker.pid)


async def test_a_command_behind_a_long_motion_has_all_its_time_after_it(tmp_path: Path) -> None:
    robot = await build(tmp_path, step_seconds=0.5)
    running = asyncio.create_task(robot.execute())
    await robot.moved.wait()
    began = time.monotonic()
    deadline = 4.0
    drawn = await robot.worker.call("overlay", deadline=deadline, skill=PICK.skill, parameters=list(PICK.parameters))
    assert time.monotonic() - began > deadline, "the motion is too short to prove anything"
    assert drawn["overlays"]
    assert not (await running)["stopped"]
    await robot.worker.close()


async def test_workers_leave_ctrl_c_to_the_server(robot: Robot) -> None:
    os.kill(robot.worker.pid, signal.SIGINT)
    assert (await robot.call("observe"))["state"]


async def test_closing_stops_the_skill_and_ends_the_process(tmp_path: Path) -> None:
    robot = await build(tmp_path, step_seconds=0.5)
    running = asyncio.create_task(robot.execute())
    await robot.moved.wait()
    await robot.worker.close(grace=DEADLINE)
    assert gone(robot.worker.pid)
    # it had the time to say how the skill ended
    assert (await running)["stopped"]


async def test_whoever_asks_a_worker_that_is_being_ended_is_told_so(tmp_path: Path) -> None:
    robot = await build(tmp_path)
    closing = asyncio.create_task(robot.worker.close(grace=30))
    await asyncio.sleep(0)  # it has begun
    with pytest.raises(WorkerDied, match="is being ended"):
        await robot.call("observe")
    await closing


PARENT = """
import asyncio, sys
from pathlib import Path
from tests.server.test_worker import build

async def main():
    robot = await build(Path(sys.argv[1]), step_seconds=1.0)
    asyncio.create_task(robot.execute())
    await robot.moved.wait()
    print(robot.worker.pid, flush=True)
    await asyncio.sleep(600)

asyncio.run(main())
"""


def test_a_worker_ends_when_its_server_is_killed(tmp_path: Path) -> None:
    with subprocess.Popen([sys.executable, "-c", PARENT, str(tmp_path)], stdout=subprocess.PIPE, text=True) as parent:
        assert parent.stdout is not None
        worker = int(parent.stdout.readline())
        parent.kill()
    # seconds before its slow skill would have ended by itself
    until = time.monotonic() + DEADLINE
    while not gone(worker):
        assert time.monotonic() < until
        time.sleep(0.01)


async def test_the_learner_trains_unasked_and_answers_in_between() -> None:
    worker = await learner()
    state = label(1, 1)["state"]
    first = await worker.call("propose", deadline=DEADLINE, state=state, deterministic=False)
    assert first["skill"] in {"pick", "place"}
    assert first["policy_version"] == 0
    # both wait in the pipe: nothing but the worker decides what comes between them
    added = worker.send("add", labels=[label(n, (-1, 1)[n % 2]) for n in range(1, 41)])
    between = await worker.call("propose", deadline=DEADLINE, state=state, deterministic=False)
    assert (await added)["owed_updates"] == 200
    assert between["owed_updates"] > 0, "a request waits for one step, not for all of them"
    flushed = await worker.call("flush", deadline=DEADLINE)
    assert flushed["owed_updates"] == 0
    assert flushed["policy_version"] == 200
    assert flushed["metrics"]["critic_loss"] > 0
    await worker.close()


async def test_a_new_learner_goes_on_from_checkpoint_and_labels(tmp_path: Path) -> None:
    labels = [label(n, (-1, 1)[n % 2]) for n in range(1, 13)]
    old = await learner()
    # both wait in the pipe: it is saved with most steps still owed
    added = old.send("add", labels=labels[:10])
    saved = await old.call("save", deadline=DEADLINE, path=str(tmp_path / "a" / "x.ckpt"))
    assert (await added)["owed_updates"] == 50
    assert saved["last_label_id"] == 10
    assert saved["owed_updates"] > 0
    os.kill(old.pid, signal.SIGKILL)
    await old.death()

    new = await learner()
    await new.call("load", deadline=DEADLINE, path=str(tmp_path / "a" / "x.ckpt"))
    # labels owe their steps once, whichever process takes them, and none is taken before the labels are there
    await new.call("flush", deadline=DEADLINE)
    await new.call("restore", deadline=DEADLINE, labels=labels)
    status = await new.call("flush", deadline=DEADLINE)
    assert status["last_label_id"] == 12
    assert status["policy_version"] == 12 * 5
    await new.close()


async def test_wrong_requests_are_told_with_a_remedy() -> None:
    worker = await learner()
    with pytest.raises(CommandFailed) as refused:
        await worker.call("propose", deadline=DEADLINE, state=[1.0], deterministic=False)
    assert refused.value.kind == "AgentError"
    assert refused.value.remedy
    with pytest.raises(CommandFailed, match="nonsense"):
        await worker.call("nonsense", deadline=DEADLINE)
    assert (await worker.call("flush", deadline=DEADLINE))["owed_updates"] == 0
    await worker.close()


def test_the_server_loads_neither_torch_nor_a_simulator() -> None:
    heavy = "('torch', 'mujoco', 'robosuite')"
    code = f"import sys, server.hub, server.teacher; print([m for m in {heavy} if m in sys.modules])"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert said.stdout.strip() == "[]"


async def test_a_rigs_calibration_is_sought_beside_the_data_of_this_service(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SEED_DATA_DIR", str(tmp_path / "another"))
    worker = await Worker.spawn("robot", "server.workers.robot")
    try:
        with pytest.raises(CommandFailed, match=re.escape(str(tmp_path / "mine" / "calibration"))):
            await worker.call(
                "build",
                deadline=DEADLINE,
                adapter="franka",
                task="stacking",
                settings={},
                data_dir=str(tmp_path / "mine"),
            )
    finally:
        await worker.close()
