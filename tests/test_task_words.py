"""The page says what this project's tasks and its service say in every language that it speaks."""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from robot_adapters import registry

ROOT = Path(__file__).parent.parent
WORDS = json.loads((ROOT / "web" / "src" / "i18n" / "locales" / "en.json").read_text("utf-8"))
ENGLISH = WORDS["task"]
MADE_OF_PARTS = {"fields_first", "fields_more", "late_superseded", "cant_be_asked"}
PYDANTIC = ("Input should ", "String should ", "Field required", "Extra inputs ")


@pytest.mark.parametrize("name", ["reaching", "stacking", "sweeping", "collecting_toy", "cooking_hotdog"])
def test_every_word_of_a_task_can_be_translated(name: str) -> None:
    task = registry.task(name)
    by_hand: str = task.reset_by_hand  # type: ignore[attr-defined]
    for text in (*(subgoal.description for subgoal in task.subgoals), by_hand, task.instruction):
        key = re.sub(r"[^a-z]+", "_", text.lower()).removeprefix("_")[:60].removesuffix("_")
        assert ENGLISH.get(key) == text, f'add "{key}" to the section "task" of every language'


def test_every_sentence_of_the_service_that_is_translated_is_still_said() -> None:
    """Who rewords an error rewords it in `said` of every language too, or readers get it in English again."""
    files = (path for folder in ("server", "robot_adapters/franka") for path in (ROOT / folder).rglob("*.py"))
    said = {text for path in files for text in _sentences(ast.parse(path.read_text("utf-8")))}
    gone = {
        key: text
        for key, text in WORDS["said"].items()
        if key not in MADE_OF_PARTS and not text.startswith(PYDANTIC) and re.sub(r"{{\w+}}", "{}", text) not in said
    }
    assert not gone, "the service says these no more: see the section `said` of each language"


def _sentences(tree: ast.AST) -> Iterator[str]:
    """Texts of a file, with {} for what is filled in."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value
        elif isinstance(node, ast.BinOp) and isinstance(node.left, ast.Constant) and isinstance(node.left.value, str):
            yield node.left.value + "{}"
        elif isinstance(node, ast.JoinedStr):
            parts = (part.value if isinstance(part, ast.Constant) else "{}" for part in node.values)
            yield "".join(str(part) for part in parts)
