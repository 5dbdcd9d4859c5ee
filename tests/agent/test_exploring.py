"""What the critics' disagreement is, and what it speaks for."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import torch
from pydantic import ValidationError

from agent.algorithm import Suggestion
from agent.config import SEED, SeedSettings
from agent.exploring import disagreement, promise
from agent.seed import Seed
from tests.agent.problems import labels, problem

SMALL: dict[str, Any] = {"hidden_size": 16, "batch_size": 16, "candidates": 8}


def suggested(steps: int = 0, **settings: Any) -> Suggestion:
    """What a small learner suggests, after so many gradient steps on a few labels."""
    learner = Seed(problem(), SeedSettings(**(SMALL | settings)), 0)
    learner.add(labels(6))
    for _ in range(steps):
        learner.update()
    return learner.propose(np.ones(3))


def test_disagreement_is_how_far_the_critics_are_from_their_mean() -> None:
    assert disagreement(torch.tensor([0.5, 0.9])) == pytest.approx(0.2)
    assert disagreement(torch.tensor([1.0, -1.0, 0.0, 0.0])) == pytest.approx(0.5**0.5)
    assert disagreement(torch.tensor([0.3, 0.3])) == 0.0
    assert disagreement(torch.tensor([0.3])) is None


def test_without_curiosity_all_critics_must_call_it_good_with_it_one_is_enough() -> None:
    agreed, doubted = (0.3, 0.3), (0.9, -0.5)
    predicted = torch.tensor([agreed, doubted]).T
    assert promise(predicted, 0.0).tolist() == pytest.approx([0.3, -0.5])
    assert promise(predicted, 1.0).tolist() == pytest.approx([0.3, 0.9])  # 0.2 + 0.7
    # below a certain bad nothing is worse
    assert promise(torch.tensor([[-3.0], [-2.0]]), 0.0).tolist() == [-1.0]


@pytest.mark.parametrize("candidates", [0, 8])
def test_a_suggestion_tells_how_far_its_critics_disagree(candidates: int) -> None:
    assert suggested(critics=1, candidates=candidates).uncertainty is None
    spread = suggested(5, critics=3, candidates=candidates).uncertainty
    assert spread is not None
    assert spread > 0


def test_curiosity_changes_what_is_proposed() -> None:
    by_value = suggested(20, critics=2)
    assert suggested(20, critics=2, explore="value", explore_curiosity=9.0) == by_value
    assert suggested(20, critics=2, explore="uncertainty", explore_curiosity=9.0) != by_value


def test_uncertainty_without_an_ensemble_or_candidates_is_refused() -> None:
    for settings in ({"critics": 1, "candidates": 8}, {"critics": 2, "candidates": 0}):
        with pytest.raises(ValidationError, match="critics of 2 or more"):
            SeedSettings(explore="uncertainty", **settings)  # type: ignore[arg-type]
    for preset in SEED.presets.values():
        assert SeedSettings(**preset).explore == "value"
