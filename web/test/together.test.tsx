// Several trainers: what this page shows and offers of many open proposals, and what it tells of the others' votes.
import { act } from "react";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { activity } from "../src/activity";
import { Votes, type VotesProps, votesIn } from "../src/components/Votes";
import { queueOf } from "../src/robots";
import { judgeable } from "../src/selectors";
import { initial, reduce, type TrainerState } from "../src/state";
import type { Experiment, Judge, Proposal, StreamEvent } from "../src/wire";
import { execution, experiment, feedback, proposal, snapshot } from "./messages";
import { byTestId, show } from "./render";

const AT = "2026-01-01T00:00:01Z";
const judge = (trainer: string, proposal_id: number | null, away = false): Judge => ({
  trainer,
  proposal_id,
  until: null,
  here: true,
  finishing: false,
  away,
});
const judges = (...all: Judge[]): StreamEvent => ({ type: "judges_changed", judges: all });
const opened = (each: Proposal): StreamEvent => ({ type: "proposal_opened", proposal: each });
const closed = (each: Proposal, change: Partial<Proposal>): StreamEvent => ({
  type: "proposal_closed",
  proposal: { ...each, closed_at: AT, close_reason: "judged", ...change },
});
const next = (state: TrainerState, ...events: StreamEvent[]): TrainerState =>
  events.reduce((now, event) => reduce(now, { kind: "event", event }), state);

const parallel = experiment({ together: { ...experiment().together, parallel: true } });
const majority = experiment({ aggregation: "majority" });
const hers = proposal(1, { slot: 0, electorate: ["ann", "local"] });
const mine = proposal(2, { slot: 1, electorate: ["ann", "local"] });
const begun = next(
  initial,
  snapshot({
    experiment: parallel,
    proposals: [hers, mine],
    proposal: hers,
    judges: [judge("ann", 1), judge("local", 2)],
  }),
);

describe("two robots", () => {
  const first = experiment({ num_envs: 2 });
  const one = proposal(1, { robot: 0 });
  const said = (...all: Judge[]) => votesIn(one, first, all);

  it("says who else sees the same one, and not of somebody at the other robot that they do", () => {
    expect(said(judge("local", 1), judge("ann", 1), judge("bob", 2))).toMatch(/^1 other trainer sees it too/);
    expect(said(judge("local", 1), judge("ann", 2))).toBe(
      "This one is yours; 1 other trainer judges another one.",
    );
    expect(said(judge("local", 1), judge("ann", null))).toBeNull();
  });
});

describe("each a proposal of their own", () => {
  it("shows the one that is this trainer's, and offers no other", () => {
    expect(begun.proposal?.id).toBe(2);
    expect([judgeable(begun, 2), judgeable(begun, 1)]).toEqual([true, false]);
    expect(queueOf(begun.robots, begun.judged).map(({ id }) => id)).toEqual([2]);
  });

  it("never lets another's flash by between one's own two", () => {
    const third = proposal(3, { slot: 1 });
    const judged = next(begun, closed(mine, { verdict: "bad" }));
    expect(judged.proposal?.id).toBe(2);
    const drawn = next(judged, opened(third));
    expect([drawn.proposal?.id, judgeable(drawn, 3)]).toEqual([2, false]);
    const given = next(drawn, judges(judge("ann", 1), judge("local", 3)));
    expect([given.proposal?.id, judgeable(given, 3)]).toEqual([3, true]);
  });

  it("keeps one's own while others' come and go", () => {
    const other = next(begun, closed(hers, { verdict: "bad" }), opened(proposal(4, { slot: 0 })));
    expect([other.proposal?.id, judgeable(other, 2)]).toEqual([2, true]);
  });

  it("says whose approval has closed it, and that what was said still trains", () => {
    const approved = { ...hers, heard: ["ann"], closed_at: AT, close_reason: "judged" as const };
    const before = next(begun, { type: "proposal_closed", proposal: { ...approved, verdict: "good" } });
    const superseded = closed(mine, { close_reason: "superseded", superseded_by: 1 });
    const unseen = next(before, superseded, { type: "execution_started", execution: execution(1) });
    expect(unseen.notices.at(-1)?.text).toContain("ann approved another one first");
    const said = next(
      before,
      { type: "acknowledged", request_id: "click-2", feedback: feedback(2, { value: -1 }) },
      superseded,
    );
    expect(said.notices.at(-1)?.text).toContain("closed by the approval of ann");
    expect(said.notices.at(-1)?.text).toContain("still trains");
  });

  it("keeps what this trainer thinks about on the screen until it is judged or its time is over", () => {
    const approved = { ...hers, heard: ["ann"], closed_at: AT, close_reason: "judged" as const };
    const at = [judge("ann", null), { ...judge("local", 2), finishing: true }];
    const begun_ = next(
      begun,
      { type: "proposal_closed", proposal: { ...approved, verdict: "good" } },
      judges(...at),
      closed(mine, { close_reason: "superseded", superseded_by: 1 }),
      { type: "execution_started", execution: execution(1) },
    );
    expect([begun_.proposal?.id, begun_.live, judgeable(begun_, 2)]).toEqual([2, null, true]);
    expect(activity(begun_, true).text).toContain("it still trains");
    expect(begun_.notices.at(-1)?.text).toContain("You may still judge yours");
    const over = next(begun_, judges(judge("local", null)));
    expect([over.proposal?.closed_at, over.live, judgeable(over, 2)]).toEqual([AT, 1, false]);
    const told = next(begun_, {
      type: "acknowledged",
      request_id: "click-2",
      feedback: feedback(2, { value: 1, status: "overtaken" }),
    });
    expect(told.notices.at(-1)?.text).toContain("Kept, and it trains");
    expect(judgeable(told, 2)).toBe(false);
    const back = next(begun, snapshot({ proposals: [], finishing: { ...mine, closed_at: AT }, judges: at }));
    expect([back.proposal?.id, judgeable(back, 2)]).toEqual([2, true]);
  });

  it("leaves the approver alone with that", () => {
    const approved = { ...mine, heard: ["local"], closed_at: AT, close_reason: "judged" as const };
    const after = next(begun, { type: "proposal_closed", proposal: approved });
    expect(next(after, closed(hers, { close_reason: "superseded", superseded_by: 2 })).notices).toEqual([]);
  });
});

describe("a majority", () => {
  const three = proposal(5, { electorate: ["ann", "bob", "local"] });
  const asked = next(initial, snapshot({ experiment: majority, proposals: [three], proposal: three }));

  it("tells how many votes are in and needed, then who is missing, never what was said", () => {
    const all = [judge("ann", 5), judge("bob", 5), judge("local", 5)];
    const said = (change: Partial<Proposal>) => votesIn({ ...three, ...change }, majority, all);
    expect(said({ heard: ["ann"] })).toBe("1 of 3 votes are in. 2 alike decide.");
    expect(said({ heard: ["ann", "local"] })).toBe("2 of 3 votes are in. Waiting for bob.");
    expect(said({ electorate: ["ann", "bob"] })).toContain("You came after it opened");
    // an operator is told the names, a trainer how many
    const veiled = { electorate: ["somebody-3fa2c1", "somebody-77b0aa", "local"], heard: ["local"] };
    expect(said(veiled)).toBe("1 of 3 votes are in. Waiting for 2 other trainers.");
  });

  it("is still open after one's own vote, which can be taken back", () => {
    const sent = reduce(asked, {
      kind: "pending",
      clicks: [{ click_id: "click-5", trainer: "local", proposal_id: 5, value: 1 }],
    });
    const voted = next(
      sent,
      { type: "proposal_changed", proposal: { ...three, heard: ["local"] } },
      { type: "acknowledged", request_id: "click-5", feedback: feedback(5) },
    );
    expect(judgeable(voted, 5)).toBe(false);
    expect(activity(voted, true).text).toBe("You have voted. Others are still asked.");
    expect(voted.undoable?.id).toBe(5);
    const undone = next(
      voted,
      { type: "feedback_undone", feedback: feedback(5, { undone_at: AT }) },
      { type: "proposal_changed", proposal: three },
    );
    expect(judgeable(undone, 5)).toBe(true);
  });

  it("offers nobody another's undo", () => {
    const told: StreamEvent = {
      type: "feedback_stored",
      feedback: feedback(5, { trainer: "ann" }),
      undoable: true,
    };
    expect(next(asked, told).undoable).toBeNull();
  });

  it("isn't for who came after the proposal opened", () => {
    const late = next(asked, {
      type: "proposal_changed",
      proposal: { ...three, electorate: ["ann", "bob"] },
    });
    expect(judgeable(late, 5)).toBe(false);
    expect(activity(late, true).text).toBe("Others judge this one.");
  });
});

describe("the lease", () => {
  beforeEach(() => void vi.useFakeTimers());
  afterEach(() => void vi.useRealTimers());
  const line = (change: Partial<VotesProps>, on: Experiment = parallel) =>
    show(
      <Votes
        proposal={mine}
        experiment={on}
        judges={[judge("ann", 1), judge("local", 2)]}
        leaseLeft={() => 60}
        {...change}
      />,
    );

  it("says when one's proposal is about to go to the others, and when it has", async () => {
    await line({ leaseLeft: () => 5 });
    await act(async () => vi.advanceTimersByTime(1000));
    expect(byTestId("votes").textContent).toContain("Still there?");
    await line({ judges: [judge("ann", 1), judge("local", null, true)] });
    expect(byTestId("votes").textContent).toBe(
      "You are away: move the mouse or touch the page to judge again.",
    );
  });

  it("warns where all look at the same one, too, and says to whoever is away that nobody waits for them", async () => {
    const judges = [judge("ann", 1), judge("local", 1)];
    await line({ judges, leaseLeft: () => 5 }, majority);
    await act(async () => vi.advanceTimersByTime(1000));
    expect(byTestId("votes").textContent).toContain("decided without you");
    await line({ judges: [judge("ann", 1), judge("local", null, true)] }, majority);
    expect(byTestId("votes").textContent).toContain("You are away");
    await line({ judges, leaseLeft: () => 5 });
    await act(async () => vi.advanceTimersByTime(1000));
    expect(byTestId("votes").textContent).not.toContain("You are away");
  });

  it("says nothing to who is alone", async () => {
    await line({ judges: [judge("local", 2)], leaseLeft: () => 0 });
    await act(async () => vi.advanceTimersByTime(1000));
    expect(document.querySelector("[data-testid=votes]")).toBeNull();
  });
});
