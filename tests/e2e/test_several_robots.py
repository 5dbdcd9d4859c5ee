"""Two robots on one page: the second's proposal is judged while the first moves, and either can be watched."""

from __future__ import annotations

from playwright.sync_api import Page, expect

from tests.e2e.test_pages import PHONE, fits
from tests.e2e.trainer import START_MS, Opener
from tests.live import wait_for

SLOW = {"step_seconds": 1.0}
"""A skill takes some twenty seconds: time to judge, and to look at, the other robot."""


def test_one_robot_is_judged_while_the_other_moves(opener: Opener) -> None:
    trainer = opener(num_envs=2, adapter_settings=SLOW)
    queue = trainer.test_id("queue")
    expect(queue).to_contain_text("2 proposals wait", timeout=START_MS)
    first = trainer.drawn()
    robot = trainer.stored(first)["robot"]
    mover, other = (trainer.test_id(f"robot-{index + 1}") for index in (robot, 1 - robot))
    expect(queue).to_contain_text(f"Robot {robot + 1} of 2")
    trainer.press(1)

    # the other one's proposal is next, on its own pictures, and no video of the first covers it
    second = trainer.drawn(first)
    assert trainer.stored(second)["robot"] == 1 - robot
    expect(queue).to_contain_text(f"Robot {2 - robot} of 2")
    expect(mover).to_have_attribute("data-doing", "moving", timeout=START_MS)
    expect(other).to_have_attribute("data-doing", "waiting")
    expect(trainer.test_id("view-left")).to_have_attribute("data-live", "false")
    expect(trainer.activity).to_contain_text("Waiting for you")
    trainer.shows_feedback(1)

    # whoever wants to see the first one move can, and is back at once
    mover.click()
    expect(trainer.activity).to_contain_text("Executing pick")
    expect(trainer.test_id("view-left")).to_have_attribute("data-live", "true")
    trainer.page.wait_for_function("() => document.querySelector('canvas.live').width === 640")  # a picture is drawn
    assert {frame["robot"] for frame in trainer.frames} == {robot}
    trainer.press_anyway(-1)  # nothing is offered for judging: it must not land on what waits elsewhere
    trainer.page.get_by_role("button", name="In turn").click()
    expect(trainer.views).to_have_attribute("data-proposal-id", str(second))
    trainer.press(1)
    trainer.shows_feedback(2)

    def executions() -> dict[int, int]:
        rows = trainer.service.get(f"{trainer.path}/executions")["items"]
        return {row["proposal_id"]: row["robot"] for row in rows if row["proposal_id"] in (first, second)}

    wait_for(lambda: len(executions()) == 2, "two motions")
    assert executions() == {first: robot, second: 1 - robot}
    clicks = trainer.service.get(f"{trainer.path}/feedback")["items"]
    assert sorted((click["proposal_id"], click["value"], click["status"]) for click in clicks) == [
        (first, 1, "stored"),
        (second, 1, "stored"),
    ]


def test_sixteen_robots_fit_a_phone(page: Page, opener: Opener) -> None:
    page.set_viewport_size({"width": PHONE["width"], "height": PHONE["height"]})
    trainer = opener(start=False, num_envs=16)
    expect(trainer.test_id("robot-16")).to_be_visible()
    fits(page)
    trainer.test_id("robot-16").click()
    expect(trainer.test_id("queue")).to_contain_text("Robot 16 of 16")
