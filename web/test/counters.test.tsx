// What the counters say of safety: how many violations, and how many in a hundred decisions.
import { act } from "react";
import { describe, expect, it } from "vitest";
import { Counters, violationRatio } from "../src/components/Counters";
import { experiment } from "./messages";
import { byTestId, show } from "./render";

describe("counters", () => {
  it("shows violations and their share of all decisions", async () => {
    const { counters } = experiment();
    await act(async () => {
      show(<Counters counters={{ ...counters, feedback: 48, violations: 3 }} />);
    });
    expect(byTestId("count-violations").textContent).toBe("3");
    expect(byTestId("violation-ratio").textContent).toBe("6.3 % of decisions");
  });

  it("has no share before the first decision", () => {
    expect(violationRatio({ feedback: 0, auto_approved: 0, violations: 0 })).toBe("–");
    expect(violationRatio({ feedback: 10, auto_approved: 0, violations: 0 })).toBe("0.0 %");
  });

  it("counts what the critic decided among the decisions", () => {
    expect(violationRatio({ feedback: 30, auto_approved: 70, violations: 2 })).toBe("2.0 %");
  });
});
