// What this browser remembers of how someone likes to judge.
import { useSyncExternalStore } from "react";

export interface Settings {
  /** The gripper's outline at the target. */
  ghost: boolean;
  /** The outline of where skills may act. */
  workspace: boolean;
  /** The scene drawn from the state. */
  scene: boolean;
  /** The predicted feedback. Hidden, it can't sway anybody. */
  estimate: boolean;
  sound: boolean;
  haptic: boolean;
  /** Minutes of judging until a rest is proposed; 0: never. */
  restAfter: number;
  /** Whether the tour was taken or declined. */
  toured: boolean;
}

export const RESTS = [0, 10, 20, 30, 45];

const KEPT = "seed.judging";
const FIRST: Settings = {
  ghost: false,
  workspace: false,
  scene: false,
  estimate: true,
  sound: false,
  haptic: false,
  restAfter: 20,
  toured: false,
};
const listeners = new Set<() => void>();
let current: Settings | null = null;

export function settings(): Settings {
  current ??= stored();
  return current;
}

export function change(by: Partial<Settings>): void {
  current = { ...settings(), ...by };
  try {
    localStorage.setItem(KEPT, JSON.stringify(current));
  } catch {
    // Without storage it lasts as long as the page.
  }
  for (const listener of listeners) listener();
}

export function useSettings(): Settings {
  return useSyncExternalStore(subscribe, settings);
}

function subscribe(listener: () => void): () => void {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

/** Only what has the right type: another version of the page may have written it. */
function stored(): Settings {
  try {
    const parsed: unknown = JSON.parse(localStorage.getItem(KEPT) ?? "{}");
    if (typeof parsed !== "object" || parsed === null) return FIRST;
    const fitting = Object.entries(parsed).filter(
      ([name, value]) => typeof value === typeof FIRST[name as keyof Settings],
    );
    return { ...FIRST, ...Object.fromEntries(fitting) };
  } catch {
    return FIRST;
  }
}
