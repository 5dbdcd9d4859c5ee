"""Algorithm 1 of the paper, for one robot by itself or for several in step; in brackets the lines of the paper."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Iterable, Sequence
from typing import TypeVar

from server.crew import Crew
from server.crew_values import Seen
from server.quota import Quota
from server.schemas import Phase, Proposal, Verdict
from server.station import Station

T = TypeVar("T")


async def train(station: Station, crew: Crew, quota: Quota, leave: asyncio.Event) -> None:
    """One robot, at its own pace: the learner works while nobody asks it anything.

    Raises:
        WorkerDied: the robot, or the learner, went away.
    """
    station.enter(Phase.STARTING)
    await crew.bring_up([station.robot])  # [1] the replay is a view of the stored feedback
    while not leave.is_set() and not await quota.reached():
        await station.begin()  # [2] a new episode where the last one has ended
        seen = await station.look(leave)  # [3, 4]
        await station.propose(seen)  # [5, 6]
        await station.consider()  # none of the paper's: off unless it is asked for
        judged = await station.query(seen, leave)  # [7, 8]
        if judged is not None and judged.verdict is Verdict.GOOD:
            execution = await station.decide(judged, seen)  # [9]
            if execution is not None:
                await station.carry_out(judged, execution)  # [10, 11]


async def train_in_step(stations: Sequence[Station], crew: Crew, quota: Quota, leave: asyncio.Event) -> None:
    """All robots in rounds that can be repeated exactly: whatever is stored or learned comes in their order.

    Only what the robots do by themselves goes on at the same time, and the waiting for people, who judge in any order.
    A round ends when the learner has worked it off.

    Raises:
        WorkerDied: a robot, or the learner, went away.
    """
    for station in stations:
        station.enter(Phase.STARTING)
    await crew.bring_up(station.robot for station in stations)  # [1]
    while not leave.is_set() and not await quota.reached():
        busy = stations[: await quota.left()]  # no more proposals than labels are wanted
        for station in busy:
            await station.begin()  # [2]
        seen = await _all(station.look(leave) for station in busy)  # [3, 4]
        for station, sight in zip(busy, seen, strict=True):
            await station.propose(sight)  # [5, 6]
            await station.consider()
        with crew.together():
            judged = await _query(busy, seen, leave)  # [7, 8]
        started = []
        for station, sight, proposal in zip(busy, seen, judged, strict=True):
            if proposal is not None and proposal.verdict is Verdict.GOOD:
                execution = await station.decide(proposal, sight)  # [9]
                if execution is not None:
                    started.append((station, proposal, execution))
        motions: list[asyncio.Task[None]] = []
        for station, proposal, execution in started:
            before = motions[-1] if motions else None
            motions.append(asyncio.create_task(station.carry_out(proposal, execution, before)))  # [10, 11]
        await _all(motions)
        if not leave.is_set():
            for station in busy:
                station.enter(Phase.LEARNING)
            await crew.flush()  # [12]
            # before the next click is counted: what is written tells of this round, and a checkpoint is of its end
            await stations[0].written()


async def _query(stations: Sequence[Station], seen: Sequence[Seen], leave: asyncio.Event) -> list[Proposal | None]:
    """What was judged, by robot: in their order by a teacher, in whichever order people like."""
    if any(station.judge is not None for station in stations):
        return [await station.query(sight, leave) for station, sight in zip(stations, seen, strict=True)]
    try:
        async with asyncio.TaskGroup() as group:
            waits = zip(stations, seen, strict=True)
            tasks = [group.create_task(station.query(sight, leave)) for station, sight in waits]
    except ExceptionGroup as several:  # the others don't wait until they are judged; what lies there stays open
        raise several.exceptions[0] from None
    return [task.result() for task in tasks]


async def _all(works: Iterable[Awaitable[T]]) -> list[T]:
    """The results of all; what one of them raises is raised once all have ended."""
    results = await asyncio.gather(*works, return_exceptions=True)
    for result in results:
        if isinstance(result, BaseException):
            raise result
    return [result for result in results if not isinstance(result, BaseException)]
