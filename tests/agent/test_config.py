"""Settings, presets, and that listing algorithms loads no torch."""

from __future__ import annotations

import subprocess
import sys
from importlib.metadata import EntryPoint

import pytest
from pydantic import BaseModel, ValidationError

from agent.algorithm import AgentError
from agent.config import SEED, SeedSettings
from tests.agent.problems import problem


def test_listing_algorithms_loads_no_torch() -> None:
    script = (
        "import sys, agent.config as c\n"
        "c.SEED.settings.model_json_schema(), dict(c.SEED.presets)\n"
        "assert 'torch' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", script], check=True, timeout=300)


def test_the_entry_point_names_the_factory() -> None:
    assert EntryPoint("seed", "agent.config:SEED", "seed.algorithms").load() is SEED


@pytest.mark.parametrize(
    ("preset", "row"),
    [
        ("paper_sim", (3e-3, 256, 0.99, 5, 1, 0.0)),
        ("paper_real", (3e-3, 1024, 0.4, 30, 25, 0.1)),
    ],
)
def test_presets_are_the_columns_of_the_papers_table(preset: str, row: tuple[float, ...]) -> None:
    s = SeedSettings(**SEED.presets[preset])
    assert (s.learning_rate, s.batch_size, s.discount, s.gradient_steps, s.train_frequency, s.affordance_penalty) == row
    assert (s.hidden_layers, s.hidden_size, s.critics) == (2, 256, 2), "MAPLE's, where the paper is silent"


@pytest.mark.parametrize("preset", ["paper_sim", "paper_real"])
def test_the_papers_presets_use_nothing_the_paper_lacks(preset: str) -> None:
    s = SeedSettings(**SEED.presets[preset])
    assert (s.keypoints, s.relative_critic, s.grounded_actor, s.candidates, s.recall) == ("none", False, False, 0, 0)
    assert (s.augment_translation, s.augment_flip, s.augment_rotation) == (0.0, False, False)
    assert (s.explore_elimination, s.consensus, s.balanced_replay) == (False, 0.0, True)
    assert not s.trainer_reliability


def test_every_setting_is_described_and_bounded() -> None:
    for name, schema in SeedSettings.model_json_schema()["properties"].items():
        assert len(schema["description"]) > 20, name
        assert "default" in schema, name
        if schema["type"] == "boolean" or "enum" in schema:
            continue
        assert {"minimum", "exclusiveMinimum"} & schema.keys(), name
        assert {"maximum", "exclusiveMaximum"} & schema.keys(), name


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("learning_rate", 0.0),
        ("learning_rate", float("nan")),
        ("learning_rate", "fast"),
        ("batch_size", 3),
        ("batch_size", 256.5),
        ("batch_size", "256"),
        ("gradient_steps", -1),
        ("train_frequency", 0),
        ("discount", 1.01),
        ("affordance_penalty", -0.1),
        ("hidden_layers", True),
        ("leraning_rate", 1e-3),
    ],
)
def test_a_bad_setting_is_refused_by_name(field: str, value: object) -> None:
    with pytest.raises(ValidationError) as error:
        SeedSettings.model_validate({field: value})
    assert [e["loc"] for e in error.value.errors()] == [(field,)]


def test_settings_of_another_algorithm_are_refused() -> None:
    class Other(BaseModel):
        pass

    with pytest.raises(AgentError, match="Other, not SeedSettings"):
        SEED(problem(), Other(), 0)
