// What the page says of the critic: how sure it is, how well calibrated, and what it approves by itself.
import { act } from "react";
import { afterEach, describe, expect, it, vi } from "vitest";
import { activity } from "../src/activity";
import { AutoApprovalCard, agreementIn, obstacleTo } from "../src/components/AutoApproval";
import { CalibrationCard, CalibrationPanel } from "../src/components/Calibration";
import type { Question } from "../src/components/Dialog";
import { Thought } from "../src/components/Thought";
import { signed } from "../src/i18n/numbers";
import { initial, reduce, type TrainerState } from "../src/state";
import type { AutoApprovalRecord, Calibration, StreamEvent } from "../src/wire";
import { execution, experiment, proposal, snapshot } from "./messages";
import { byTestId, show } from "./render";

const RULE = {
  predicted_at_least: 0.9,
  uncertainty_at_most: 0.1,
  after_feedback: 50,
  audit_every: 10,
  agreement_at_least: 0.9,
};

function calibration(change: Partial<Calibration> = {}): Calibration {
  return {
    experiment_id: 1,
    labels: 40,
    needed: 20,
    error: 0.08,
    bins: [
      { low: -1, high: -0.8, count: 10, predicted: -0.9, label: -1 },
      { low: 0.8, high: 1, count: 30, predicted: 0.9, label: 0.83 },
    ],
    ...change,
  };
}

function record(change: Partial<AutoApprovalRecord> = {}): AutoApprovalRecord {
  return {
    experiment_id: 1,
    rule: RULE,
    suspended: null,
    approved: 12,
    audited: 10,
    agreed: 9,
    agreement: 0.9,
    interval: [0.596, 0.982],
    ...change,
  };
}

describe("the predicted feedback", () => {
  it("comes with how far the critics disagree", async () => {
    await show(<Thought proposal={proposal(1, { predicted_feedback: 0.72, uncertainty: 0.15 })} />);
    expect(byTestId("predicted-feedback").textContent).toBe("+0.72");
    expect(byTestId("uncertainty").textContent).toBe(" ± 0.15");
    const reach = document.querySelector<HTMLElement>(".reach");
    expect(Number.parseFloat(reach?.style.left ?? "")).toBeCloseTo(78.5);
    expect(Number.parseFloat(reach?.style.width ?? "")).toBeCloseTo(15);
  });

  it("says that nothing is known of it where there is one critic, and not ± 0", async () => {
    await show(<Thought proposal={proposal(1, { uncertainty: null })} />);
    expect(document.querySelector("[data-testid=uncertainty]")).toBeNull();
    expect(byTestId("uncertainty-unknown").textContent).toContain("isn't known");
  });

  it("is drawn within the gauge however far it goes", async () => {
    await show(<Thought proposal={proposal(1, { predicted_feedback: 0.98, uncertainty: 0.5 })} />);
    const reach = document.querySelector<HTMLElement>(".reach");
    expect(Number.parseFloat(reach?.style.left ?? "") + Number.parseFloat(reach?.style.width ?? "")).toBe(
      100,
    );
  });

  it("has a true minus and no sign at zero", () => {
    expect([signed(-0.5), signed(0.001), signed(-0.001), signed(1, 0)]).toEqual([
      "−0.50",
      "0.00",
      "0.00",
      "+1",
    ]);
  });
});

describe("calibration", () => {
  afterEach(() => {
    vi.useRealTimers();
    vi.unstubAllGlobals();
  });

  it("says how many labels are missing before it draws anything", async () => {
    await show(<CalibrationCard told={calibration({ labels: 7, error: null })} />);
    expect(byTestId("calibration-empty").textContent).toBe("Needs 20 labels; there are 7.");
    expect(document.querySelector("svg")).toBeNull();
  });

  it("draws a dot a bin, larger where there are more labels, and tells the same in a table", async () => {
    await show(<CalibrationCard told={calibration()} />);
    const radii = [...document.querySelectorAll("circle")].map((dot) => Number(dot.getAttribute("r")));
    expect(radii).toHaveLength(2);
    expect(radii[1]).toBeGreaterThan(radii[0] ?? 0);
    expect(byTestId("calibration-error").textContent).toBe("± 0.08");
    const rows = [...document.querySelectorAll("tbody tr")].map((row) =>
      [...row.children].map((cell) => cell.textContent),
    );
    expect(rows).toEqual([
      ["−0.90", "−1.00", "10"],
      ["+0.90", "+0.83", "30"],
    ]);
  });

  it("asks again as labels come, at most once a second", async () => {
    vi.useFakeTimers();
    let labels = 19;
    const fetched = vi.fn(async () => {
      labels += 1;
      return Response.json(calibration({ labels }));
    });
    vi.stubGlobal("fetch", fetched);
    const after = (feedback: number) => {
      const { counters } = experiment();
      return <CalibrationPanel experiment={experiment({ counters: { ...counters, feedback } })} />;
    };
    const pass = (ms: number) => act(async () => void (await vi.advanceTimersByTimeAsync(ms)));
    await show(after(20));
    await pass(0);
    expect(byTestId("calibration").dataset.labels).toBe("20");
    for (const feedback of [21, 22, 23]) await show(after(feedback));
    await pass(900);
    expect(fetched).toHaveBeenCalledTimes(1);
    await pass(100);
    expect(fetched).toHaveBeenCalledTimes(2);
    expect(byTestId("calibration").dataset.labels).toBe("21");
  });
});

describe("auto-approval", () => {
  const ensemble = { settings: { critics: 2 } };
  const { counters } = experiment();

  it("is off until someone agrees to it", async () => {
    const asked: Question[] = [];
    const set = vi.fn();
    const card = (
      <AutoApprovalCard
        experiment={experiment(ensemble)}
        record={null}
        onAsk={(question) => asked.push(question)}
        onSet={set}
      />
    );
    await show(card);
    expect(byTestId("auto-approval").textContent).toContain("Off");
    await act(async () => byTestId("auto-approval-on").click());
    expect(set).not.toHaveBeenCalled();
    asked[0]?.act();
    expect(set).toHaveBeenCalledWith(RULE);
  });

  it("can't be had with one critic", () => {
    expect(obstacleTo(experiment({ settings: { critics: 1 } }))).toContain("two critics");
    expect(obstacleTo(experiment({ settings: {} }))).toContain("two critics");
    expect(obstacleTo(experiment(ensemble))).toBeNull();
  });

  it("counts the critic's approvals and says how trainers agreed", async () => {
    const set = vi.fn();
    const on = experiment({ ...ensemble, auto_approval: RULE, counters: { ...counters, auto_approved: 12 } });
    await show(<AutoApprovalCard experiment={on} record={record()} onAsk={vi.fn()} onSet={set} />);
    expect(byTestId("auto-approval").textContent).toBe(
      "12 motions approved by the criticTrainers agreed with 9 of 10 checked (95 % interval 60 % to 98 %).",
    );
    expect(document.body.textContent).toContain("predicted +0.90 or more, ±\u00a00.10 or less");
    await act(async () => byTestId("auto-approval-off").click());
    expect(set).toHaveBeenCalledWith(null); // turning it off needs no question
    expect(agreementIn(record({ audited: 0, agreed: 0 }))).toBe("Not checked by a trainer yet.");
  });

  it("says why it has suspended itself, and offers to turn it on again", async () => {
    const suspended = experiment({
      ...ensemble,
      auto_approval: { ...RULE, audit_every: 3 },
      auto_approval_suspended: "trainers called 1 of 3 audited proposals good",
    });
    const asked: Question[] = [];
    const set = vi.fn();
    await show(
      <AutoApprovalCard
        experiment={suspended}
        record={record()}
        onAsk={(question) => asked.push(question)}
        onSet={set}
      />,
    );
    expect(byTestId("auto-approval-suspended").textContent).toContain("1 of 3");
    expect(byTestId("auto-approval-on").textContent).toBe("Turn on again");
    await act(async () => byTestId("auto-approval-on").click());
    asked[0]?.act();
    expect(set).toHaveBeenCalledWith({ ...RULE, audit_every: 3 }); // the same rule, not the first one
  });

  it("is turned on again by the rule that was turned off, also after a reload", async () => {
    localStorage.clear();
    const custom = { ...RULE, predicted_at_least: 0.7, audit_every: 3 };
    const asked: Question[] = [];
    const set = vi.fn();
    const showAs = (id: number, rule: typeof custom | null) =>
      show(
        <AutoApprovalCard
          key={`${id} ${rule === null}`}
          experiment={experiment({ ...ensemble, id, auto_approval: rule })}
          record={null}
          onAsk={(question) => asked.push(question)}
          onSet={set}
        />,
      );
    await showAs(1, custom);
    await act(async () => byTestId("auto-approval-off").click());
    await showAs(1, null);
    await act(async () => byTestId("auto-approval-on").click());
    expect(asked[0]?.text).toContain("predicted +0.70 or more");
    asked[0]?.act();
    expect(set).toHaveBeenLastCalledWith(custom);

    await showAs(2, null); // another experiment has a rule of its own
    await act(async () => byTestId("auto-approval-on").click());
    asked[1]?.act();
    expect(set).toHaveBeenLastCalledWith(RULE);
    for (const rubbish of ["{", "[1]", '{"audit_every":"3"}']) {
      localStorage.setItem("seed.auto-approval.2", rubbish);
      await act(async () => byTestId("auto-approval-on").click());
      asked.at(-1)?.act();
      expect(set).toHaveBeenLastCalledWith(RULE);
    }
    localStorage.clear();
  });

  it("is said while the robot moves by it", () => {
    const closed = proposal(1, {
      closed_at: "2026-01-01T00:00:01Z",
      close_reason: "judged",
      verdict: "good",
    });
    const moving = (source: "critic" | "trainers"): TrainerState => {
      const events: StreamEvent[] = [
        snapshot({ proposal: proposal(1) }),
        { type: "proposal_closed", proposal: { ...closed, verdict_source: source } },
        { type: "execution_started", execution: execution(5, { proposal_id: 1 }) },
      ];
      return events.reduce((state, event) => reduce(state, { kind: "event", event }), initial);
    };
    expect(activity(moving("critic"), true).text).toBe("Executing pick, approved by the critic, live video");
    expect(activity(moving("trainers"), true).text).toBe("Executing pick, live video");
  });
});
