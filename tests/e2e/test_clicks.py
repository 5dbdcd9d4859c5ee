"""A click is never lost, doubled or given to another proposal, whatever the network does; and it can be taken back."""

from __future__ import annotations

from playwright.sync_api import Page, expect

from tests.e2e.trainer import ONE_KEPT, START_MS, Opener, TrainerPage
from tests.live import LiveService

BAD_ONLY = {"preset": "stubborn"}


def clicks(trainer: TrainerPage) -> list[tuple[int, int, str]]:
    """(proposal, value, status) of every stored click of the experiment."""
    query = "SELECT proposal_id, value, status FROM feedback WHERE experiment_id = ? ORDER BY id"
    return [tuple(row) for row in trainer.service.rows(query, trainer.experiment)]


def go_offline(trainer: TrainerPage) -> None:
    """Cut the page's network, and wait until it has noticed."""
    trainer.page.context.set_offline(True)
    trainer.disconnected()


def go_online(trainer: TrainerPage) -> None:
    """Give the network back, and wait until the page is in step again."""
    trainer.page.context.set_offline(False)
    trainer.connected()


def test_an_offline_click_is_kept_and_sent_once(opener: Opener) -> None:
    trainer = opener(**BAD_ONLY)
    proposal = trainer.drawn()
    go_offline(trainer)
    trainer.press(-1)
    trainer.press_anyway(1)  # judged already: a second press is no second click
    expect(trainer.connection).to_contain_text(ONE_KEPT)
    assert clicks(trainer) == []
    go_online(trainer)
    trainer.drawn(proposal)
    assert clicks(trainer) == [(proposal, -1, "stored")]


def test_a_kept_click_waits_for_who_clicked_whoever_sits_there_meanwhile(opener: Opener) -> None:
    trainer = opener(**BAD_ONLY)
    proposal = trainer.drawn()
    trainer.service.kill()
    trainer.disconnected()
    trainer.press(0)
    expect(trainer.connection).to_contain_text(ONE_KEPT)
    trainer.service.start()
    for name in ("bob", "local"):
        trainer.page.evaluate("name => localStorage.setItem('seed.trainer', name)", name)
        trainer.page.reload()
        trainer.connected()
        expect(trainer.connection).not_to_contain_text(ONE_KEPT)
    # The restart had closed the proposal: the click is stored, and the page says that it came late.
    trainer.told("came too late")
    assert clicks(trainer) == [(proposal, 0, "late")]
    (stored,) = trainer.service.get(f"/proposals/{proposal}/feedback")["items"]
    assert stored["trainer"] == "local"


def test_a_click_that_came_too_late_says_so_and_decides_nothing(opener: Opener, service: LiveService) -> None:
    trainer = opener(**BAD_ONLY)
    proposal = trainer.drawn()
    go_offline(trainer)
    trainer.press(1)
    service.post(f"/proposals/{proposal}/feedback", {"click_id": "somebody-else-1", "value": -1, "trainer": "other"})
    go_online(trainer)
    trainer.told("came too late")
    assert clicks(trainer) == [(proposal, -1, "stored"), (proposal, 1, "late")]
    assert trainer.stored(proposal)["verdict"] == "bad"
    assert trainer.counters()["executions"] == 0


def test_undo_opens_the_judged_proposal_again(opener: Opener, service: LiveService) -> None:
    trainer = opener(**BAD_ONLY)
    first = trainer.drawn()
    trainer.press(-1)
    second = trainer.drawn(first)
    trainer.test_id("undo").click()
    expect(trainer.views).to_have_attribute("data-proposal-id", str(first))
    assert trainer.stored(second)["close_reason"] == "withdrawn"
    trainer.press(0)
    third = trainer.drawn(second)
    trainer.page.keyboard.press("u")
    expect(trainer.views).to_have_attribute("data-proposal-id", str(first))
    query = "SELECT value, undone_at IS NOT NULL FROM feedback WHERE experiment_id = ? ORDER BY id"
    assert [tuple(row) for row in service.rows(query, trainer.experiment)] == [(-1, 1), (0, 1)]
    assert trainer.stored(third)["close_reason"] == "withdrawn"
    trainer.shows_feedback(0)


def test_nothing_moves_while_the_mode_is_propose_only(opener: Opener) -> None:
    trainer = opener(mode="propose_only")
    proposal = trainer.drawn()
    trainer.press(1)
    trainer.drawn(proposal)
    assert trainer.counters()["executions"] == 0
    # Switched while it runs, and only after a question.
    trainer.test_id("mode-execute_approved").click()
    trainer.test_id("mode-confirm").click()
    expect(trainer.test_id("mode-execute_approved")).to_have_attribute("aria-pressed", "true")
    proposal = trainer.drawn(proposal)
    trainer.press(1)
    trainer.drawn(proposal)
    assert trainer.counters()["executions"] == 1


def test_a_held_key_judges_one_proposal(opener: Opener) -> None:
    trainer = opener(**BAD_ONLY)
    first = trainer.drawn()
    trainer.looked_at()
    trainer.page.keyboard.down("3")
    second = trainer.drawn(first)
    for _ in range(10):
        trainer.page.keyboard.down("3")  # a key that is down already repeats
    trainer.page.keyboard.up("3")
    trainer.page.evaluate("() => new Promise(requestAnimationFrame)")
    assert trainer.drawn() == second
    assert clicks(trainer) == [(first, -1, "stored")]


PRESS_WHEN_DRAWN = """name => new Promise(done => {
    const views = document.querySelector('[data-testid=views]');
    const button = document.querySelector(`[data-testid=${name}]`);
    const first = views.dataset.proposalId;
    new MutationObserver((_, observer) => {
        if (!views.dataset.proposalId || views.dataset.proposalId === first) return;
        observer.disconnect();
        button.click();
        const look = () => {
            const said = document.querySelector('[data-testid=judge-hint]').textContent;
            if (said) done(said);
            else requestAnimationFrame(look);
        };
        look();
    }).observe(views, {attributes: true});
    button.click();
})"""
"""A double click whose second press hits the next proposal in the moment that it is drawn; what is said of that."""


def test_a_double_click_judges_one_proposal_and_says_so(opener: Opener) -> None:
    trainer = opener(**BAD_ONLY)
    first = trainer.drawn()
    trainer.looked_at()
    assert "Too fast, not counted" in trainer.page.evaluate(PRESS_WHEN_DRAWN, "bad")
    second = trainer.drawn(first)
    assert clicks(trainer) == [(first, -1, "stored")]
    trainer.click(-1)  # one that was looked at counts, and takes the hint away
    expect(trainer.test_id("judge-hint")).to_be_empty()
    trainer.drawn(second)
    assert clicks(trainer) == [(first, -1, "stored"), (second, -1, "stored")]


def test_a_pause_during_a_motion_says_that_it_still_moves(opener: Opener, service: LiveService) -> None:
    trainer = opener(mode="execute_approved", adapter_settings={"step_seconds": 0.5})
    trainer.drawn()
    trainer.press(1)
    expect(trainer.activity).to_contain_text("Executing")
    trainer.test_id("pause").click()
    expect(trainer.test_id("lifecycle")).to_have_text("paused")
    expect(trainer.activity).to_contain_text("Finishing pick, then paused")
    expect(trainer.activity).to_have_attribute("data-tone", "moving")
    expect(trainer.activity).to_contain_text("Nothing moves", timeout=START_MS)
    (execution,) = service.rows("SELECT outcome FROM execution WHERE experiment_id = ?", trainer.experiment)
    assert execution["outcome"] == "succeeded"


def test_undo_ends_with_a_pause(opener: Opener) -> None:
    trainer = opener(**BAD_ONLY)
    first = trainer.drawn()
    trainer.press(-1)
    trainer.drawn(first)
    expect(trainer.test_id("undo")).to_be_enabled()
    trainer.test_id("pause").click()
    expect(trainer.test_id("lifecycle")).to_have_text("paused")
    expect(trainer.test_id("undo")).to_be_disabled()


def test_two_pages_of_one_experiment_agree(opener: Opener, page: Page, service: LiveService) -> None:
    mine = opener(**BAD_ONLY)
    other = TrainerPage(page.context.new_page(), service, mine.experiment).open()
    proposal = other.drawn()
    assert mine.drawn() == proposal
    mine.page.bring_to_front()
    mine.press(-1)
    following = mine.drawn(proposal)
    other.page.bring_to_front()
    assert other.drawn(proposal) == following
    other.shows_feedback(1)
