// What the page knows of each robot of the experiment, and which of them it shows.
import type { Execution, Proposal } from "./wire";

export interface RobotState {
  /** The newest proposal; open while `closed_at` is absent. */
  proposal: Proposal | null;
  execution: Execution | null;
  /** The execution whose video covers the stills; it stays until a newer proposal brings newer stills. */
  live: number | null;
}

export const STILL: RobotState = { proposal: null, execution: null, live: null };

export function isOpen(proposal: Proposal): boolean {
  return !proposal.closed_at;
}

/** The proposals that wait, of all robots, oldest first. */
export function queueOf(robots: RobotState[]): Proposal[] {
  const open = robots.flatMap(({ proposal }) => (proposal && isOpen(proposal) ? [proposal] : []));
  return open.sort((one, other) => one.number - other.number);
}

/** The chosen robot; else the one whose turn it is to be judged; else the one before, which may move by that click. */
export function shownRobot(
  robots: RobotState[],
  chosen: number | null,
  before: number,
  judged: boolean,
): number {
  if (chosen !== null && chosen < robots.length) return chosen;
  const [next] = judged ? queueOf(robots) : [];
  if (next) return next.robot;
  const stays = robots[before];
  if (stays && (!judged || stays.proposal || stays.execution)) return before;
  return Math.max(
    0,
    robots.findIndex(({ execution }) => execution !== null),
  );
}

/** "Robot 2: " where there are several, at the start of a sentence about one. */
export function saying(robots: RobotState[], robot: number): string {
  return robots.length > 1 ? `Robot ${robot + 1}: ` : "";
}
