"""What enters is checked and scaled; what leaves is inside the workspace."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agent.algorithm import AgentError, Label, Problem
from agent.encoding import Encoder
from robot_adapters.base import SkillCall, check_call
from tests.agent.problems import PICK, PUSH, RELEASE, problem

ENCODER = Encoder(problem())
GOOD = Label(1, np.ones(3), SkillCall("pick", (0.8, -0.25, 0.0)), 1)


def test_states_are_scaled_by_their_bounds() -> None:
    np.testing.assert_array_equal(ENCODER.state(np.array([0.0, 1.0, 2.0])), [-1, 0, 1])


def test_an_entry_that_never_changes_is_zero() -> None:
    still = Encoder(Problem("toy", np.array([0.0, 3.0]), np.array([1.0, 3.0]), (PICK,)))
    np.testing.assert_array_equal(still.state(np.array([1.0, 3.0])), [1, 0])


def test_parameters_are_normalised_and_padded() -> None:
    entry = ENCODER.entry(GOOD, affordance_penalty=0.1)
    np.testing.assert_allclose(entry.parameters, [1, -1, 0, 0, 0], atol=1e-7)
    assert (entry.skill, entry.value, entry.target) == (0, 1, 1.0)


@pytest.mark.parametrize("value", [-1, 0, 1])
def test_the_affordance_penalty_lowers_a_label_that_is_near_nothing(value: int) -> None:
    label = dataclasses.replace(GOOD, value=value, near=False)
    entry = ENCODER.entry(label, affordance_penalty=0.1)
    assert entry.target == pytest.approx(value - 0.1)
    assert entry.value == value, "the half it belongs to is the trainer's, not the penalty's"


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_a_value_that_is_not_finite_is_named(bad: float) -> None:
    with pytest.raises(AgentError, match=r"block_position\[1\]") as error:
        ENCODER.state(np.array([0.0, bad, 1.0]))
    assert error.value.remedy


def test_without_names_the_index_is_told() -> None:
    nameless = Encoder(dataclasses.replace(problem(), state_names=()))
    with pytest.raises(AgentError, match=r"state\[2\] = nan"):
        nameless.state(np.array([0.0, 0.0, np.nan]))


@pytest.mark.parametrize("shape", [(2,), (4,), (1, 3), ()])
def test_a_state_of_another_shape_is_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(AgentError, match=r"shape .* \(3,\)"):
        ENCODER.state(np.zeros(shape))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"value": 2}, "label 1 has the value 2"),
        ({"call": SkillCall("fly", ())}, "label 1: the task has no skill 'fly'"),
        ({"call": SkillCall("pick", (0.5,))}, "label 1: pick takes 3 parameters, got 1"),
        ({"call": SkillCall("pick", (9.0, 0.0, 0.0))}, r"label 1: pick\.x = 9\.0 is outside"),
        ({"state": np.array([0.0, 0.0, np.nan])}, r"block_position\[2\]"),
    ],
)
def test_a_label_that_does_not_fit_is_refused(change: dict[str, object], message: str) -> None:
    label = Label(**{**{f.name: getattr(GOOD, f.name) for f in dataclasses.fields(Label)}, **change})
    with pytest.raises(AgentError, match=message) as error:
        ENCODER.entry(label, affordance_penalty=0)
    assert error.value.remedy


@given(st.integers(0, 2), st.lists(st.floats(-1.0001, 1.0001), min_size=5, max_size=5))
def test_every_call_is_inside_the_workspace(skill: int, parameters: list[float]) -> None:
    check_call(ENCODER.call(skill, np.array(parameters)), (PICK, PUSH, RELEASE))


@given(st.lists(st.floats(-1, 1), min_size=5, max_size=5))
def test_a_call_comes_back_as_its_parameters(parameters: list[float]) -> None:
    label = Label(1, np.ones(3), ENCODER.call(1, np.array(parameters)), 1)
    np.testing.assert_allclose(ENCODER.entry(label, affordance_penalty=0).parameters, parameters, atol=1e-6)


@pytest.mark.parametrize(
    "bad",
    [
        Problem("toy", np.zeros(3), np.ones(2), (PICK,)),
        Problem("toy", np.zeros(0), np.ones(0), (PICK,)),
        Problem("toy", np.array([0.0]), np.array([np.inf]), (PICK,)),
        Problem("toy", np.array([1.0]), np.array([0.0]), (PICK,)),
        Problem("toy", np.zeros(3), np.ones(3), ()),
        Problem("toy", np.zeros(3), np.ones(3), (PICK, PICK)),
    ],
)
def test_a_senseless_problem_is_refused(bad: Problem) -> None:
    with pytest.raises(AgentError, match="'toy'") as error:
        Encoder(bad)
    assert error.value.remedy
