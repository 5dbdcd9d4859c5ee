"""Two robots on one page: the second's proposal is judged while the first moves, and either can be watched."""

from __future__ import annotations

from playwright.sync_api import expect

from tests.e2e.trainer import START_MS, Opener
from tests.live import wait_for

SLOW = {"step_seconds": 0.5}
"""A skill takes some ten seconds: time to judge, and to look at, the other robot."""


def test_one_robot_is_judged_while_the_other_moves(opener: Opener) -> None:
    trainer = opener(num_envs=2, adapter_settings=SLOW)
    queue = trainer.test_id("queue")
    expect(queue).to_have_text("Robot 1 of 22 proposals wait", timeout=START_MS)
    first = trainer.drawn()
    assert trainer.stored(first)["robot"] == 0
    trainer.press(1)

    # the other one's proposal is next, on its own pictures, and no video of the first covers it
    second = trainer.drawn(first)
    expect(queue).to_contain_text("Robot 2 of 2")
    expect(trainer.test_id("robot-1")).to_have_attribute("data-doing", "moving", timeout=START_MS)
    expect(trainer.test_id("view-left")).to_have_attribute("data-live", "false")
    expect(trainer.activity).to_contain_text("Waiting for you")
    assert trainer.stored(second)["robot"] == 1

    # whoever wants to see the first one move can, and is back at once
    trainer.test_id("robot-1").click()
    expect(trainer.activity).to_contain_text("Executing pick")
    expect(trainer.test_id("view-left")).to_have_attribute("data-live", "true")
    assert {frame["robot"] for frame in trainer.frames} == {0}
    trainer.press_anyway(-1)  # nothing is offered for judging: it must not land on what waits elsewhere
    trainer.page.get_by_role("button", name="In turn").click()
    expect(trainer.views).to_have_attribute("data-proposal-id", str(second))
    trainer.press(1)
    trainer.shows_feedback(2)

    def executions() -> dict[int, int]:
        rows = trainer.service.get(f"{trainer.path}/executions")["items"]
        return {row["proposal_id"]: row["robot"] for row in rows if row["proposal_id"] in (first, second)}

    wait_for(lambda: len(executions()) == 2, "two motions")
    assert executions() == {first: 0, second: 1}
    clicks = trainer.service.get(f"{trainer.path}/feedback")["items"]
    assert {(click["proposal_id"], click["value"], click["status"]) for click in clicks} == {
        (first, 1, "stored"),
        (second, 1, "stored"),
    }
    expect(queue).to_contain_text("proposal waits", timeout=START_MS)
