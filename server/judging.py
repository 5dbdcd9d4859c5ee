"""A teacher at the desk: it sees the open proposal, takes its time, and clicks as a person would."""

from __future__ import annotations

import asyncio
from uuid import uuid4

import numpy as np

from robot_adapters.base import SkillCall
from robot_adapters.tasks.base import Task
from server.desk import Desk
from server.names import TEACHER
from server.quota import Quota
from server.schemas import Experiment, FeedbackCreate, Proposal
from server.seeds import judging
from server.teacher import Case, teacher


class Judge:
    """Judges each proposal of one robot once. One that was taken back is left to whoever took it back."""

    def __init__(self, experiment: Experiment, task: Task, desk: Desk, quota: Quota) -> None:
        assert experiment.teacher is not None
        self._teacher = teacher(experiment.teacher, task, experiment.teacher_settings)
        self._name = f"{TEACHER}{experiment.teacher}"
        self._seed = experiment.seed
        self._desk = desk
        self._quota = quota
        self._judged: set[int] = set()

    def has_judged(self, proposal: Proposal) -> bool:
        """Whether it has."""
        return proposal.id in self._judged

    async def judge(self, proposal: Proposal, call: SkillCall, leave: asyncio.Event) -> None:
        """Click on the open proposal, unless it closes or the loop is to end meanwhile, or enough is stored.

        Raises:
            WorkerDied: a worker went away meanwhile.
        """
        case = Case(np.array(proposal.state), call, judging(self._seed, proposal.number))
        judgement = self._teacher.judge(case)
        if judgement.delay > 0 and not await self._desk.wait(proposal, judgement.delay, leave):
            return
        async with self._quota.one_more() as wanted:
            if wanted:
                self._judged.add(proposal.id)
                # the proposal may have been judged before and taken back: this is another click
                click = FeedbackCreate(click_id=f"teacher-{uuid4()}", value=judgement.value, trainer=self._name)
                await self._desk.feedback(proposal.id, click, "teacher")
