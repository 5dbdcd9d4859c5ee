"""What a trainer judges by, as the page draws it: the true call of every task over both cameras, against pictures.

The pictures in `overlays/` were looked at before they were committed. One that is missing is written, to be looked at.
They are small and compared by blocks, so that another version of a browser, which smooths edges differently, passes,
and an overlay that is gone or moved by its own width doesn't.
"""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import Page

from tests.e2e.trainer import Opener, TrainerPage

REFERENCES = Path(__file__).parent / "overlays"
SIZE = (160, 120)
BLOCK = 8
"""Pixels of the small picture: about as wide as the gripper's bar."""
MOST = 12.0
"""Of 255: by how much a block's mean may differ."""

TASKS = ("reaching", "stacking", "sweeping", "collecting_toy", "cooking_hotdog")


@pytest.mark.parametrize("task", TASKS)
def test_the_overlay_of_every_task_looks_as_it_was_approved(page: Page, opener: Opener, task: str) -> None:
    page.set_viewport_size({"width": 1440, "height": 900})
    page.emulate_media(color_scheme="dark", reduced_motion="reduce")
    trainer = opener(task=task, seed=7)
    trainer.drawn()
    page.keyboard.press("g")
    page.keyboard.press("w")
    # words depend on the fonts of a machine
    page.add_style_tag(content=".view > :not(.picture) { visibility: hidden } .view { border: 0; border-radius: 0 }")
    trainer.test_id("view-left").get_by_test_id("workspace").wait_for()
    written = []
    for side in ("left", "right"):
        seen = picture(trainer, side)
        reference = REFERENCES / f"{task}-{side}.png"
        if not reference.exists():
            REFERENCES.mkdir(exist_ok=True)
            Image.fromarray(seen).save(reference, optimize=True)
            written.append(reference.name)
            continue
        approved = np.asarray(Image.open(reference).convert("RGB"))
        assert difference(seen, approved) < MOST, f"{reference.name} looks different now: see what has changed"
        page.add_style_tag(content=f"[data-testid=view-{side}] svg {{ visibility: hidden }}")
        bare = picture(trainer, side)
        assert difference(bare, approved) > 2 * MOST, "a picture without its overlay must not pass"
    assert not written, f"{', '.join(written)} were missing and are written: look at them, then commit them"


def picture(trainer: TrainerPage, side: str) -> NDArray[np.uint8]:
    """(120, 160, 3) RGB: a view with what is drawn on it, made small."""
    shot = trainer.test_id(f"view-{side}").screenshot(animations="disabled")
    small = Image.open(io.BytesIO(shot)).convert("RGB").resize(SIZE, Image.Resampling.BOX)
    return np.asarray(small)


def difference(one: NDArray[np.uint8], other: NDArray[np.uint8]) -> float:
    """The largest difference between the means of a block, of 255, over all colours."""
    gap = one.astype(np.float64) - other.astype(np.float64)
    height, width = gap.shape[0] // BLOCK, gap.shape[1] // BLOCK
    blocks = gap.reshape(height, BLOCK, width, BLOCK, 3).mean(axis=(1, 3))
    return float(np.abs(blocks).max())
