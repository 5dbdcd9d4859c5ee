"""Curves of experiments: what the rows say, thinned out, compared, and beside the paper's."""

from __future__ import annotations

import csv
import json
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from sqlalchemy import create_engine, select, update

from server import comparing, store_curves
from server.models import FeedbackRow
from server.schemas import ExecutionOutcome, ExperimentUpdate
from server.schemas_curves import Chart, Curves
from server.store import NotFound, Store
from tests.server.databases import begun, click, opened, running
from tests.server.serving import serving
from tests.server.test_errors import check_problem


async def curves(store: Store, experiment: int, points: int = 400) -> Curves:
    return await store.read(lambda session: store_curves.curves(session, experiment, points))


def chart(told: Curves, name: str) -> Chart:
    return next(each for each in told.charts if each.name == name)


async def judged(
    store: Store, experiment: int, number: int, value: int, *, steps: int = 0, success: bool = False
) -> None:
    """A proposal with its label and metrics; executed where it is good."""
    observation = f"o{number}"
    proposal = await opened(store, experiment, observation, predicted_feedback=0.5)
    await store.submit_feedback(proposal.id, click(value))
    if value == 1:
        _, execution = await begun(store, proposal.id, observation)
        await store.end_execution(
            execution.id,
            ExecutionOutcome.SUCCEEDED,
            end_reason="arrived",
            low_level_steps=steps,
            task_success=success,
        )
    counters = (await store.experiment(experiment)).counters
    values = {"successes": float(counters.successes), "critic_loss": 1.0 / number, "own_metric": 2.0}
    await store.add_metrics(experiment, [(number, values | {"good_share": counters.good / number})])


async def test_the_curves_tell_what_the_rows_say(store: Store) -> None:
    experiment = await running(store)
    for number in range(1, 31):
        await judged(store, experiment, number, 1 if number % 3 == 0 else -1, steps=100)
    told = await curves(store, experiment)
    assert told.feedback == 30
    assert chart(told, "critic_loss").curves[0].y == pytest.approx([1.0 / n for n in range(1, 31)], rel=1e-5)
    overall, recent = chart(told, "good_share").curves
    assert overall.y[-1] == pytest.approx(1 / 3, rel=1e-5)
    assert recent.x == [10, 20, 30]
    assert recent.y == pytest.approx([0.3, 0.3, 0.4])
    predicted, label = chart(told, "estimates").curves
    assert predicted.y == pytest.approx([0.5] * 3)
    assert label.y == pytest.approx([-0.4, -0.4, -0.2])
    assert chart(told, "estimate_error").curves[0].y == pytest.approx([1.2, 1.2, 1.1])
    assert [(c.name, c.x, c.y) for c in chart(told, "skills").curves] == [("pick", [10, 20, 30], [1, 1, 1])]
    assert chart(told, "own_metric").curves[0].y == [2.0] * 30
    assert not {"temperatures", "success_rate"} & {each.name for each in told.charts}


async def test_few_points_leave_the_database_and_the_newest_is_among_them(sqlite_store: Store) -> None:
    experiment = await running(sqlite_store)
    for number in range(1, 206):
        await sqlite_store.add_metrics(experiment, [(number, {"successes": float(number // 2)})])
    line = chart(await curves(sqlite_store, experiment, 20), "successes").curves[0]
    assert len(line.x) <= 21
    assert (line.x[-1], line.y[-1]) == (205, 102)


@pytest.mark.parametrize("gap", [0.4, 1.5])
async def test_the_speed_of_labels_that_come_within_fractions_of_a_second(store: Store, url: str, gap: float) -> None:
    experiment = await running(store)
    for number in range(61):
        proposal = await opened(store, experiment, f"o{number}")
        await store.submit_feedback(proposal.id, click(-1))
    start = datetime(2026, 1, 1, tzinfo=UTC)
    engine = create_engine(url)
    with engine.begin() as connection:
        rows = connection.scalars(select(FeedbackRow.id).order_by(FeedbackRow.id)).all()
        for number, row in enumerate(rows):
            at = start + timedelta(seconds=gap * number)
            connection.execute(update(FeedbackRow).where(FeedbackRow.id == row).values(received_at=at))
    engine.dispose()
    (line,) = chart(await curves(store, experiment), "throughput").curves
    assert line.x[:3] == [20, 40, 60]
    # twenty labels take 8 s at least, and a database that knows whole seconds is off by less than one
    assert line.y[:3] == pytest.approx([60 / gap] * 3, rel=0.16)


async def test_evaluations_stand_at_the_steps_trained_before_them(store: Store) -> None:
    experiment = await running(store)
    await judged(store, experiment, 1, 1, steps=250)
    for successes in (2, 8):
        evaluation = await store.create_evaluation(experiment, rollouts=10, seed=1)
        await store.update_evaluation(evaluation.id, done=10, successes=successes, low_level_steps=999, ended=True)
    (line,) = chart(await curves(store, experiment), "success_rate").curves
    assert line.y == [0.2, 0.8]
    assert line.low is not None
    assert line.high is not None
    spread = (0.2 * 0.8 / 10) ** 0.5
    assert (line.low[0], line.high[0]) == pytest.approx((0.2 - spread, 0.2 + spread))
    assert set(line.x) <= {0, 250}, "an evaluation's own steps train nothing"


async def test_experiments_that_agree_are_one_curve_with_its_standard_error(store: Store) -> None:
    made = []
    for factor in (1, 3, 5):
        experiment = await running(store, name=f"times {factor}", task="stacking" if factor < 5 else "reaching")
        for number in (1, 2, 3):
            await store.add_metrics(experiment, [(number, {"successes": float(factor * number)})])
        made.append(experiment)
    empty = await running(store)
    each = await store.read(lambda s: comparing.compare(s, [*made, empty], "successes", []))
    first = each.curves[0]
    assert (first.label, first.mean, first.sem[-1]) == ("times 1", [1, 2, 3], None)
    assert each.missing == [empty]
    grouped = await store.read(lambda s: comparing.compare(s, made, "successes", ["task", "algorithm"]))
    first, second = grouped.curves
    assert (first.label, first.experiments, first.mean) == ("stacking · seed", made[:2], [2, 4, 6])
    assert first.sem == pytest.approx([1, 2, 3])
    assert (second.label, second.experiments) == ("reaching · seed", made[2:])
    await store.update_experiment(made[0], ExperimentUpdate(tags=["a"]))
    tagged = await store.read(lambda s: comparing.compare(s, made, "successes", ["tag"]))
    assert [c.label for c in tagged.curves] == ["a", "none"]
    with pytest.raises(NotFound):
        await store.read(lambda s: comparing.compare(s, [999], "successes", []))


async def test_metrics_are_exported_whole_with_every_column(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        for number in range(1, 604):
            values = {"successes": 1.0 * number} | ({"late": 0.5} if number > 600 else {})
            await live.service.store.add_metrics(experiment, [(number, values)])
        address = f"/api/v1/experiments/{experiment}/exports/metrics"
        table = list(csv.DictReader((await live.http.get(address)).text.splitlines()))
        assert [(row["feedback"], row["successes"], row["late"]) for row in (table[0], table[-1])] == [
            ("1", "1.0", ""),
            ("603", "603.0", "0.5"),
        ]
        lines = (await live.http.get(address, params={"format": "jsonl"})).text.splitlines()
        assert len(lines) == len(table) == 603
        assert json.loads(lines[-1])["late"] == 0.5
        check_problem(await live.http.get("/api/v1/experiments/99/exports/metrics"), 404)


async def test_curves_comparison_and_the_papers_figures_over_http(tmp_path: Path) -> None:
    async with serving(tmp_path) as live:
        experiment = await live.experiment()
        assert (await live.http.get(f"/api/v1/experiments/{experiment}/curves")).json()["charts"] == []
        check_problem(await live.http.get("/api/v1/experiments/99/curves"), 404)
        check_problem(await live.http.get(f"/api/v1/experiments/{experiment}/curves", params={"points": 5}), 422)
        compared = await live.http.get("/api/v1/comparison", params={"experiment": [experiment], "by": ["task"]})
        assert compared.json()["missing"] == [experiment]
        check_problem(await live.http.get("/api/v1/comparison"), 422)
        check_problem(await live.http.get("/api/v1/comparison", params={"experiment": 1, "measure": "beauty"}), 422)
        paper = (await live.http.get("/api/v1/paper-figures")).json()
        stacking = next(each for each in paper["figures"] if each["scenario"] == "stacking")
        assert (stacking["axis"], stacking["measure"]) == ("low_level_steps", "success_rate")
        assert {curve["algorithm"] for curve in stacking["curves"]} >= {"seed", "maple-aff"}
        assert "Hiranaka" in paper["source"]
