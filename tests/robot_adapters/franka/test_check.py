"""`seed robot check` on the simulated Franka: in plain words, asking before it moves, and telling what is wrong."""

from __future__ import annotations

import json

import pytest
from typer.testing import CliRunner

from server.cli import app
from tests.simulators.franka import SimulatedFranka

pytestmark = pytest.mark.simulated_arm


def options(arm: SimulatedFranka, backend: str = "franka_rs") -> list[str]:
    eyes = ["--set", "adapter.eyes=onlooker", "--set", f'adapter.eyes_settings={{"host": "{arm.host}"}}']
    return ["robot", "check", "--host", arm.host, "--backend", backend, "--set", "adapter.realtime=false", *eyes]


@pytest.mark.long
@pytest.mark.parametrize("backend", ["franka_rs", "franky"])
def test_an_arm_that_is_ready_is_told_so_after_a_slow_dry_run(arm: SimulatedFranka, backend: str) -> None:
    arm.tell(user_stop=False, plug=True, lock_step=True, heal=True)
    ran = CliRunner().invoke(app, [*options(arm, backend), "--yes", "--json"])
    told = json.loads(ran.stdout.splitlines()[-1])
    assert (ran.exit_code, told["ok"]) == (0, True), ran.output
    found = {each["what"]: each["verdict"] for each in told["findings"]}
    assert found["connection"] == found["dry run"] == "good"


def test_it_asks_before_it_moves_and_no_is_an_answer(arm: SimulatedFranka) -> None:
    arm.tell(user_stop=False, plug=True, lock_step=True, heal=True)
    ran = CliRunner().invoke(app, options(arm), input="n\n")
    assert ran.exit_code == 0, ran.output
    assert "not tried: dry run" in ran.output


def test_a_pressed_user_stop_is_told_with_what_to_do(arm: SimulatedFranka) -> None:
    arm.tell(user_stop=True)
    try:
        ran = CliRunner().invoke(app, [*options(arm), "--yes", "--json"])
    finally:
        arm.tell(user_stop=False, heal=True)
    told = json.loads(ran.stdout.splitlines()[-1])
    wrong = [each for each in told["findings"] if each["verdict"] == "bad"]
    assert ran.exit_code == 1
    assert any("stop" in each["said"] for each in wrong)
    assert all(each["remedy"] for each in wrong)


def test_an_address_where_no_arm_answers_is_told() -> None:
    ran = CliRunner().invoke(
        app, ["robot", "check", "--host", "127.0.0.99", "--set", "adapter.realtime=false", "--json"]
    )
    assert ran.exit_code == 3, ran.output
    assert json.loads(ran.stdout.splitlines()[-1])["findings"][0]["remedy"]
