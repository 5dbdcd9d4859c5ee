// The strip of past proposals: one's own labels, corrected and filtered, however they came.
import { act } from "react";
import { describe, expect, it, vi } from "vitest";
import { HistoryStrip } from "../src/components/History";
import { type History, KEPT, lastMotion, loaded, remember, shown } from "../src/history";
import { ME } from "../src/me";
import { execution, feedback, proposal, snapshot } from "./messages";
import { byTestId, show } from "./render";

const closed = (id: number) => proposal(id, { closed_at: "2026-01-01T00:00:05Z", close_reason: "judged" });
const run = execution(7, {
  proposal_id: 2,
  outcome: "failed",
  violations: [{ kind: "damage", detail: "bump" }],
});

const past: History = loaded(
  [],
  [closed(1), closed(2), closed(3)],
  [feedback(1, { value: -1, label: -1 }), feedback(2), feedback(3, { trainer: "someone else" })],
  [run],
  ME,
);

describe("history", () => {
  it("knows one's own labels and what came of them, newest first", () => {
    expect(past.map(({ proposal }) => proposal.id)).toEqual([3, 2, 1]);
    expect(past.map(({ own }) => own?.label ?? null)).toEqual([null, 1, -1]);
    const ids = (filter: Parameters<typeof shown>[1]) =>
      shown(past, filter).map(({ proposal }) => proposal.id);
    expect([ids("good"), ids("bad"), ids("executed"), ids("violation")]).toEqual([[2], [1], [2], [2]]);
  });

  it("stays as short as it is, whatever comes", () => {
    let history: History = [];
    for (let id = 1; id <= 2000; id += 1)
      history = remember(history, { type: "proposal_opened", proposal: proposal(id) }, ME);
    expect(history.length).toBe(KEPT);
    expect(history[0]?.proposal.id).toBe(2000);
  });

  it("follows clicks, corrections and what is taken back", () => {
    const told = (event: Parameters<typeof remember>[1]) => remember(past, event, ME)[2]?.own?.label ?? null;
    expect(told({ type: "feedback_relabelled", feedback: feedback(1, { value: -1, label: 1 }) })).toBe(1);
    expect(
      told({ type: "feedback_undone", feedback: feedback(1, { undone_at: "2026-01-01T00:00:09Z" }) }),
    ).toBe(null);
    expect(
      told({ type: "feedback_stored", feedback: feedback(1, { trainer: "other" }), undoable: false }),
    ).toBe(-1);
  });

  it("takes what REST tells after a break over what it held before it", () => {
    const events: Parameters<typeof remember>[1][] = [
      { type: "proposal_opened", proposal: proposal(4) },
      { type: "acknowledged", request_id: "click-4", feedback: feedback(4) },
      { type: "execution_started", execution: execution(8, { proposal_id: 4 }) },
      { type: "proposal_opened", proposal: proposal(5) },
    ];
    const before = events.reduce((history, event) => remember(history, event, ME), past);
    const ended = execution(8, {
      proposal_id: 4,
      ended_at: "2026-01-01T00:01:00Z",
      outcome: "interrupted",
      violations: [{ kind: "manual_reset", detail: "restarted" }],
    });
    const again = remember(before, snapshot({ proposal: proposal(6) }), ME);
    const during = remember(again, { type: "feedback_stored", feedback: feedback(6), undoable: true }, ME);
    const rest = [closed(4), closed(5), closed(6)];
    const taken = feedback(4, { undone_at: "2026-01-01T00:00:30Z" });
    const after = loaded(during, rest, [taken], [ended], ME);
    expect(lastMotion(after, 0)?.execution).toEqual(ended);
    expect(after.map(({ proposal }) => [proposal.id, proposal.closed_at !== null])).toEqual([
      [6, false], // the snapshot told of it, and nothing of its end yet
      [5, true],
      [4, true],
      [3, true],
      [2, true],
      [1, true],
    ]);
    expect(after.map(({ own }) => own?.label ?? null)).toEqual([1, null, null, null, 1, -1]);
  });

  it("takes what the stream tells over an answer that was on its way", () => {
    const told = remember(
      remember(past, snapshot(), ME),
      { type: "execution_ended", execution: { ...run, outcome: "succeeded" }, violations: [] },
      ME,
    );
    const after = loaded(told, [closed(2)], [], [{ ...run, outcome: null, ended_at: null }], ME);
    expect(lastMotion(after, 0)?.execution?.outcome).toBe("succeeded");
  });

  it("opens one to correct it, by one's own click only", async () => {
    const onRelabel = vi.fn();
    await show(<HistoryStrip history={past} onRelabel={onRelabel} />);
    const open = async (index: number) =>
      act(async () => document.querySelectorAll<HTMLElement>('[data-testid="past"]')[index]?.click());
    await open(0);
    expect(document.querySelector('[data-testid="relabel-good"]')).toBeNull();
    await act(async () => document.querySelector<HTMLElement>("[data-first]")?.click());
    await open(2);
    expect(byTestId("relabel-bad").getAttribute("aria-pressed")).toBe("true");
    await act(async () => byTestId("relabel-good").click());
    expect(onRelabel).toHaveBeenCalledExactlyOnceWith(1, 1);
  });
});
