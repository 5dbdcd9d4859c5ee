"""The list of ingredients: each row is a change of `recommended`, and nothing else."""

from __future__ import annotations

import subprocess
import sys

import pytest

from agent.ablation import ABLATIONS, LADDER
from agent.config import PAPER_SIM, RECOMMENDED, SEED, SeedSettings

RECOMMENDED_SETTINGS = SeedSettings(**SEED.presets["recommended"])


@pytest.mark.parametrize("name", [name for name in ABLATIONS if name != "nothing"])
def test_a_row_takes_something_away(name: str) -> None:
    row = ABLATIONS[name]
    changed = SeedSettings(**{**RECOMMENDED, **row.settings})
    assert all(getattr(changed, field) != getattr(RECOMMENDED_SETTINGS, field) for field in row.settings)
    assert row.settings
    assert len(row.sentence) > 20


def test_the_reference_row_takes_nothing_away() -> None:
    assert dict(ABLATIONS["nothing"].settings) == {}


def test_every_setting_of_the_preset_is_in_some_row() -> None:
    """Whoever adds an ingredient to the preset adds the row without it."""
    covered = {field for row in ABLATIONS.values() for field in row.settings}
    assert set(RECOMMENDED) <= covered


def test_the_ladder_leads_from_the_paper_to_the_preset() -> None:
    rungs = [SeedSettings(**{**RECOMMENDED, **row.settings}) for row in LADDER.values()]
    assert rungs[0] == SeedSettings(**PAPER_SIM)
    assert rungs[-1] == RECOMMENDED_SETTINGS
    for (name, row), below in zip(list(LADDER.items())[1:], list(LADDER.values()), strict=False):
        assert set(row.settings) < set(below.settings), f"{name} adds nothing"


def test_reading_the_list_loads_no_torch() -> None:
    script = "import sys, agent.ablation\nassert 'torch' not in sys.modules"
    subprocess.run([sys.executable, "-c", script], check=True, timeout=300)
