// The rule of auto-approval that was turned off here last: turning it on again is no reason to ask for the first one.
import type { AutoApproval } from "./wire";

const keyOf = (experimentId: number) => `seed.auto-approval.${experimentId}`;

/** Kept across reloads, by experiment. */
export function rememberRule(experimentId: number, rule: AutoApproval): void {
  try {
    window.localStorage.setItem(keyOf(experimentId), JSON.stringify(rule));
  } catch {
    // A full or forbidden storage costs the memory of the rule, not the turning off.
  }
}

/** The rule that was remembered; null where there is none that could be one. */
export function lastRule(experimentId: number): AutoApproval | null {
  try {
    const parsed: unknown = JSON.parse(window.localStorage.getItem(keyOf(experimentId)) ?? "null");
    return isRule(parsed) ? parsed : null;
  } catch {
    return null;
  }
}

function isRule(value: unknown): value is AutoApproval {
  return (
    typeof value === "object" &&
    value !== null &&
    !Array.isArray(value) &&
    Object.values(value).every((part) => typeof part === "number")
  );
}
