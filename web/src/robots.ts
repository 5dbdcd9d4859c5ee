// What the page knows of each robot of the experiment, and which of them it shows.
import { t } from "./i18n";
import type { Execution, Proposal, Value } from "./wire";

export interface RobotState {
  /** The newest proposal; open while `closed_at` is absent. */
  proposal: Proposal | null;
  execution: Execution | null;
  /** The execution whose video covers the stills; it stays until a newer proposal brings newer stills. */
  live: number | null;
  /** What its proposal is to this page's trainer: theirs before all others', theirs as well, or nothing. */
  asks: "first" | "too" | "no";
  /** The closed form of `proposal`, which this page's trainer may finish although another's approval has closed it. */
  finishing: Proposal | null;
}

export const STILL: RobotState = { proposal: null, execution: null, live: null, asks: "no", finishing: null };

export function isOpen(proposal: Proposal): boolean {
  return !proposal.closed_at;
}

/** What this page has said, acknowledged, by proposal; a proposal may stay open until others are judged too. */
export type Judged = Record<number, Value>;

/** Whether this robot's proposal waits for this page. */
export function waits({ proposal, asks }: RobotState, judged: Judged): boolean {
  return proposal !== null && isOpen(proposal) && asks !== "no" && judged[proposal.id] === undefined;
}

/** The proposals that wait for this page, of all robots: the one that it was given, then the others, oldest first. */
export function queueOf(robots: RobotState[], judged: Judged): Proposal[] {
  const place = ({ robot, number }: Proposal) => (robots[robot]?.asks === "first" ? 0 : number);
  const open = robots.flatMap((robot) => (robot.proposal && waits(robot, judged) ? [robot.proposal] : []));
  return open.sort((one, other) => place(one) - place(other));
}

/** The chosen robot; else the one whose turn it is to be judged; else the one before, which may move by that click. */
export function shownRobot(
  robots: RobotState[],
  chosen: number | null,
  before: number,
  judging: boolean,
  judged: Judged,
): number {
  if (chosen !== null && chosen < robots.length) return chosen;
  const [next] = judging ? queueOf(robots, judged) : [];
  if (next) return next.robot;
  const stays = robots[before];
  if (stays && (!judging || stays.proposal || stays.execution)) return before;
  return Math.max(
    0,
    robots.findIndex(({ execution }) => execution !== null),
  );
}

/** The sentence, and before it which robot it is about, where there are several. */
export function saying(robots: RobotState[], robot: number, text: string): string {
  return robots.length > 1 ? t("notice.ofRobot", { robot: robot + 1, text }) : text;
}
