"""Two and five people, each in a browser context of their own, judge the proposals of one robot."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, BrowserContext, expect

from tests.e2e.trainer import BUTTONS, ONE_KEPT, START_MS, TrainerPage
from tests.live import LiveService, wait_for

NAMES = ("ann", "bob", "cyd", "dan", "eve")
ENDLESS = {"step_seconds": 1.0}
"""A skill takes some twenty seconds, unless somebody stops it."""
SMALL = {"hidden_size": 16, "batch_size": 16}

Gather = Callable[..., list[TrainerPage]]
"""Pages of the first so many people on a new experiment (fields as in ExperimentCreate), which starts once all sit."""


@pytest.fixture(scope="module")
def people(browser: Browser, browser_context_args: dict[str, Any]) -> Iterator[list[BrowserContext]]:
    """A browser context each, which knows its person's name."""
    contexts = [browser.new_context(**browser_context_args) for _ in NAMES]
    for context, name in zip(contexts, NAMES, strict=True):
        context.add_init_script(f"localStorage.setItem('seed.trainer', '{name}')")
    yield contexts
    for context in contexts:
        context.close()


@pytest.fixture
def gather(people: list[BrowserContext], service: LiveService) -> Iterator[Gather]:
    """Leaving closes the pages and finishes the experiment."""
    opened: list[TrainerPage] = []

    def pages(count: int, **fields: Any) -> list[TrainerPage]:
        experiment = service.experiment(**{"adapter": "kinematic", **fields})
        team = [TrainerPage(context.new_page(), service, experiment) for context in people[:count]]
        opened.extend(team)
        for each in team:
            each.open()
        for each in team:
            expect(each.test_id("judges").locator("tbody tr")).to_have_count(count)
        service.post(f"/experiments/{experiment}/start")
        return team

    yield pages
    for each in opened:
        each.page.context.set_offline(False)
        each.page.close()
    if opened:
        with contextlib.suppress(AssertionError):  # the test has ended it
            service.post(f"/experiments/{opened[0].experiment}/finish")


def same(team: list[TrainerPage], after: int | None = None) -> int:
    """The proposal that all of them have before them."""
    (proposal,) = {each.drawn(after) for each in team}
    return proposal


def at_once(*clicks: tuple[TrainerPage, str, int]) -> None:
    """Have each page click its control (a test id) at the same moment, or so many ms later, by this machine's clock."""
    moment = clicks[0][0].page.evaluate("() => Date.now() + 300")
    script = """([id, moment]) => {
      window.offered = new Promise(tell => setTimeout(() => {
        const control = document.querySelector(`[data-testid=${id}]`);
        tell(control !== null && control.getAttribute('aria-disabled') !== 'true');
        control?.click();
      }, moment - Date.now()));
    }"""
    for page, control, later in clicks:
        page.page.evaluate(script, [control, moment + later])


def offered(page: TrainerPage) -> bool:
    """Whether what it clicked `at_once` was on offer then: a page that is late may have heard of the other's first."""
    return bool(page.page.evaluate("() => window.offered"))


def executions(team: list[TrainerPage]) -> list[dict[str, Any]]:
    """The experiment's motions as the service knows them, oldest first."""
    found: list[dict[str, Any]] = team[0].service.get(f"{team[0].path}/executions")["items"]
    return found[::-1]


def test_a_majority_of_five_decides_and_nobody_sees_what_the_others_said(gather: Gather, service: LiveService) -> None:
    team = gather(5, aggregation="majority", adapter_settings=ENDLESS)
    ann, bob, cyd, dan, eve = team
    proposal = same(team)
    for heard, (who, value) in enumerate([(ann, -1), (bob, 1), (cyd, 1)], 1):
        who.press(value)
        for each in team:
            expect(each.test_id("votes")).to_contain_text(f"{heard} of 5 votes are in.")
    expect(ann.test_id("votes")).to_contain_text("Waiting for dan and eve.")
    expect(eve.test_id("votes")).to_contain_text("3 alike decide.")
    # not even by the list of clicks
    assert service.get(f"/proposals/{proposal}/feedback")["items"] == []
    assert executions(team) == []

    dan.press(1)
    expect(ann.activity).to_contain_text("Executing", timeout=START_MS)
    closed = service.get(f"/proposals/{proposal}")
    assert (closed["verdict"], closed["rule"], closed["heard"]) == ("good", "majority", ["ann", "bob", "cyd", "dan"])
    expect(eve.activity).to_contain_text("Executing", timeout=START_MS)
    eve.press_anyway(-1)  # nothing is asked of her any more
    assert [each["proposal_id"] for each in executions(team)] == [proposal]
    clicks = service.get(f"/proposals/{proposal}/feedback")["items"]
    assert sorted((each["trainer"], each["value"]) for each in clicks) == [
        ("ann", -1),
        ("bob", 1),
        ("cyd", 1),
        ("dan", 1),
    ]


def test_one_bad_vetoes_where_all_have_to_agree(gather: Gather, service: LiveService) -> None:
    team = gather(2, aggregation="unanimous")
    ann, bob = team
    first = same(team)
    ann.press(1)
    expect(bob.test_id("votes")).to_contain_text("1 of 2 votes are in. All have to say good; one bad decides.")
    bob.press(-1)
    second = same(team, first)
    assert service.get(f"/proposals/{first}")["verdict"] == "bad"
    assert executions(team) == []
    ann.press(1)
    bob.press(1)
    wait_for(lambda: executions(team), "what both have approved")
    assert [each["proposal_id"] for each in executions(team)] == [second]


def test_in_parallel_each_of_five_has_another_until_one_is_approved(gather: Gather, service: LiveService) -> None:
    team = gather(5, algorithm="seed", settings=SMALL, together={"parallel": True}, adapter_settings=ENDLESS)
    ann, bob, *others = team

    def mine() -> dict[str, int] | None:
        found = {name: each.drawn() for name, each in zip(NAMES, team, strict=True)}
        return found if len(set(found.values())) == len(team) else None

    first = wait_for(mine, "a proposal of their own for each", START_MS / 1000)
    expect(ann.test_id("votes")).to_contain_text("This one is yours; 4 other trainers judge others.")
    ann.press(-1)
    ann.drawn(max(first.values()))
    assert [each.drawn() for each in team[1:]] == [first[name] for name in NAMES[1:]]

    bob.press(1)
    expect(bob.activity).to_contain_text("Executing", timeout=START_MS)
    for each, name in zip(others, NAMES[2:], strict=True):
        each.told("bob approved another one first")
        expect(each.activity).to_contain_text("it still trains")
        assert each.drawn() == first[name]  # the pictures stay
    cyd = others[0]
    cyd.press(1)
    cyd.told("Kept, and it trains. The robot is already moving for another proposal.")
    expect(cyd.activity).to_contain_text("Executing")
    (label,) = service.get(f"/proposals/{first['cyd']}/feedback")["items"]
    assert (label["trainer"], label["value"], label["status"]) == ("cyd", 1, "overtaken")
    assert [each["proposal_id"] for each in executions(team)] == [first["bob"]]
    for name in NAMES[2:]:
        closed = service.get(f"/proposals/{first[name]}")
        assert (closed["close_reason"], closed["superseded_by"]) == ("superseded", first["bob"])


def test_the_robots_of_an_experiment_are_one_queue_for_whoever_is_there(gather: Gather) -> None:
    team = gather(2, num_envs=2, together={"parallel": True}, adapter_settings=ENDLESS)
    ann, bob = team

    def each_at_another() -> tuple[int, int] | None:
        hers, his = ann.drawn(), bob.drawn()
        return (hers, his) if hers != his else None

    hers, his = wait_for(each_at_another, "a robot's proposal each", START_MS / 1000)
    assert {ann.stored(hers)["robot"], ann.stored(his)["robot"]} == {0, 1}
    ann.press(1)
    expect(ann.activity).to_contain_text("Executing", timeout=START_MS)
    # the other robot's is judged meanwhile, and the queue goes on
    assert bob.drawn() == his
    bob.press(-1)
    bob.drawn(max(hers, his))
    assert executions(team)[0]["proposal_id"] == hers
    assert bob.stored(his)["verdict"] == "bad"


@pytest.mark.parametrize("later", [0, 60])  # so that either may be first, as a rule
def test_taking_back_races_with_the_approval_that_needs_it_and_both_see_one_story(gather: Gather, later: int) -> None:
    team = gather(2, aggregation="majority", adapter_settings=ENDLESS)
    ann, bob = team
    proposal = same(team)
    ann.press(1)
    expect(bob.test_id("votes")).to_contain_text("1 of 2 votes are in.")
    expect(ann.test_id("undo")).to_be_enabled()
    bob.looked_at()
    at_once((ann, "undo", later), (bob, BUTTONS[1], 0))

    def story() -> str | None:
        now = bob.stored(proposal)
        return "moves" if executions(team) else "waits" if now["heard"] == ["bob"] else None

    if wait_for(story, "one or the other") == "moves":
        assert bob.stored(proposal)["heard"] == ["ann", "bob"]
        for each in team:
            expect(each.activity).to_contain_text("Executing", timeout=START_MS)
    else:
        assert bob.stored(proposal)["closed_at"] is None
        assert same(team) == proposal
        for each in team:
            expect(each.test_id("votes")).to_contain_text("1 of 2 votes are in.")
        ann.press(1)
        wait_for(lambda: executions(team), "what both have approved")
    assert [each["proposal_id"] for each in executions(team)] == [proposal]


def test_whoever_halts_while_another_approves_stops_the_robot(gather: Gather) -> None:
    team = gather(2, adapter_settings=ENDLESS)
    ann, bob = team
    proposal = same(team)
    ann.looked_at()
    at_once((ann, BUTTONS[1], 0), (bob, "halt", 0))
    for each in team:
        expect(each.test_id("halted")).to_be_visible()
    wanted = [("ann", 1)] if offered(ann) else []

    def clicks() -> list[tuple[str, int]]:
        items = ann.service.get(f"/proposals/{proposal}/feedback")["items"]
        return [(each["trainer"], each["value"]) for each in items]

    wait_for(lambda: clicks() == wanted, f"the clicks to be {wanted}")

    def stands() -> bool:
        return all(each["outcome"] is not None for each in executions(team))

    wait_for(stands, "the robot to stand")
    assert [(each["proposal_id"], each["outcome"]) for each in executions(team)] in (
        [],
        [(proposal, "stopped")],
    )
    assert clicks() == wanted
    assert ann.service.get(ann.path)["halted"] is True


def test_who_was_offline_is_not_waited_for_and_comes_back_to_what_is_open(gather: Gather) -> None:
    team = gather(2, aggregation="unanimous", together={"vanish_seconds": 0}, preset="stubborn")
    ann, bob = team
    first = same(team)
    bob.page.context.set_offline(True)
    bob.disconnected()

    def pages() -> int:
        return sum(each["streams"] for each in ann.service.get(f"{ann.path}/people")["items"])

    wait_for(lambda: pages() == 1, "the service to notice", START_MS / 1000)
    bob.press(1)
    expect(bob.connection).to_contain_text(ONE_KEPT)
    ann.press(-1)
    second = ann.drawn(first)
    bob.page.context.set_offline(False)
    bob.connected()
    bob.told("came too late")
    assert bob.drawn(first) == second
    # it opened for whoever was there
    expect(bob.test_id("votes")).to_contain_text(
        "You came after it opened, or were away: the next one is yours to judge."
    )
    ann.press(-1)
    third = same(team, second)
    assert ann.stored(third)["electorate"] == ["ann", "bob"]
    rows = ann.service.rows(
        "SELECT proposal_id, value, status FROM feedback WHERE experiment_id = ? ORDER BY id", ann.experiment
    )
    assert [tuple(row) for row in rows] == [(first, -1, "stored"), (first, 1, "late"), (second, -1, "stored")]
