"""A crowd on one service: 200 trainers who click every two seconds in 20 experiments, and 100 viewers; on loopback.

Nothing may be lost or doubled: what each client was told is compared with the database row by row, also after the
server has been killed three times in the middle. The bars: click to acknowledged and proposal to everyone, p99 at most
150 ms each; the aim: at most 2.5 times a bare Starlette server that acknowledges and broadcasts messages of the same
sizes and number in the same run. The algorithm proposes without learning: this measures the server, and gradient steps
of 20 learners would take both cores.

Memory is looked at ten times, and must be flat: at the end at most a tenth more than after a fifth of the time, when
caches are full. `python -m tests.benchmarks.load --seconds 600` looks at it over ten minutes.
"""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import random
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Awaitable, Iterator
from dataclasses import dataclass
from pathlib import Path

import httpx

from tests.benchmarks.result import Result
from tests.crowd import Member, lost_or_doubled
from tests.live import LiveService, free_port, running_service, wait_for

EXPERIMENTS, TRAINERS, VIEWERS = 20, 200, 100
PAUSE_S = 2.0
MEASURED_S, KILLING_S = 60.0, 30.0
KILLS = 3
BAR_MS, AIM = 150.0, 2.5
LOOKS, FLAT = 10, 1.1


@dataclass(frozen=True)
class Measured:
    """p50 and p99 in ms, and what the events of one click weigh."""

    acknowledged: tuple[float, float]
    fan_out: tuple[float, float]
    clicks: int
    answers: dict[str, int]
    wrong: list[str]
    heard: int
    events: dict[str, tuple[float, float]]
    """Event -> (how many of it a member heard for each click in its room, mean bytes)."""


def crowd(streams: list[str], trainers: int, viewers: int, pause: float) -> list[Member]:
    """Members spread evenly over the experiments' streams; the n-th is the same in every run."""
    members = []
    for number in range(trainers + viewers):
        trains = number < trainers
        url = streams[number % len(streams)]
        members.append(Member(f"crowd-{number:04d}", url, pause if trains else None, random.Random(number)))
    return members


async def click_for(members: list[Member], meanwhile: Awaitable[None]) -> None:
    """Let them in a few at a time, and all click as long as `meanwhile` takes; returns once every click is answered."""
    over = asyncio.Event()
    tasks = []
    for member in members:
        tasks.append(asyncio.create_task(member.run(over)))
        await asyncio.sleep(0.005)
    await meanwhile
    over.set()
    await asyncio.wait_for(asyncio.gather(*tasks), 120)


def measure(members: list[Member], rows: list[tuple[str, int, int, str]] | None) -> Measured:
    """What the members saw."""
    clicks = [click for member in members for click in member.clicks]
    waits = [1000 * (c.answered_at - c.sent_at) for c in clicks if c.answered_at is not None]
    fans = [1000 * delay for member in members for delay in member.fan_out]
    answers: dict[str, int] = {}
    for click in clicks:
        answers[str(click.answer)] = answers.get(str(click.answer), 0) + 1
    total: dict[str, int] = {}
    weight: dict[str, int] = {}
    for member in members:
        for kind, count in member.heard.items():
            total[kind] = total.get(kind, 0) + count
            weight[kind] = weight.get(kind, 0) + member.sizes[kind]
    per_click = len(members) * len(clicks) / len({member.url for member in members})
    broadcast = {k: v for k, v in total.items() if k not in ("snapshot", "resumed", "acknowledged", "refused")}
    return Measured(
        percentiles(waits),
        percentiles(fans),
        len(clicks),
        answers,
        [] if rows is None else lost_or_doubled(members, rows),
        sum(total.values()),
        {kind: (count / per_click, weight[kind] / count) for kind, count in broadcast.items()},
    )


def percentiles(values: list[float]) -> tuple[float, float]:
    """(p50, p99)."""
    return statistics.median(values), statistics.quantiles(values, n=100, method="inclusive")[98]


@contextlib.contextmanager
def busy_service(folder: Path, experiments: int) -> Iterator[tuple[LiveService, list[str]]]:
    """A service with so many experiments that run and never move, and the addresses of their streams."""
    with running_service(folder, SEED_LOG_LEVEL="error") as service:
        for number in range(experiments):
            experiment = service.experiment(
                name=f"Load {number}", adapter="kinematic", preset="stubborn", mode="propose_only", seed=number
            )
            service.post(f"/experiments/{experiment}/start")
        resume(service, starting=True)
        base = service.url.replace("http", "ws", 1)
        yield service, [f"{base}/api/v1/experiments/{n + 1}/stream" for n in range(experiments)]


def resume(service: LiveService, *, starting: bool = False) -> None:
    """Have every experiment go on, and wait until each of them asks for feedback."""
    ids = [item["id"] for item in service.get("/experiments?limit=100")["items"]]
    for experiment in ids if not starting else ():
        service.post(f"/experiments/{experiment}/resume")
    for experiment in ids:

        def waits(experiment: int = experiment) -> bool:
            return bool(service.get(f"/experiments/{experiment}")["phase"] == "awaiting_feedback")

        wait_for(waits, f"experiment {experiment} to ask", 300)


def stored(service: LiveService) -> list[tuple[str, int, int, str]]:
    """Every click of the database."""
    return [tuple(row) for row in service.rows("SELECT click_id, proposal_id, value, status FROM feedback")]


def kill_and_return(service: LiveService, members: list[Member], kills: int, seconds: float) -> list[str]:
    """SIGKILL the server so often while all click; what is lost or doubled afterwards."""

    async def kill() -> None:
        for _ in range(kills):
            await asyncio.sleep(seconds / (kills + 1))
            await asyncio.to_thread(service.kill)
            await asyncio.to_thread(service.start)
            await asyncio.to_thread(resume, service)
        await asyncio.sleep(seconds / (kills + 1))

    asyncio.run(click_for(members, kill()))
    return lost_or_doubled(members, stored(service))


@contextlib.contextmanager
def bare_server() -> Iterator[str]:
    """The baseline in a process of its own; its address."""
    port = free_port()
    process = subprocess.Popen([sys.executable, "-m", "tests.benchmarks._bare", str(port)])
    try:

        def up() -> bool:
            with contextlib.suppress(httpx.TransportError):
                return httpx.get(f"http://127.0.0.1:{port}/").status_code < 500
            return False

        wait_for(up, "the bare server")
        yield f"ws://127.0.0.1:{port}"
    finally:
        process.kill()
        process.wait()


def resident(service: LiveService) -> float:
    """Memory of the server and of the process that writes for it, MiB; what they share is counted once."""
    kib = 0
    for pid in (service.pid, service.writer):
        told = Path(f"/proc/{pid}/smaps_rollup").read_text("utf-8").splitlines()
        kib += next(int(line.split()[1]) for line in told if line.startswith("Pss:"))
    return kib / 1024


def run(seconds: float = MEASURED_S, *, experiments: int = EXPERIMENTS) -> Result:
    """Measure."""
    share = experiments / EXPERIMENTS
    trainers, viewers = round(TRAINERS * share), round(VIEWERS * share)
    with tempfile.TemporaryDirectory() as folder:
        with busy_service(Path(folder), experiments) as (service, streams):
            members = crowd(streams, trainers, viewers, PAUSE_S)
            memory = []

            async def watch() -> None:
                for _ in range(LOOKS):
                    await asyncio.sleep(seconds / LOOKS)
                    memory.append(resident(service))

            asyncio.run(click_for(members, watch()))
            ours = measure(members, stored(service))
            again = crowd(streams, trainers, viewers, PAUSE_S)
            for member in again:
                member.name = f"killed-{member.name}"
            wrong = kill_and_return(service, [*again], KILLS, KILLING_S)
            wrong = [line for line in wrong if not line.startswith("nobody sent crowd-")]
        with bare_server() as address:
            sizes = ",".join(f"{kind}:{count:.3f}:{size:.0f}" for kind, (count, size) in ours.events.items())
            bare_streams = [f"{address}/{n}?{sizes}" for n in range(experiments)]
            bare_members = crowd(bare_streams, trainers, viewers, PAUSE_S)
            asyncio.run(click_for(bare_members, asyncio.sleep(seconds)))
            bare = measure(bare_members, None)
    worst = max(ours.acknowledged[1], ours.fan_out[1])
    lost = [*ours.wrong, *wrong]
    growth = memory[-1] / memory[LOOKS // 5 - 1]
    return Result(
        name="load",
        value=worst,
        unit="ms, p99 of click to acknowledged or of proposal to everyone, whichever is longer",
        baseline=max(bare.acknowledged[1], bare.fan_out[1]),
        bar=BAR_MS,
        ok=worst <= BAR_MS and not lost and growth <= FLAT,
        lines=(
            f"{trainers} trainers and {viewers} viewers in {experiments} experiments, {seconds:.0f} s: "
            f"{ours.clicks} clicks ({ours.clicks / seconds:.0f} a second) {ours.answers}, {ours.heard} messages heard",
            line("SEED", ours),
            line("bare Starlette", bare),
            f"ratio of p99: acknowledged {ours.acknowledged[1] / bare.acknowledged[1]:.1f}, "
            f"fan-out {ours.fan_out[1] / bare.fan_out[1]:.1f} (aim {AIM})",
            "memory of the server, MiB: " + " ".join(f"{mib:.0f}" for mib in memory) + f"; {growth:.2f} times what it "
            f"was after a fifth of the time (at most {FLAT})",
            f"server killed {KILLS} times under the same load: "
            f"{sum(len(member.clicks) for member in again)} clicks; lost, doubled or changed: {len(lost)}",
            *lost[:5],
        ),
    )


def line(who: str, seen: Measured) -> str:
    """Its percentiles."""
    return (
        f"{who}: click to acknowledged p50 {seen.acknowledged[0]:.1f}, p99 {seen.acknowledged[1]:.1f} ms; "
        f"proposal to everyone p50 {seen.fan_out[0]:.1f}, p99 {seen.fan_out[1]:.1f} ms"
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=MEASURED_S)
    parser.add_argument("--experiments", type=int, default=EXPERIMENTS)
    chosen = parser.parse_args()
    result = run(chosen.seconds, experiments=chosen.experiments)
    print(*result.lines, f"{result.name}: {result.value:.1f} {result.unit}", sep="\n")
