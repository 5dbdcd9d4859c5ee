"""The main job on robosuite: judge proposals, see an approved one move, stop it, survive a killed server."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from playwright.sync_api import Page, expect

from tests.e2e.trainer import ONE_KEPT, START_MS, Opener, TrainerPage
from tests.live import LiveService, wait_for

ROBOSUITE = {"adapter": "robosuite", "adapter_settings": {"speed": 1.0}}
"""In real time: fast enough to watch."""
SLOW = {"adapter": "robosuite", "adapter_settings": {"speed": 0.2}}
"""A skill takes some ten seconds and more: it still moves when it is stopped or killed on the way."""

BAD_FIRST = 9


def judge_in_every_way(trainer: TrainerPage) -> list[tuple[int, int]]:
    """Nine judgements by mouse, number and arrow; (proposal, value) each."""
    ways: list[tuple[int, Callable[[], None]]] = [
        (-1, lambda: trainer.click(-1)),
        (-1, lambda: trainer.press(-1)),
        (-1, lambda: trainer.press(-1, arrow=True)),
        (0, lambda: trainer.click(0)),
        (0, lambda: trainer.press(0)),
        (0, lambda: trainer.press(0, arrow=True)),
        (-1, lambda: trainer.press(-1)),
        (-1, lambda: trainer.click(-1)),
        (-1, lambda: trainer.press(-1, arrow=True)),
    ]
    judged = []
    last = 0
    for value, act in ways:
        last = trainer.drawn(last)
        act()
        judged.append((last, value))
    return judged


def test_train_stop_nothing_and_stack(page: Page, service: LiveService) -> None:
    experiment = service.experiment(**ROBOSUITE, settings={"bad_first": BAD_FIRST})
    page.goto(service.url)
    page.get_by_role("link", name="Stack two blocks").first.click()
    trainer = TrainerPage(page, service, experiment)
    page.reload()  # so that the page object hears the stream from its beginning
    trainer.connected()
    trainer.test_id("start").click()
    first = trainer.drawn()

    for side in ("left", "right"):
        view = trainer.test_id(f"view-{side}")
        expect(view.get_by_test_id("dot")).to_have_count(1)
        expect(view.get_by_test_id("line")).to_have_count(1)
        expect(view.get_by_test_id("bar")).to_have_count(1)
        expect(view).to_contain_text(trainer.stored(first)["skill"])

    judged = judge_in_every_way(trainer)
    true_pick = trainer.drawn(judged[-1][0])
    assert trainer.counters()["executions"] == 0
    assert trainer.stored(true_pick)["skill"] == "pick"

    trainer.press(1)
    expect(trainer.activity).to_contain_text("Executing pick", timeout=START_MS)
    true_place = trainer.drawn(true_pick)
    judged.append((true_pick, 1))

    rows = service.rows(
        "SELECT proposal_id, value, status FROM feedback WHERE experiment_id = ? ORDER BY id", experiment
    )
    assert [(r["proposal_id"], r["value"], r["status"]) for r in rows] == [(p, v, "stored") for p, v in judged]
    verdicts = service.rows("SELECT verdict FROM proposal WHERE experiment_id = ? ORDER BY id", experiment)
    words = {-1: "bad", 0: "neutral", 1: "good"}
    assert [r["verdict"] for r in verdicts] == [*(words[v] for _, v in judged), None]
    (execution,) = service.rows("SELECT * FROM execution WHERE experiment_id = ?", experiment)
    assert (execution["proposal_id"], execution["outcome"]) == (true_pick, "succeeded")

    frames = [f for f in trainer.frames if f["execution_id"] == execution["id"]]
    assert {f["camera"] for f in frames} == {"left", "right"}
    stamps = [f["taken_at"] for f in frames if f["camera"] == "left"]
    assert len(set(stamps)) > 1  # a moving picture
    assert stamps == sorted(stamps)

    trainer.shows_feedback(10)
    page.reload()
    trainer.connected()
    assert trainer.drawn() == true_place
    trainer.shows_feedback(10)
    trainer.click(1)
    trainer.told("Task solved")
    expect(trainer.test_id("count-successes")).to_have_text("1")
    service.post(f"{trainer.path}/finish")


def test_a_killed_server_loses_no_click_and_repeats_no_motion(opener: Opener, service: LiveService) -> None:
    trainer = opener(**SLOW)
    first = trainer.drawn()
    trainer.press(-1)
    second = trainer.drawn(first)

    service.kill()
    trainer.disconnected()
    trainer.press(-1)
    expect(trainer.connection).to_contain_text(ONE_KEPT)
    service.start()
    trainer.connected()

    # The proposal was closed when the server came back, so the click is stored and decides nothing.
    trainer.told("came too late")
    expect(trainer.test_id("lifecycle")).to_have_text("paused")
    rows = service.rows(
        "SELECT proposal_id, status FROM feedback WHERE experiment_id = ? ORDER BY id", trainer.experiment
    )
    assert [tuple(r) for r in rows] == [(first, "stored"), (second, "late")]

    trainer.test_id("resume").click()
    pick = trainer.drawn(second)
    trainer.press(1)
    expect(trainer.test_id("view-left")).to_have_attribute("data-live", "true", timeout=START_MS)
    service.kill()
    service.start()
    trainer.connected()
    (cut,) = service.rows("SELECT * FROM execution WHERE experiment_id = ?", trainer.experiment)
    assert (cut["proposal_id"], cut["outcome"]) == (pick, "interrupted")
    trainer.test_id("resume").click()
    trainer.drawn(pick)
    assert len(service.rows("SELECT id FROM execution WHERE experiment_id = ?", trainer.experiment)) == 1


@pytest.mark.parametrize("way", ["button", "keys"])
def test_emergency_stop_halts_a_moving_arm_until_it_is_rearmed(opener: Opener, service: LiveService, way: str) -> None:
    trainer = opener(**SLOW)
    pick = trainer.drawn()
    trainer.press(1)
    expect(trainer.test_id("view-left")).to_have_attribute("data-live", "true", timeout=START_MS)
    if way == "button":
        trainer.test_id("halt").click()
    else:
        trainer.escape_twice()
    expect(trainer.test_id("halted")).to_be_visible()
    ended = wait_for(
        lambda: service.rows("SELECT outcome FROM execution WHERE proposal_id = ? AND ended_at IS NOT NULL", pick),
        "the execution to end",
    )
    assert ended[0]["outcome"] == "stopped"

    # Latched: no reload, no press brings it back; only the operator's explicit word does.
    trainer.page.reload()
    trainer.connected()
    expect(trainer.test_id("halted")).to_be_visible()
    trainer.press_anyway(1)
    trainer.test_id("rearm").click()
    trainer.test_id("cancel").click()
    expect(trainer.test_id("halted")).to_be_visible()
    trainer.test_id("rearm").click()
    trainer.test_id("rearm-confirm").click()
    expect(trainer.test_id("halted")).to_have_count(0)
    trainer.test_id("resume").click()
    trainer.drawn(pick)
    assert trainer.counters()["executions"] == 1
