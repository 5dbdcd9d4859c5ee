// The strip of past proposals: one's own labels, corrected and filtered, however they came.
import { act } from "react";
import { describe, expect, it, vi } from "vitest";
import { HistoryStrip } from "../src/components/History";
import { type History, KEPT, loaded, remember, shown } from "../src/history";
import { ME } from "../src/me";
import { execution, feedback, proposal } from "./messages";
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
