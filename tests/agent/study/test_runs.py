"""One run of every kind of learner, interrupted and gone on with: the numbers are those of a run in one go."""

from __future__ import annotations

import dataclasses
import itertools
import shutil
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
import torch

from agent.seed import Seed
from agent.study.algorithms import CONTESTANTS, ORACLE, course
from agent.study.courses import FeedbackCourse
from agent.study.evaluations import Row, append_row, keep_rows, read_rows
from agent.study.plan import ORACLE_STEPS, SCENARIOS, Plan, Protocol, Run, planned
from agent.study.records import Folder
from agent.study.results import write_results
from agent.study.runs import work
from robot_adapters.base import Array
from server.workers.study import builders

SMALL = {"hidden_size": 16, "batch_size": 16, "gradient_steps": 1}


@pytest.fixture(autouse=True)
def _one_thread() -> None:
    torch.set_num_threads(1)  # as `work` does, and as every other test's process has it


def small(name: str, scenario: str, budget: int, evaluations: int, seeds: Sequence[int] = (3,)) -> Plan:
    """A study of one curve of a learner that costs nothing, and of its oracle where it has one."""
    contestant, settings = CONTESTANTS[name], SMALL
    if contestant.kind != "feedback":
        settings = SMALL | {"warm_up": 5}
    chosen = contestant.model_copy(update={"settings": {**contestant.settings, **settings}})
    return planned(
        "small",
        "kinematic",
        [(SCENARIOS[scenario], [chosen])],
        seeds=seeds,
        budgets={scenario: budget},
        protocol=Protocol(evaluations=evaluations, rollouts=1),
        oracle=ORACLE.model_copy(update={"settings": {**ORACLE.settings, "warm_up": 20}}),
        oracle_steps=budget,
        processes=1,
    )


def numbers(path: Path, plan: Plan) -> list[Row]:
    """Every row of the last runs, without the clock."""
    rows = [row for run in plan.groups[-1] for row in Folder(path).rows(run.id)]
    return [dataclasses.replace(row, seconds=0.0) for row in rows]


def whole(plan: Plan, path: Path) -> list[Row]:
    """Do all runs in one go."""
    for group in plan.groups:
        done = work(group, plan, path, builders("kinematic"), lambda: False)
        assert {each.state for each in done} == {"finished"}, done
    return numbers(path, plan)


def in_pieces(plan: Plan, path: Path, every: int) -> list[Row]:
    """Do all runs, each interrupted again and again."""
    for group in plan.groups:
        for piece in itertools.count(1):
            asked = itertools.count()
            limit = every * piece  # longer each time: what came after the last evaluation is done anew
            told = work(group, plan, path, builders("kinematic"), lambda: next(asked) >= limit)  # noqa: B023
            states = {each.state for each in told}
            if states == {"finished"}:
                break
            assert states <= {"finished", "interrupted"}
    return numbers(path, plan)


@pytest.mark.parametrize(
    ("name", "scenario", "budget", "every"),
    [
        ("seed", "reaching", 60, 9),
        ("seed-recommended", "first_subgoal", 12, 5),
        ("maple-aff", "sweeping", 15, 6),
        ("tamer", "reaching", 60, 25),
    ],
)
def test_an_interrupted_run_ends_with_the_same_numbers(
    tmp_path: Path, name: str, scenario: str, budget: int, every: int
) -> None:
    plan = small(name, scenario, budget, evaluations=3)
    expected = whole(plan, tmp_path / "whole")
    assert expected[-1].evaluation == 3
    assert expected[-1].updates > 0
    assert in_pieces(plan, tmp_path / "pieces", every) == expected


TOGETHER = [("seed-recommended", "first_subgoal", 12, 7), ("seed-recommended", "stacking", 120, 30)]
"""Curves of several seeds in one process, by decisions and by low-level steps, by which they don't end together."""


@pytest.mark.parametrize(("name", "scenario", "budget", "every"), TOGETHER)
def test_interrupted_runs_of_one_process_end_with_the_same_numbers(
    tmp_path: Path, name: str, scenario: str, budget: int, every: int
) -> None:
    plan = small(name, scenario, budget, evaluations=3, seeds=(3, 4, 5))
    assert [len(group) for group in plan.groups] == [3]
    expected = whole(plan, tmp_path / "whole")
    assert sum(row.evaluation == 3 for row in expected) == 3
    assert in_pieces(plan, tmp_path / "pieces", every) == expected


@pytest.mark.parametrize(("name", "scenario", "budget", "every"), TOGETHER)
def test_runs_of_one_process_are_those_that_each_would_be_alone(
    tmp_path: Path, name: str, scenario: str, budget: int, every: int
) -> None:
    """Decisions and evaluations are the same; weights are so to rounding, for one pass adds in another order."""
    plan = small(name, scenario, budget, evaluations=3, seeds=(3, 4, 5))
    alone = plan.model_copy(update={"together": 1})
    assert [len(group) for group in alone.groups] == [1, 1, 1]
    whole(plan, tmp_path / "together")
    whole(alone, tmp_path / "alone")
    for run in plan.runs:
        one, other = (numbers_of(tmp_path / where, run.id) for where in ("together", "alone"))
        assert one == other
        for ours, theirs in zip(*(weights(tmp_path / where, run) for where in ("together", "alone")), strict=True):
            np.testing.assert_allclose(ours, theirs, rtol=1e-3, atol=1e-4)


def numbers_of(path: Path, run: str) -> list[Row]:
    return [dataclasses.replace(row, seconds=0.0) for row in Folder(path).rows(run)]


def weights(path: Path, run: Run) -> list[Array]:
    """What the networks of a run's only checkpoint hold."""
    (file,) = Folder(path).run(run.id).glob("learner-*.ckpt")
    made = course(run, builders("kinematic"), path, None)
    assert isinstance(made, FeedbackCourse)
    assert isinstance(made.learner, Seed)
    made.learner.load(file)
    made.close()
    return [value.detach().numpy() for value in made.learner._networks.parameters()]


def test_a_run_that_fails_leaves_the_others_of_its_process_alone(tmp_path: Path) -> None:
    plan = small("seed-recommended", "first_subgoal", 6, evaluations=2, seeds=(3, 4, 5))
    asked = itertools.count()
    told = work(plan.runs, plan, tmp_path / "study", builders("kinematic"), lambda: next(asked) >= 9)
    assert {each.state for each in told} == {"interrupted"}
    damaged = Folder(tmp_path / "study").run(plan.runs[1].id)
    (damaged / "evaluations.csv").unlink()
    told = work(plan.runs, plan, tmp_path / "study", builders("kinematic"), lambda: False)
    assert [each.state for each in told] == ["finished", "failed", "finished"]
    assert "delete the run's folder" in (told[1].error or "")
    shutil.rmtree(damaged)
    assert whole(plan, tmp_path / "study")[-1].evaluation == 2
    assert numbers_of(tmp_path / "study", plan.runs[1].id)[-1].decisions == 6


def test_a_damaged_checkpoint_of_several_runs_is_named(tmp_path: Path) -> None:
    plan = small("seed-recommended", "first_subgoal", 6, evaluations=2, seeds=(3, 4))
    asked = itertools.count()
    work(plan.runs, plan, tmp_path / "study", builders("kinematic"), lambda: next(asked) >= 7)
    (file,) = (tmp_path / "study" / "together").iterdir()
    file.write_text("{")
    told = work(plan.runs, plan, tmp_path / "study", builders("kinematic"), lambda: False)
    for each in told:
        assert each.state == "failed"
        assert f"study/together/{file.name} can't be read" in (each.error or "")
        assert "delete it" in (each.error or "")


def test_seeds_share_a_process_unless_another_would_be_idle() -> None:
    for processes, sizes in ((None, [1] * 5), (1, [5]), (2, [3, 2]), (8, [1] * 5)):
        plan = planned(
            "paper-sim",
            "kinematic",
            [(SCENARIOS["sweeping"], [CONTESTANTS["seed"]])],
            seeds=range(5),
            budgets={},
            protocol=Protocol(),
            oracle=ORACLE,
            processes=processes,
        )
        assert [len(group) for group in plan.groups] == sizes


def stopped(plan: Plan, path: Path, after: int = 25) -> Path:
    """The folder of the plan's only run, interrupted after some decisions."""
    asked = itertools.count()
    (run,) = plan.runs
    (progress,) = work([run], plan, path, builders("kinematic"), lambda: next(asked) >= after)
    assert progress.state == "interrupted"
    return Folder(path).run(run.id)


@pytest.mark.parametrize("content", [None, "{", '{"learner": "learner-1.ckpt"}', "[]"])
def test_a_run_never_goes_on_from_damaged_files(tmp_path: Path, content: str | None) -> None:
    plan = small("maple-aff", "sweeping", 9, evaluations=3)
    folder = stopped(plan, tmp_path / "study", after=8)
    file = "evaluations.csv" if content is None else "state.json"
    (folder / file).unlink() if content is None else (folder / file).write_text(content)
    (failed,) = work(plan.runs, plan, tmp_path / "study", builders("kinematic"), lambda: False)
    assert failed.state == "failed"
    assert failed.error is not None
    assert f"study/runs/{folder.name}/{file}" in failed.error
    assert "delete the run's folder" in failed.error
    shutil.rmtree(folder)
    assert whole(plan, tmp_path / "study")[-1].evaluation == 3


def test_keeping_rows_loses_none_wherever_it_is_killed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "evaluations.csv"
    rows = [Row(number, 9, 0, 0, 0, 0, 0, 0, 10, 5, 0.5) for number in range(4)]
    for row in rows:
        append_row(path, row)
    whole_file = path.stat()
    keep_rows(path, rows)
    assert path.stat().st_ino == whole_file.st_ino, "nothing is written where nothing changes"
    with path.open("a") as file:
        file.write("4,9,0")  # a torn line
    with monkeypatch.context() as killed:
        killed.setattr(Path, "replace", _killed)
        with pytest.raises(KeyboardInterrupt):
            keep_rows(path, rows[:2])
    assert read_rows(path) == rows
    keep_rows(path, rows[:2])
    append_row(path, rows[2])
    assert read_rows(path) == rows[:3]


def _killed(*_: object) -> None:
    raise KeyboardInterrupt


def test_a_judged_skill_that_was_refused_costs_no_low_level_step(tmp_path: Path) -> None:
    plan = small("seed", "reaching", 40, 2)
    last = whole(plan, tmp_path)[-1]
    assert last.decisions <= 8  # the budget would pay so many of the shortest skills
    assert (last.low_level_steps == 0) == (last.executions == 0)


def test_a_run_says_what_it_was_made_of(tmp_path: Path) -> None:
    plan = small("maple-aff", "sweeping", 2, 1)
    whole(plan, tmp_path)
    run = plan.runs[-1]
    described = (Folder(tmp_path).run(run.id) / "run.json").read_text("utf-8")
    for told in ('"seed": 3', '"adapter": "kinematic"', '"torch": "2', '"code": "', '"hidden_size": 16'):
        assert told in described


def test_a_judge_of_actions_says_how_well_it_does_itself(tmp_path: Path) -> None:
    plan = small("tamer", "reaching", 10, 1)
    folder = Folder(tmp_path)
    judge, judged = plan.runs
    assert judge.without_physics
    assert not judged.without_physics
    write_results(folder, plan)
    table = tmp_path / "table.md"
    assert "judged by SAC, TAMER's oracle, 10 low-level steps without physics: not trained yet" in table.read_text(
        "utf-8"
    )
    row = Row(1, 10, 10, 10, 1, 0, 0, 10, 10, 8, 1.0)  # 8 of 10 rollouts
    folder.run(judge.id).mkdir(parents=True)
    append_row(folder.run(judge.id) / "evaluations.csv", row)
    write_results(folder, plan)
    assert "solves 8 of 10 rollouts on the kinematic adapter. Warning: below 90% " in table.read_text("utf-8")
    append_row(folder.run(judge.id) / "evaluations.csv", dataclasses.replace(row, rollouts_succeeded=9))
    write_results(folder, plan)
    assert "solves 9 of 10" in table.read_text("utf-8")
    assert "Warning" not in table.read_text("utf-8")


def test_a_judge_learns_for_as_long_as_it_takes_however_short_the_study() -> None:
    for asked, expected in ((10, ORACLE_STEPS), (2 * ORACLE_STEPS, 2 * ORACLE_STEPS)):
        plan = planned(
            "paper-sim",
            "robosuite",
            [(SCENARIOS["reaching"], [CONTESTANTS["tamer"]])],
            seeds=[10],
            budgets={"reaching": asked},
            protocol=Protocol(),
            oracle=ORACLE,
        )
        assert [run.budget for run in plan.runs] == [expected, asked]


def test_a_run_whose_oracle_failed_fails_and_says_why(tmp_path: Path) -> None:
    plan = small("tamer", "reaching", 10, 1)
    (progress,) = work(plan.runs[-1:], plan, tmp_path, builders("kinematic"), lambda: False)
    assert progress.state == "failed"
    assert progress.error is not None
    assert "isn't finished" in progress.error
