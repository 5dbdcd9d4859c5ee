// What the robots tell of themselves, outside of the reducer: five times a second it would draw the whole page anew.
import { useSyncExternalStore } from "react";
import type { Telemetry } from "./wire";

export class Telling {
  private readonly told = new Map<number, Telemetry>();
  private attending: string | null = null;
  private readonly listeners = new Set<() => void>();

  tell(robot: number, telemetry: Telemetry): void {
    this.told.set(robot, telemetry);
    this.changed();
  }

  /** Who attends a real robot. */
  attended(operator: string | null): void {
    this.attending = operator;
    this.changed();
  }

  get operator(): string | null {
    return this.attending;
  }

  private changed(): void {
    for (const listener of this.listeners) listener();
  }

  get(robot: number): Telemetry | null {
    return this.told.get(robot) ?? null;
  }

  subscribe = (listener: () => void): (() => void) => {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  };
}

export function useTold(telling: Telling, robot: number): Telemetry | null {
  return useSyncExternalStore(telling.subscribe, () => telling.get(robot));
}

export function useOperator(telling: Telling): string | null {
  return useSyncExternalStore(telling.subscribe, () => telling.operator);
}
