"""Settings and presets of the baselines, and that listing them loads no torch."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable

import numpy as np
import pytest
from pydantic import ValidationError

from agent.algorithm import AgentError
from agent.baseline_config import BASELINES, MapleFactory, MapleSettings, SacFactory, SacSettings, TamerFactory
from agent.config import SeedSettings
from tests.agent.problems import problem

MAPLE = MapleFactory("maple", "MAPLE", MapleSettings)


def test_listing_baselines_loads_no_torch() -> None:
    script = (
        "import sys, agent.baseline_config as c\n"
        "[(b.settings.model_json_schema(), dict(b.presets), b.acts_with) for b in c.BASELINES.values()]\n"
        "assert 'torch' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", script], check=True, timeout=300)


def test_there_are_the_papers_four() -> None:
    assert {name: b.acts_with for name, b in BASELINES.items()} == {
        "sac": "low_level",
        "tamer": "low_level",
        "maple": "skills",
        "maple-aff": "skills",
    }
    for name, baseline in BASELINES.items():
        assert baseline.name == name
        assert len(baseline.description) > 20


@pytest.mark.parametrize(
    ("name", "preset", "row"),
    [
        ("sac", "paper_sim", (3e-5, 256, 0.99, 5, 1)),
        ("tamer", "paper_sim", (3e-5, 256, 0.99, 5, 1)),
        ("tamer", "paper_real", (3e-4, 1024, 0.99, 30, 25)),
        ("maple", "paper_sim", (3e-3, 256, 0.99, 5, 1)),
        ("maple", "paper_real", (3e-3, 1024, 0.4, 3, 2)),
        ("maple-aff", "paper_sim", (3e-3, 256, 0.99, 5, 1)),
        ("maple-aff", "paper_real", (3e-3, 1024, 0.4, 3, 2)),
    ],
)
def test_presets_are_the_columns_of_the_papers_table(name: str, preset: str, row: tuple[float, ...]) -> None:
    baseline = BASELINES[name]
    s = baseline.settings(**baseline.presets[preset])
    assert (s.learning_rate, s.batch_size, s.discount, s.gradient_steps, s.train_frequency) == row
    assert (s.hidden_layers, s.hidden_size) == (2, 256)


@pytest.mark.parametrize("name", list(BASELINES))
def test_the_defaults_are_the_simulation_column(name: str) -> None:
    baseline = BASELINES[name]
    assert baseline.settings() == baseline.settings(**baseline.presets["paper_sim"])


@pytest.mark.parametrize("name", list(BASELINES))
def test_every_preset_fits(name: str) -> None:
    presets = BASELINES[name].presets
    assert {"paper_sim", "quick"} <= set(presets)
    for chosen in presets.values():
        BASELINES[name].settings(**chosen)


def test_only_maple_aff_penalises() -> None:
    penalties = [b.settings().model_dump().get("affordance_penalty") for b in BASELINES.values()]
    assert penalties == [None, None, 0.0, 0.1]


@pytest.mark.parametrize("name", list(BASELINES))
def test_every_setting_is_described_and_bounded(name: str) -> None:
    for field, schema in BASELINES[name].settings.model_json_schema()["properties"].items():
        assert len(schema["description"]) > 20, field
        assert "default" in schema, field
        assert {"minimum", "exclusiveMinimum"} & schema.keys(), field
        assert {"maximum", "exclusiveMaximum"} & schema.keys(), field


@pytest.mark.parametrize(
    ("name", "values", "where"),
    [
        ("sac", {"learning_rate": float("nan")}, ("learning_rate",)),
        ("sac", {"critics": 2}, ("critics",)),
        ("sac", {"replay_size": 1}, ("replay_size",)),
        ("tamer", {"strictness": 0.0}, ("strictness",)),
        ("tamer", {"strictness": 0.9999, "final_strictness": 0.999}, ()),
        ("maple", {"affordance_penalty": -0.1}, ("affordance_penalty",)),
        ("maple", {"target_rate": 0.0}, ("target_rate",)),
    ],
)
def test_a_bad_setting_is_refused_by_name(name: str, values: dict[str, object], where: tuple[str, ...]) -> None:
    with pytest.raises(ValidationError) as error:
        BASELINES[name].settings.model_validate(values)
    assert [e["loc"] for e in error.value.errors()] == [where]


def test_settings_of_another_algorithm_are_refused() -> None:
    low, high, other = np.zeros(1), np.ones(1), SeedSettings()
    oracle = SacFactory()(low, high, 1, SacSettings(hidden_size=8), 0)
    attempts: tuple[Callable[[], object], ...] = (
        lambda: SacFactory()(low, high, 1, other, 0),
        lambda: TamerFactory()(low, high, 1, SacSettings(), 0, oracle=oracle),
        lambda: MAPLE(problem(), other, 0),
    )
    for attempt in attempts:
        with pytest.raises(AgentError, match=r"Settings, not \w+Settings") as error:
            attempt()
        assert "`settings` model" in error.value.remedy
