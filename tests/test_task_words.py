"""The page says what this project's tasks say in every language that it speaks."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from robot_adapters import registry

ROOT = Path(__file__).parent.parent
ENGLISH = json.loads((ROOT / "web" / "src" / "i18n" / "locales" / "en.json").read_text("utf-8"))["task"]


@pytest.mark.parametrize("name", ["reaching", "stacking", "sweeping", "collecting_toy", "cooking_hotdog"])
def test_every_word_of_a_task_can_be_translated(name: str) -> None:
    task = registry.task(name)
    by_hand: str = task.reset_by_hand  # type: ignore[attr-defined]
    for text in (*(subgoal.description for subgoal in task.subgoals), by_hand, task.instruction):
        key = re.sub(r"[^a-z]+", "_", text.lower()).removeprefix("_")[:60].removesuffix("_")
        assert ENGLISH.get(key) == text, f'add "{key}" to the section "task" of every language'
