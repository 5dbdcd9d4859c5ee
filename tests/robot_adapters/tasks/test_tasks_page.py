"""docs/tasks.md says what the tasks are now, and the odds stay within what a trainer can bear."""

from __future__ import annotations

from pathlib import Path

import pytest

from scripts.odds import odds
from scripts.tasks_page import NAMES, page

PAGE = Path(__file__).parents[3] / "docs" / "tasks.md"


def test_the_page_is_up_to_date() -> None:
    assert PAGE.read_text("utf-8") == page(), "run: python -m scripts.tasks_page > docs/tasks.md"


@pytest.mark.parametrize("name", NAMES)
def test_a_uniform_proposal_is_good_at_least_once_in_1400(name: str) -> None:
    assert all(100 <= 1 / share <= 1400 for _, share in odds(name))
