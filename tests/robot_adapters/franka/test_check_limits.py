"""What `seed robot check` says of limits, which differ from arm to arm: with a double for the arm."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from robot_adapters.base import Unavailable
from robot_adapters.franka import FrankaSettings, checking, connecting
from robot_adapters.franka.backend import Facts
from robot_adapters.franka.checking import Finding, Verdict
from tests.robot_adapters.franka.conftest import never
from tests.simulators.still_arm import StillArm

Check = Callable[..., dict[str, Finding]]
JOINT_6 = 5


@pytest.fixture
def check(monkeypatch: pytest.MonkeyPatch) -> Check:
    def blind(_: str) -> object:
        raise Unavailable("there are no cameras", remedy="none")

    def checked(fci: int | None, joint_6: float, backend: str = "franka_rs") -> dict[str, Finding]:
        arm = StillArm()
        arm.joints[JOINT_6] = joint_6
        monkeypatch.setattr(arm, "facts", lambda: Facts("still", fci, "none", None))
        monkeypatch.setattr(connecting, "backend", lambda _: arm)
        monkeypatch.setattr(checking, "find_eyes", blind)
        monkeypatch.setattr(checking, "LISTENED", 0.01)
        settings = FrankaSettings.model_validate({"backend": backend, "realtime": False})
        found = checking.check(settings, "stacking", permit=lambda _: False, should_stop=never)
        return {each.what: each for each in found}

    return checked


@pytest.mark.parametrize(
    ("fci", "joint_6", "verdict", "said"),
    [
        (10, 4.0, Verdict.GOOD, "well within"),
        (5, 4.0, Verdict.BAD, "joint 6 is 14° beyond its limit"),
        (5, 0.4, Verdict.GOOD, "well within"),
        (10, 0.4, Verdict.BAD, "joint 6 is 8° beyond its limit"),
        (10, 4.47, Verdict.BAD, "joint 6 is 3° from its limit"),
        (None, 4.0, Verdict.BAD, "joint 6 is 14° beyond its limit"),
        (None, 0.4, Verdict.BAD, "joint 6 is 8° beyond its limit"),
    ],
)
def test_joints_are_held_against_the_limits_of_the_arm_that_is_there(
    check: Check, fci: int | None, joint_6: float, verdict: Verdict, said: str
) -> None:
    found = check(fci, joint_6)["joints"]
    assert (found.verdict, said in found.said) == (verdict, True), found


def test_what_deoxys_is_not_told_is_not_claimed(check: Check) -> None:
    assert "stops itself at 45 N" in check(10, 1.57)["force"].said
    said = check(None, 1.57, "deoxys")["force"].said
    assert "45" not in said
    assert "arm's computer" in said
