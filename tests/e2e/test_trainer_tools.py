"""What a trainer and an operator have around the judging: what is drawn, the past, slow motion, reports, incidents."""

from __future__ import annotations

from playwright.sync_api import Page, expect

from tests.e2e.test_pages import PHONE, accessible, fits, tab_to
from tests.e2e.trainer import START_MS, Opener, TrainerPage
from tests.live import LiveService, wait_for

WATCHED = {"adapter_settings": {"step_seconds": 0.15}}
"""Slow enough to be filmed by both cameras, also where a page takes its pictures late."""


def boxes(*parts: str) -> str:
    """A script that tells where these parts of a view are, all at one moment."""
    return f"view => {list(parts)}.map(part => view.querySelector(part).getBoundingClientRect().toJSON())"


GHOST = boxes("[data-testid=ghost]", "[data-testid=dot]")
BOXES = boxes("[data-testid=dot]", "canvas")


def approve_the_first_good(trainer: TrainerPage) -> int:
    """Reject until something good is proposed, approve that, and wait for its end; its id."""
    proposal = trainer.drawn()
    while trainer.stored(proposal)["predicted_feedback"] < 0:
        trainer.press(-1)
        proposal = trainer.drawn(proposal)
    trainer.press(1)
    expect(trainer.test_id("last-motion")).to_be_visible(timeout=START_MS)
    return proposal


def test_what_is_drawn_can_be_chosen_and_is_remembered(page: Page, opener: Opener) -> None:
    trainer = opener(preset="stubborn")
    first = trainer.drawn()
    left = trainer.test_id("view-left")
    for name, key in (("ghost", "g"), ("workspace", "w")):
        expect(left.get_by_test_id(name)).to_have_count(0)
        page.keyboard.press(key)
        expect(left.get_by_test_id(name)).to_have_count(1)
    # the ghost is the stored one, at the dot
    box, dot = left.evaluate(GHOST)  # at one moment: the page paints between two questions
    assert box["x"] < dot["x"] < box["x"] + box["width"]
    left.get_by_test_id("dot").focus()
    expect(left.get_by_test_id("explained")).to_have_text("Where the skill acts")
    before = left.evaluate(GHOST)[1]["width"]
    trainer.test_id("nearer-left").click()
    wait_for(lambda: left.evaluate(GHOST)[1]["width"] > 1.3 * before, "the overlay to be zoomed with its picture")

    page.keyboard.press("e")
    expect(trainer.test_id("predicted-feedback")).to_have_count(0)
    trainer.press(-1)
    second = trainer.drawn(first)
    page.keyboard.press("e")
    trainer.press(-1)
    trainer.drawn(second)
    rows = trainer.service.rows("SELECT estimate_shown FROM feedback ORDER BY id DESC LIMIT 2")
    assert [row["estimate_shown"] for row in rows] == [1, 0]
    page.reload()
    expect(left.get_by_test_id("ghost")).to_have_count(1)


def test_what_it_would_do_instead_is_drawn_for_whoever_points_at_it(page: Page, opener: Opener) -> None:
    trainer = opener(algorithm="seed", settings={"hidden_size": 16, "batch_size": 16})
    proposal = trainer.stored(trainer.drawn())
    other = next(skill for skill in proposal["skill_probabilities"] if skill != proposal["skill"])
    faint = page.get_by_test_id("considered-overlay")
    expect(faint).to_have_count(0)
    page.locator(f"[data-testid=choice][data-skill={other}]").hover()
    expect(trainer.test_id("considered")).to_contain_text("x 0.")
    expect(faint).to_have_count(2)  # one for each camera
    accessible(page)
    page.mouse.move(0, 0)
    expect(faint).to_have_count(0)
    tab_to(page, f"[data-testid=choice][data-skill={other}]")
    expect(faint).to_have_count(2)
    trainer.press(-1)
    trainer.drawn(proposal["id"])
    expect(faint).to_have_count(0)
    assert trainer.counters()["feedback"] == 1


def test_wheel_pinch_and_drag_move_a_picture_and_its_overlay_as_one(page: Page, opener: Opener) -> None:
    trainer = opener(preset="stubborn")
    trainer.drawn()
    view = trainer.test_id("view-left")

    def place() -> tuple[float, float, float]:
        """Where the dot's middle is on its picture, as shares of it, and how wide that picture is."""
        dot, picture = view.evaluate(BOXES)  # at one moment: the page paints between two questions
        x = (dot["x"] + dot["width"] / 2 - picture["x"]) / picture["width"]
        y = (dot["y"] + dot["height"] / 2 - picture["y"]) / picture["height"]
        return round(x, 3), round(y, 3), picture["width"]

    x, y, whole = place()
    box = view.bounding_box()
    assert box is not None
    middle = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.move(*middle)
    page.mouse.wheel(0, -300)
    assert place()[2] == whole, "without Ctrl the wheel scrolls the page"
    page.keyboard.down("Control")
    page.mouse.wheel(0, -300)
    page.keyboard.up("Control")
    expect(view).to_have_attribute("data-zoomed", "true")
    wait_for(lambda: place()[2] > 1.5 * whole, "the picture to follow the wheel")
    assert place()[:2] == (x, y)
    before = view.evaluate(BOXES)[1]
    page.mouse.down()
    page.mouse.move(middle[0] + 60, middle[1] + 30, steps=4)
    page.mouse.up()
    wait_for(lambda: view.evaluate(BOXES)[1]["x"] - before["x"] > 40, "the picture to follow the pointer")
    assert place()[:2] == (x, y)
    page.keyboard.press("Escape")
    view.get_by_role("button", name="Show all of the left picture").click()
    pinch(page, middle, 40, 120)
    wait_for(lambda: place()[2] > 1.5 * whole, "the picture to follow the fingers")
    assert place()[:2] == (x, y)
    assert trainer.counters()["feedback"] == 0, "none of it judges"


def pinch(page: Page, middle: tuple[float, float], apart: float, at_last: float) -> None:
    """Two fingers that move apart, as the browser's own input sends them."""
    session = page.context.new_cdp_session(page)
    for kind, half in (("touchStart", apart), ("touchMove", (apart + at_last) / 2), ("touchMove", at_last)):
        fingers = [{"x": middle[0] + side * half, "y": middle[1], "id": side + 1} for side in (-1, 1)]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": fingers})
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    session.detach()


HEARD = """
window.heard = {tones: 0, taps: 0};
const start = OscillatorNode.prototype.start;
OscillatorNode.prototype.start = function (...given) { window.heard.tones += 1; return start.apply(this, given); };
navigator.vibrate = () => { window.heard.taps += 1; return true; };
window.later = 0;
const now = Date.now;
Date.now = () => now() + window.later;
localStorage.setItem('seed.judging', '{"sound": true, "haptic": true, "restAfter": 10, "toured": true}');
"""


def test_the_next_proposal_is_heard_and_a_rest_is_proposed_in_time(page: Page, opener: Opener) -> None:
    page.add_init_script(HEARD)
    trainer = opener(preset="stubborn")
    proposal = trainer.drawn()
    rest = trainer.notices.get_by_text("10 minutes")
    for _ in range(5):
        expect(rest).to_have_count(0)
        trainer.press(-1)
        proposal = trainer.drawn(proposal)
        page.evaluate("window.later += 121000")  # a click every two minutes
    trainer.press(-1)
    trainer.told("10 minutes")
    assert page.evaluate("window.heard.tones") >= 5
    assert page.evaluate("window.heard.taps") >= 5
    expect(trainer.test_id("pace-rate")).to_contain_text("0.")
    expect(trainer.test_id("pace-streak")).to_have_text("6")


def test_the_third_view_is_drawn_from_the_state(page: Page, opener: Opener) -> None:
    trainer = opener(preset="stubborn")
    trainer.drawn()
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    page.keyboard.press("d")
    scene = trainer.test_id("scene")
    expect(scene).to_have_attribute("data-ready", "true", timeout=START_MS)
    assert any("scene" in url for url in asked), "three.js comes only when it is asked for"
    assert "x 0." in (scene.locator("canvas").get_attribute("aria-label") or "")
    scene.get_by_role("button", name="Turn the scene left").click()
    accessible(page)


def test_the_past_is_looked_at_and_corrected(page: Page, opener: Opener) -> None:
    trainer = opener(preset="stubborn")
    proposal = trainer.drawn()
    for value in (-1, 0):
        trainer.press(value)
        proposal = trainer.drawn(proposal)
    past = trainer.test_id("past")
    expect(past).to_have_count(2)
    expect(past.first).to_have_attribute("data-label", "neutral")
    trainer.test_id("filter-bad").click()
    expect(past).to_have_count(1)
    tab_to(page, "[data-testid=past]")  # all of it by keyboard
    page.keyboard.press("Enter")
    accessible(page)
    tab_to(page, "[data-testid=relabel-good]")
    page.keyboard.press("Enter")
    expect(page.get_by_role("dialog")).to_have_count(0)
    expect(past).to_have_count(0)
    trainer.test_id("filter-good").click()
    expect(past.first).to_have_attribute("data-label", "good")
    judged = int(past.first.get_attribute("data-id") or 0)
    (feedback,) = trainer.service.get(f"/proposals/{judged}/feedback")["items"]
    assert (feedback["value"], feedback["label"]) == (-1, 1)
    page.reload()
    expect(past).to_have_count(2)


def test_a_motion_is_seen_again_reported_and_kept_where_it_was_stopped(page: Page, opener: Opener) -> None:
    trainer = opener(**WATCHED)
    approve_the_first_good(trainer)
    trainer.test_id("replay").click()
    player = trainer.test_id("player")
    expect(player.locator("img")).to_have_count(2)
    expect(player).not_to_have_attribute("data-time", "0.00")
    accessible(page)
    page.get_by_role("dialog").get_by_role("button", name="Close").click()
    trainer.test_id("report-failed").click()
    expect(trainer.test_id("report-failed")).to_have_attribute("aria-pressed", "true")
    (execution, *_) = trainer.service.get(f"{trainer.path}/executions")["items"]
    assert [report["outcome"] for report in execution["reports"]] == ["failed"]

    trainer.test_id("operator").locator("summary").click()
    expect(trainer.test_id("gripper-at")).to_contain_text("cm")
    expect(trainer.test_id("camera-calibration")).to_contain_text("exact")
    trainer.test_id("report-damage").click()
    trainer.test_id("stop-confirm").click()
    expect(trainer.test_id("halted")).to_be_visible()
    trainer.test_id("incident").first.click()
    expect(trainer.test_id("player").locator("img").first).to_be_visible()
    page.get_by_role("dialog").get_by_role("button", name="Close").click()
    trainer.test_id("rearm").click()
    trainer.test_id("rearm-confirm").click()
    trainer.test_id("reset").click()
    expect(page.get_by_role("dialog")).to_contain_text("simulator")
    trainer.test_id("reset-confirm").click()
    expect(page.get_by_role("dialog")).to_have_count(0)


def test_a_phone_judges_by_strokes(page: Page, opener: Opener) -> None:
    page.set_viewport_size({"width": PHONE["width"], "height": PHONE["height"]})
    trainer = opener(preset="stubborn")
    proposal = trainer.drawn()
    judged = []
    for across, up in ((-120, 0), (0, -120), (-120, 0)):
        trainer.looked_at()
        stroke(page, across, up)
        judged.append(proposal)
        proposal = trainer.drawn(proposal)
    values = [trainer.service.get(f"/proposals/{each}/feedback")["items"][0]["value"] for each in judged]
    assert values == [-1, 0, -1]
    trainer.test_id("undo").click()
    trainer.page.wait_for_function(
        "last => document.querySelector('[data-testid=views]').dataset.proposalId === last", arg=str(judged[-1])
    )
    stroke(page, 30, 10)  # a slip of the finger means nothing
    fits(page)
    assert trainer.counters()["feedback"] == 2

    # zoomed, a finger moves the picture, downwards too, and neither the page nor a judgement
    for _ in range(2):
        trainer.test_id("nearer-left").click()
    page.evaluate("scrollTo(0, 40)")
    view = trainer.test_id("view-left")
    before = view.evaluate(BOXES)[1]["y"]
    stroke(page, 0, 90)
    wait_for(lambda: view.evaluate(BOXES)[1]["y"] - before > 40, "the picture to follow the finger downwards")
    assert page.evaluate("scrollY") == 40
    view.get_by_role("button", name="Show all of the left picture").click()
    assert trainer.counters()["feedback"] == 2


STANDS = """() => new Promise(done => {
    let [last, frames] = [-1, 0];
    const look = () => {
        frames = scrollY === last ? frames + 1 : 0;
        last = scrollY;
        if (frames === 10) done(); else requestAnimationFrame(look);
    };
    look();
})"""
"""Waits until the page has come to rest: it goes on for a while when a finger that moves is lifted."""


def test_a_phone_held_crosswise_judges_by_strokes_to_the_sides_and_scrolls_by_others(
    page: Page, opener: Opener
) -> None:
    page.set_viewport_size({"width": PHONE["height"], "height": PHONE["width"]})
    trainer = opener(preset="stubborn")
    proposal = trainer.drawn()
    trainer.looked_at()
    stroke(page, 0, -100)  # to the buttons, which are below the views here
    wait_for(lambda: page.evaluate("scrollY") > 40, "the page to follow the finger")
    page.evaluate(STANDS)
    page.evaluate("scrollTo(0, 0)")
    stroke(page, -120, 0)
    trainer.drawn(proposal)
    (feedback,) = trainer.service.get(f"/proposals/{proposal}/feedback")["items"]
    assert feedback["value"] == -1
    assert trainer.counters()["feedback"] == 1


def stroke(page: Page, across: float, up: float) -> None:
    """A finger on the left view, as the browser's own input sends it."""
    box = page.get_by_test_id("view-left").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    session = page.context.new_cdp_session(page)
    session.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [{"x": x, "y": y}]})
    for part in (0.3, 0.6, 1.0):
        point = {"x": x + part * across, "y": y + part * up}
        session.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": [point]})
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    session.detach()


def test_the_tour_explains_every_part_by_keyboard_and_leaves_stop_free(
    page: Page, opener: Opener, service: LiveService
) -> None:
    trainer = opener(preset="stubborn")
    trainer.drawn()
    expect(trainer.test_id("tour-offer")).to_be_visible()
    trainer.looked_at()
    page.keyboard.press("?")
    card = trainer.test_id("tour-card")
    seen: list[str] = []
    for _ in range(10):
        if seen:
            expect(card).not_to_have_attribute("data-step", seen[-1])
        seen.append(card.get_attribute("data-step") or "")
        if len(seen) == 2:
            accessible(page)
        page.keyboard.press("1")  # judges nothing as long as the tour is open
        page.keyboard.press("Enter")
    assert len(set(seen)) == 10
    expect(card).to_have_count(0)
    expect(trainer.test_id("tour-offer")).to_have_count(0)
    assert trainer.counters()["feedback"] == 0
    page.keyboard.press("?")
    expect(card).to_be_visible()
    trainer.escape_twice()
    assert service.get(trainer.path)["halted"] is True
