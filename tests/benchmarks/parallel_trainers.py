"""What 2, 4 and 8 trainers who judge in parallel bring over one: feedback per minute, and feedback until 90 % succeed.

Synthetic trainers on Stacking, each with a WebSocket to the real service on the kinematic adapter. They take as long as
people for each proposal that they are given: log-normal, seeded. Where another's approval closes what they look at they
finish it, as the page lets people do. Two kinds of judging are measured, because only a refusal leaves the robot be:

- `by the rule`: each says what the task's rule says, from an untrained policy on, for `JUDGED_S` seconds. An approval
  moves the robot.
- `refusing`: each says bad, for `REFUSING_S` seconds: the search for a first good call.

How many labels it takes until 90 of 100 evaluation episodes succeed is found afterwards, by a learner like the
service's that learns them in the order in which they were stored. `BENCH_SEEDS` (default 2) sets the seeds.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import math
import os
import statistics
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import torch
from websockets.asyncio.client import ClientConnection, connect

from agent.algorithm import Label
from agent.config import SEED, SeedSettings
from robot_adapters import registry
from robot_adapters.base import SkillCall
from robot_adapters.tasks.base import Task
from tests.benchmarks import _clicks as clicks
from tests.benchmarks.result import Result
from tests.live import LiveService, running_service

TASK = "stacking"
TRAINERS = (1, 2, 4, 8)
MEDIAN_S, SIGMA = 2.0, 0.5
"""Of the time from a proposal's arrival to the click: nineteen of twenty lie between 0.75 and 5.3 s. A choice."""
JUDGED_S, REFUSING_S = 60.0, 30.0
PATIENCE_S = 600.0
BAR = 0.8


@dataclass
class Room:
    """What the trainers of one experiment have done."""

    task: Task
    refuse: bool
    over: asyncio.Event = field(default_factory=asyncio.Event)
    begun: asyncio.Event = field(default_factory=asyncio.Event)
    """Somebody has something to look at: the workers have started."""
    shown: dict[int, Mapping[str, Any]] = field(default_factory=dict)
    stored: list[tuple[int, int, int, float]] = field(default_factory=list)
    """(feedback id, proposal id, value, when it was acknowledged) of what counts."""
    late: int = 0
    overtaken: int = 0
    """Labels of what another's approval had closed meanwhile: they train."""
    interrupted: int = 0
    """Proposals that were closed while their trainer thought about them."""
    waits: list[float] = field(default_factory=list)
    """Seconds from a trainer's click until they had the next proposal."""

    def judge(self, proposal: Mapping[str, Any]) -> int:
        """The answer."""
        if self.refuse:
            return -1
        call = SkillCall(proposal["skill"], tuple(proposal["parameters"].values()))
        return self.task.judge(np.array(proposal["state"]), call)

    def keep(self, feedback: Mapping[str, Any]) -> None:
        """Note what became of a click."""
        if feedback["status"] not in ("stored", "overtaken"):
            self.late += 1
            return
        self.overtaken += feedback["status"] == "overtaken"
        self.stored.append((feedback["id"], feedback["proposal_id"], feedback["value"], time.perf_counter()))


@dataclass
class Trainer:
    """One synthetic trainer: thinks about what is theirs, and clicks."""

    name: str
    room: Room
    dice: np.random.Generator
    mine: int | None = None
    _clicked: set[int] = field(default_factory=set)
    _since: float | None = None
    _thinking: asyncio.Task[None] | None = None

    async def run(self, url: str) -> None:
        """Until the room has had enough."""
        async with connect(f"{url}?trainer={self.name}", max_size=None, compression=None) as socket:
            listening = asyncio.create_task(self._listen(socket))
            over = asyncio.create_task(self.room.over.wait())
            await asyncio.wait((listening, over), return_when=asyncio.FIRST_COMPLETED)
            for task in (listening, over, self._thinking):
                if task is not None:
                    task.cancel()
            if listening.done() and not listening.cancelled():
                listening.result()
                raise AssertionError(f"{self.name} was disconnected")

    async def _listen(self, socket: ClientConnection) -> None:
        async for message in socket:
            if isinstance(message, bytes):
                await socket.send('{"type":"frame_ack"}')
                continue
            event = json.loads(message)
            kind = event["type"]
            if kind == "refused":
                raise AssertionError(f"{self.name} was refused: {event['problem']}")
            if kind == "acknowledged" and event["feedback"] is not None:
                self.room.keep(event["feedback"])
            elif kind == "snapshot":
                self.room.shown |= {proposal["id"]: proposal for proposal in event["proposals"]}
                self._given(socket, event["judges"])
            elif kind in ("proposal_opened", "proposal_changed"):
                self.room.shown[event["proposal"]["id"]] = event["proposal"]
            elif kind == "judges_changed":
                self._given(socket, event["judges"])

    def _given(self, socket: ClientConnection, judges: Sequence[Mapping[str, Any]]) -> None:
        mine = next((judge["proposal_id"] for judge in judges if judge["trainer"] == self.name), None)
        if mine == self.mine:
            return
        if self._thinking is not None and not self._thinking.done():
            self._thinking.cancel()
            self.room.interrupted += 1
        self.mine = mine
        if mine is None or mine in self._clicked:
            return
        if self._since is not None:
            self.room.waits.append(time.perf_counter() - self._since)
            self._since = None
        self.room.begun.set()
        self._thinking = asyncio.create_task(self._think(socket, mine))

    async def _think(self, socket: ClientConnection, proposal_id: int) -> None:
        await asyncio.sleep(float(self.dice.lognormal(math.log(MEDIAN_S), SIGMA)))
        proposal = self.room.shown[proposal_id]
        self._clicked.add(proposal_id)
        self._since = time.perf_counter()
        looked = {key: proposal[key] for key in ("observation_id", "policy_version")}
        body = {"click_id": f"{self.name}-click-{proposal_id:06d}", "proposal_id": proposal_id}
        body |= {"value": self.room.judge(proposal), "trainer": self.name, "looked": looked}
        await socket.send(json.dumps({"type": "feedback", **body}))


@dataclass(frozen=True)
class Measured:
    """Labels a minute; labels until 90 % (None: not within those stored), and seconds until then."""

    a_minute: float
    needed: int | None
    seconds: float | None
    good: float
    room: Room


def measure(service: LiveService, trainers: int, seed: int, *, refuse: bool) -> Measured:
    """Let so many judge an experiment of its own, and learn from what they have said."""
    name = f"{'refusing' if refuse else 'rule'} {trainers} {seed}"
    body = {"task": TASK, "adapter": "kinematic", "algorithm": "seed", "preset": "recommended", "seed": seed}
    experiment = service.experiment(name=name, together={"parallel": True}, **body)
    service.post(f"/experiments/{experiment}/start")
    room = Room(registry.task(TASK), refuse)
    url = f"{service.url.replace('http', 'ws', 1)}/api/v1/experiments/{experiment}/stream"
    began = asyncio.run(_judge(room, trainers, seed, url))
    with contextlib.suppress(httpx.TransportError):
        service.post(f"/experiments/{experiment}/finish")
    stored = sorted(room.stored)
    assert [row[0] for row in stored] == [
        row["id"]
        for row in service.rows(
            "SELECT id FROM feedback WHERE experiment_id = ? AND status IN ('stored', 'overtaken') ORDER BY id",
            experiment,
        )
    ][: len(stored)], "what was acknowledged isn't what is stored"
    window = REFUSING_S if refuse else JUDGED_S
    needed = None if refuse else _needed(room, seed)
    return Measured(
        60 * len(stored) / window,
        needed,
        None if needed is None else stored[needed - 1][3] - began,
        sum(value == 1 for _, _, value, _ in stored) / len(stored),
        room,
    )


async def _judge(room: Room, trainers: int, seed: int, url: str) -> float:
    """When the first of them had something to look at, s of the clock."""
    team = [Trainer(f"trainer-{n}", room, np.random.default_rng([seed, trainers, n])) for n in range(trainers)]
    began: list[float] = []

    async def clock() -> None:
        await room.begun.wait()
        began.append(time.perf_counter())
        await asyncio.sleep(REFUSING_S if room.refuse else JUDGED_S)
        room.over.set()

    async with asyncio.timeout(PATIENCE_S):
        await asyncio.gather(clock(), *(trainer.run(url) for trainer in team))
    return began[0]


def _needed(room: Room, seed: int) -> int | None:
    """How many of the labels, in the order they were stored, until 90 of 100 evaluation episodes succeed."""
    learner = SEED(clicks.problem_of(room.task), SeedSettings(**SEED.presets["recommended"]), seed)
    judged_on = clicks.robot(TASK)
    for count, (feedback_id, proposal_id, value, _) in enumerate(sorted(room.stored), 1):
        shown = room.shown[proposal_id]
        call = SkillCall(shown["skill"], tuple(shown["parameters"].values()))
        learner.add([Label(feedback_id, np.array(shown["state"]), call, value)])
        while learner.owed_updates:
            learner.update()
        if count % clicks.EVERY == 0 and clicks.good_enough(learner, room.task, judged_on, 100):
            return count
    return None


def run() -> Result:
    """The value is of those who judge by the rule: the smallest ratio of their feedback per minute to their number."""
    torch.set_num_threads(1)
    seeds = clicks.seeds(2)
    lines = [
        f"{TASK}, SEED with `recommended`, delay log-normal with median {MEDIAN_S} s and sigma {SIGMA}; "
        f"load of the machine at the start {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores"
    ]
    worst: dict[bool, float] = {}
    with tempfile.TemporaryDirectory() as folder, running_service(Path(folder), SEED_LOG_LEVEL="error") as service:
        for refuse in (False, True):
            rows = {n: [measure(service, n, seed, refuse=refuse) for seed in seeds] for n in TRAINERS}
            one = statistics.fmean(each.a_minute for each in rows[1])
            ratios = {n: statistics.fmean(each.a_minute for each in row) / one for n, row in rows.items()}
            worst[refuse] = min(ratio / n for n, ratio in ratios.items())
            lines += [_line(n, ratios[n], row, refuse=refuse) for n, row in rows.items()]
    lines.append(f"load of the machine at the end {os.getloadavg()[0]:.1f}")
    return Result(
        "parallel_trainers",
        worst[False],
        f"smallest ratio of feedback per minute to the number of trainers, by the rule (refusing: {worst[True]:.2f})",
        baseline=1.0,
        bar=BAR,
        ok=min(worst.values()) >= BAR,
        lines=tuple(lines),
    )


def _line(trainers: int, ratio: float, row: Sequence[Measured], *, refuse: bool) -> str:
    """One number of trainers, over the seeds."""
    a_minute = statistics.fmean(each.a_minute for each in row)
    wait = statistics.median(wait for each in row for wait in each.room.waits)
    told = (
        f"{'refusing' if refuse else 'by the rule'}, {trainers}: {a_minute:.0f} feedback a minute, "
        f"{ratio:.2f} times one ({ratio / trainers:.2f} of {trainers}); "
        f"click to next proposal {wait:.2f} s (median); {sum(each.room.interrupted for each in row)} interrupted, "
        f"{sum(each.room.overtaken for each in row)} overtaken, {sum(each.room.late for each in row)} late"
    )
    if refuse:
        return told
    needed = ", ".join("never" if each.needed is None else str(each.needed) for each in row)
    seconds = ", ".join("never" if each.seconds is None else f"{each.seconds:.0f}" for each in row)
    return f"{told}; {statistics.fmean(each.good for each in row):.0%} good; to 90 %: {needed} labels in {seconds} s"


if __name__ == "__main__":
    found = run()
    print(*found.lines, f"{found.name}: {found.value:.2f} {found.unit}", sep="\n")
