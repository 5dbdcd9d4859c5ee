"""Safety violations: what is stored of one, who is asked, and when an experiment goes on by itself."""

from __future__ import annotations

import itertools
import json
from collections.abc import Iterable
from typing import Any

import pytest

from server.violations import Response, respond
from tests.live import LiveService, wait_for

PATIENCE = 90.0
_clicks = itertools.count(1)


def clumsy(service: LiveService, violation: str, every: int = 1, **fields: Any) -> int:
    """A started experiment whose robot breaks a rule in every n-th execution; what it is proposed is always right."""
    settings = {"violation": violation, "every": every, "draw": False}
    made = service.experiment(adapter="clumsy", adapter_settings=settings, **fields)
    service.post(f"/experiments/{made}/start")
    return made


def approve(service: LiveService, experiment: int, number: int) -> None:
    """Click good on the proposal of this number once it is open."""

    def opened() -> dict[str, Any] | None:
        newest = service.get(f"/experiments/{experiment}/proposals?limit=1")["items"]
        return newest[0] if newest and newest[0]["number"] == number else None

    proposal = wait_for(opened, f"proposal {number}", PATIENCE)
    body = {"click_id": f"violation-{next(_clicks)}", "value": 1}
    service.post(f"/proposals/{proposal['id']}/feedback", body)


def journal(service: LiveService, experiment: int, *kinds: str) -> list[tuple[str, dict[str, Any]]]:
    """Lines of these kinds, oldest first."""
    rows = service.rows("SELECT kind, payload FROM event WHERE experiment_id = ? ORDER BY id", experiment)
    return [(row["kind"], json.loads(row["payload"])) for row in rows if row["kind"] in kinds]


def violations(service: LiveService, experiment: int) -> list[tuple[str, str]]:
    query = "SELECT kind, detail FROM violation WHERE experiment_id = ? ORDER BY id"
    return [(row["kind"], row["detail"]) for row in service.rows(query, experiment)]


def outcomes(service: LiveService, experiment: int) -> list[str | None]:
    """How each episode ended."""
    return [
        row[0] for row in service.rows("SELECT outcome FROM episode WHERE experiment_id = ? ORDER BY id", experiment)
    ]


def test_damage_stops_everything_until_an_operator_lifts_the_stop(service: LiveService) -> None:
    experiment = clumsy(service, "damage")
    approve(service, experiment, 1)
    seen = wait_for(lambda: _if(service, experiment, halted=True), "the stop", PATIENCE)
    assert seen["lifecycle"] == "paused"
    (told,) = wait_for(lambda: journal(service, experiment, "operator_needed"), "the journal")
    assert violations(service, experiment) == [("damage", "bumped into the table")]
    assert service.get(f"/experiments/{experiment}")["counters"]["violations"] == 1
    assert told[1] == {"response": "halt", "why": ["bumped into the table"]}
    kinds = [kind for kind, _ in journal(service, experiment, "execution_ended", "incident", "halt", "operator_needed")]
    assert kinds == ["execution_ended", "incident", "halt", "operator_needed"]
    ((_, incident),) = journal(service, experiment, "incident")
    (execution,) = service.get(f"/experiments/{experiment}/executions")["items"]
    assert incident["execution"] == execution["id"]
    assert incident["proposal"] == execution["proposal_id"]
    assert (execution["outcome"], execution["end_reason"]) == ("failed", "force_limit")

    # latched: nothing moves before the re-arm, and nothing by the re-arm alone
    assert service.http.post(f"/api/v1/experiments/{experiment}/resume").status_code == 409
    assert service.post(f"/experiments/{experiment}/rearm")["lifecycle"] == "paused"
    service.post(f"/experiments/{experiment}/resume")
    approve(service, experiment, 2)
    wait_for(lambda: _if(service, experiment, halted=True), "the second stop", PATIENCE)
    wait_for(lambda: outcomes(service, experiment) == ["violation", "violation"], "both episodes to end")


def test_a_study_on_a_simulator_records_damage_and_goes_on(service: LiveService) -> None:
    experiment = clumsy(service, "damage", every=2, teacher="synthetic")
    wait_for(lambda: service.get(f"/experiments/{experiment}")["counters"]["violations"] >= 3, "violations", PATIENCE)
    service.post(f"/experiments/{experiment}/pause")
    wait_for(lambda: _if(service, experiment, phase="idle"), "the loop's end", PATIENCE)
    ended = service.get(f"/experiments/{experiment}")
    counters = ended["counters"]
    assert (ended["halted"], ended["lifecycle"]) == (False, "paused")
    assert len(violations(service, experiment)) == counters["violations"]
    assert len(journal(service, experiment, "incident")) == counters["violations"]
    assert not journal(service, experiment, "halt", "operator_needed", "fail")
    assert outcomes(service, experiment).count("violation") == counters["violations"]
    points = service.get(f"/experiments/{experiment}/metrics?limit=200")["items"]
    newest = max(points, key=lambda point: point["feedback"])
    assert newest["feedback"] == counters["feedback"]
    assert newest["values"]["violation_ratio"] == newest["values"]["violations"] / newest["feedback"]
    assert newest["values"]["violation_ratio"] > 0


def test_a_simulated_robot_puts_itself_right(service: LiveService) -> None:
    experiment = clumsy(service, "manual_reset")
    approve(service, experiment, 1)
    approve(service, experiment, 2)
    wait_for(lambda: len(violations(service, experiment)) == 2, "two violations", PATIENCE)
    assert {kind for kind, _ in violations(service, experiment)} == {"manual_reset"}
    seen = service.get(f"/experiments/{experiment}")
    assert (seen["lifecycle"], seen["halted"]) == ("running", False)
    wait_for(lambda: outcomes(service, experiment)[:2] == ["violation"] * 2, "new episodes", PATIENCE)
    assert not journal(service, experiment, "incident", "halt", "operator_needed")
    service.post(f"/experiments/{experiment}/finish")


def test_damage_ends_a_rollout_and_the_evaluation_goes_on(service: LiveService) -> None:
    settings = {"violation": "damage", "every": 2, "draw": False}
    experiment = service.experiment(adapter="clumsy", adapter_settings=settings)
    service.post(f"/experiments/{experiment}/evaluate", {"rollouts": 3})

    def ended() -> dict[str, Any] | None:
        (evaluation,) = service.get(f"/experiments/{experiment}/evaluations")["items"]
        return evaluation if evaluation["ended_at"] else None

    evaluation = wait_for(ended, "the evaluation", PATIENCE)
    assert (evaluation["rollouts"], evaluation["successes"]) == (3, 0)
    assert outcomes(service, experiment) == ["violation"] * 3
    assert len(journal(service, experiment, "incident")) == 3
    assert service.get(f"/experiments/{experiment}")["counters"]["violations"] == 0, "an evaluation trains nothing"


@pytest.mark.parametrize(
    ("kinds", "simulated", "taught", "response"),
    [
        ((), False, False, Response.NOTHING),
        (("damage",), True, True, Response.NEW_EPISODE),
        (("damage",), True, False, Response.HALT),
        (("damage",), False, True, Response.HALT),
        (("damage",), False, False, Response.HALT),
        (("manual_reset",), True, True, Response.NEW_EPISODE),
        (("manual_reset",), True, False, Response.NEW_EPISODE),
        (("manual_reset",), False, True, Response.PAUSE),
        (("manual_reset",), False, False, Response.PAUSE),
        (("manual_reset", "damage"), False, False, Response.HALT),
    ],
)
def test_a_person_is_asked_where_people_judge_or_things_can_break(
    kinds: Iterable[str], simulated: bool, taught: bool, response: Response
) -> None:
    assert respond(kinds, simulated=simulated, taught=taught) is response


def _if(service: LiveService, experiment: int, **wanted: Any) -> dict[str, Any] | None:
    seen = service.get(f"/experiments/{experiment}")
    return seen if all(seen[name] == value for name, value in wanted.items()) else None
