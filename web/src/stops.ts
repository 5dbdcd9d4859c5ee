// Emergency stops that the service hasn't confirmed yet. One outlives the page on which it was asked for: it is asked
// for again until it is confirmed, or refused, and whoever leaves that page is told how it goes.
import * as http from "./http";
import type { Experiment, Problem } from "./wire";

const RETRY_MS = 1000;
/** What is refused so is refused again: nobody who may is asking, or there is no such experiment. */
const FINAL: readonly number[] = [401, 403, 404];

/** The page of the experiment: while it is there it tells, and asks by its own connection as well. */
export interface Follower {
  ask: () => void;
  answered: (experiment: Experiment) => void;
  unreachable: () => void;
  refused: (problem: Problem) => void;
}

export interface Stop {
  id: number;
  state: "asked" | "unreachable" | "confirmed" | "refused";
}

const isWanted = ({ state }: Stop): boolean => state === "asked" || state === "unreachable";

export class Stops {
  private stops: readonly Stop[] = [];
  private told: readonly Stop[] = [];
  private readonly followers = new Map<number, Follower>();
  private readonly timers = new Map<number, ReturnType<typeof setTimeout>>();
  /** The request that is on its way: the answer to an earlier stop tells nothing of this one. */
  private readonly asking = new Map<number, symbol>();
  private readonly listeners = new Set<() => void>();

  /** At once, however many are on their way, and until it is confirmed. */
  ask(id: number): void {
    this.asking.delete(id);
    this.put({ id, state: "asked" });
    this.again(id);
  }

  /** At once, where one is wanted: there is reason to think that the service can be reached. */
  again(id: number): void {
    if (!this.wanted(id)) return;
    this.followers.get(id)?.ask();
    clearTimeout(this.timers.get(id));
    this.timers.set(
      id,
      setTimeout(() => this.overdue(id), RETRY_MS),
    );
    if (!this.asking.has(id)) void this.post(id);
  }

  wanted(id: number): boolean {
    return this.stops.some((stop) => stop.id === id && isWanted(stop));
  }

  /** It is halted, however that is known. */
  confirm(id: number): void {
    if (this.wanted(id)) this.end({ id, state: "confirmed" });
  }

  /** It isn't wanted any more, or whoever reads has read of it. */
  forget = (id: number): void => {
    clearTimeout(this.timers.get(id));
    this.asking.delete(id);
    this.keep(this.stops.filter((stop) => stop.id !== id));
  };

  follow(id: number, follower: Follower): () => void {
    this.followers.set(id, follower);
    if (this.stops.some((stop) => stop.id === id && stop.state === "unreachable")) follower.unreachable();
    if (this.wanted(id)) this.again(id);
    else this.forget(id);
    this.tell();
    return () => {
      if (this.followers.get(id) === follower) this.followers.delete(id);
      this.tell();
    };
  }

  subscribe = (listener: () => void): (() => void) => {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  };

  /** Those whose own page isn't there to tell of them. */
  elsewhere = (): readonly Stop[] => this.told;

  private async post(id: number): Promise<void> {
    const request = Symbol();
    this.asking.set(id, request);
    const current = (): boolean => this.asking.get(id) === request && this.asking.delete(id);
    try {
      const experiment = await http.halt(id);
      if (current()) this.answered(id, experiment);
    } catch (error) {
      if (current()) this.failed(id, http.problemOf(error));
    }
  }

  private answered(id: number, experiment: Experiment): void {
    this.followers.get(id)?.answered(experiment);
    if (experiment.halted) this.confirm(id);
  }

  private failed(id: number, problem: Problem): void {
    if (!FINAL.includes(problem.status)) {
      this.missed(id);
      return;
    }
    this.end({ id, state: "refused" });
    this.followers.get(id)?.refused(problem);
  }

  private overdue(id: number): void {
    this.missed(id);
    this.again(id);
  }

  private missed(id: number): void {
    if (!this.wanted(id)) return;
    this.put({ id, state: "unreachable" });
    this.followers.get(id)?.unreachable();
  }

  private end(stop: Stop): void {
    this.forget(stop.id);
    if (!this.followers.has(stop.id)) this.put(stop);
  }

  private put(stop: Stop): void {
    this.keep([...this.stops.filter(({ id }) => id !== stop.id), stop]);
  }

  private keep(stops: readonly Stop[]): void {
    this.stops = stops;
    if (stops.some(isWanted)) window.addEventListener("beforeunload", hold);
    else window.removeEventListener("beforeunload", hold);
    this.tell();
  }

  private tell(): void {
    this.told = this.stops.filter(({ id }) => !this.followers.has(id));
    for (const listener of this.listeners) listener();
  }
}

/** The browser asks whether to leave: nobody would go on asking. */
function hold(event: BeforeUnloadEvent): void {
  event.preventDefault();
}

export const stops = new Stops();
