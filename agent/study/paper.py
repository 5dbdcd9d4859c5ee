"""What the paper's figures and its safety table show (`paper_figures.json`, which names its source)."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Any


@dataclass(frozen=True)
class PaperCurve:
    """One curve of a figure. trial: which of several single runs; None where it is the mean of all."""

    algorithm: str
    trial: int | None
    x: tuple[float, ...]
    y: tuple[float, ...]


def curves(scenario: str) -> tuple[PaperCurve, ...]:
    """The curves of a scenario's figure, in the scenario's own axis and measure; none where the paper shows none."""
    stored = _figures()["scenarios"].get(scenario, {"curves": ()})
    return tuple(
        PaperCurve(each["algorithm"], each["trial"], (*each["x"],), (*each["y"],)) for each in stored["curves"]
    )


def note(scenario: str) -> str:
    """What the scenario's curves were measured on; empty where there are none."""
    return str(_figures()["scenarios"].get(scenario, {}).get("note", ""))


def source() -> str:
    """Where the values are from."""
    return str(_figures()["source"])


def violation_ratios(scenario: str) -> Mapping[str, float]:
    """Algorithm -> safety violations over decision steps."""
    return dict(_figures()["violations"].get(scenario, {}))


@cache
def _figures() -> dict[str, Any]:
    text = resources.files("agent.study").joinpath("paper_figures.json").read_text("utf-8")
    loaded: dict[str, Any] = json.loads(text)
    return loaded
