// Clicks that the service hasn't acknowledged yet, kept across reloads. The click's own id makes sending it again
// harmless: the service stores it once. Whoever sits here next neither sees nor sends those of the one before, who finds
// them again when they come back.
import type { Looked, Value } from "./wire";

export interface Click {
  click_id: string;
  /** Whose verdict it is, for as long as it is kept. */
  trainer: string;
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

  /** `trainer`: who sits here. */
  constructor(
    experimentId: number,
    private readonly trainer: string,
    private readonly storage: Storage,
  ) {
    this.key = `seed.outbox.${experimentId}`;
  }

  /** Those of whoever sits here. */
  all(): Click[] {
    const stored = this.stored().filter((click): click is Click => click.trainer === this.trainer);
    return [
      ...stored,
      ...this.own.filter((click) => !stored.some((other) => other.click_id === click.click_id)),
    ];
  }

  add(given: Omit<Click, "trainer">): Click {
    const click = { ...given, trainer: this.trainer };
    this.own.push(click);
    this.write([...this.stored(), click]);
    return click;
  }

  remove(clickId: string): void {
    this.own = this.own.filter((click) => click.click_id !== clickId);
    const stored = this.stored();
    const left = stored.filter((click) => click.click_id !== clickId);
    if (left.length !== stored.length) this.write(left);
  }

  /** Pages of before kept clicks without a name. They become, once and for good, those of the first trainer who opens
   * the experiment after the upgrade: nearly always who clicked, and the page of before would have sent them so too. */
  adopt(): void {
    const stored = this.stored();
    const named = stored.map((click) => ({ trainer: this.trainer, ...click }));
    if (stored.some((click) => click.trainer === undefined)) this.write(named);
  }

  private stored(): Kept[] {
    try {
      const parsed: unknown = JSON.parse(this.storage.getItem(this.key) ?? "[]");
      return Array.isArray(parsed) ? parsed.filter(isKept) : [];
    } catch {
      return [];
    }
  }

  private write(clicks: Kept[]): void {
    try {
      if (clicks.length) this.storage.setItem(this.key, JSON.stringify(clicks));
      else this.storage.removeItem(this.key);
    } catch {
      // A full or forbidden storage costs the click's survival of a reload, not the click itself.
    }
  }
}

type Kept = Omit<Click, "trainer"> & { trainer?: string };

function isKept(value: unknown): value is Kept {
  const click = value as Kept | null;
  return (
    typeof click?.click_id === "string" &&
    ["string", "undefined"].includes(typeof click.trainer) &&
    Number.isInteger(click.proposal_id) &&
    [-1, 0, 1, "cant_tell"].includes(click.value)
  );
}
