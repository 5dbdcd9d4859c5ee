// Clicks that the service hasn't acknowledged yet, kept across reloads. The click's own id makes sending it again
// harmless: the service stores it once.
import type { Looked, Value } from "./wire";

export interface Click {
  click_id: string;
  proposal_id: number;
  /** Whether the predicted feedback was shown beside it. */
  estimate_shown?: boolean;
  /** What was on the screen: a click on something else than the proposal shows by then decides nothing. */
  looked?: Looked;
  value: Value;
}

/** Whether a click that was refused so is sent again: the service has a fault of its own, or it came too fast. */
export const comesAgain = (status: number): boolean => status >= 500 || status === 429;

export class Outbox {
  private readonly key: string;
  /** This tab's own clicks: they survive a storage that is full or forbidden. */
  private own: Click[] = [];

  constructor(
    experimentId: number,
    private readonly storage: Storage,
  ) {
    this.key = `seed.outbox.${experimentId}`;
  }

  all(): Click[] {
    const stored = this.stored();
    return [
      ...stored,
      ...this.own.filter((click) => !stored.some((other) => other.click_id === click.click_id)),
    ];
  }

  add(click: Click): void {
    this.own.push(click);
    this.write([...this.stored(), click]);
  }

  remove(clickId: string): void {
    this.own = this.own.filter((click) => click.click_id !== clickId);
    const stored = this.stored();
    const left = stored.filter((click) => click.click_id !== clickId);
    if (left.length !== stored.length) this.write(left);
  }

  private stored(): Click[] {
    try {
      const parsed: unknown = JSON.parse(this.storage.getItem(this.key) ?? "[]");
      return Array.isArray(parsed) ? parsed.filter(isClick) : [];
    } catch {
      return [];
    }
  }

  private write(clicks: Click[]): void {
    try {
      if (clicks.length) this.storage.setItem(this.key, JSON.stringify(clicks));
      else this.storage.removeItem(this.key);
    } catch {
      // A full or forbidden storage costs the click's survival of a reload, not the click itself.
    }
  }
}

function isClick(value: unknown): value is Click {
  const click = value as Click | null;
  return (
    typeof click?.click_id === "string" &&
    Number.isInteger(click.proposal_id) &&
    [-1, 0, 1, "cant_tell"].includes(click.value)
  );
}
