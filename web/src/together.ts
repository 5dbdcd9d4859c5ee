// Several trainers on one experiment: which open proposal this page's trainer is to judge. Pure.
import { t } from "./i18n";
import { listed } from "./i18n/numbers";
import { ME } from "./me";
import type { RobotState } from "./robots";
import type { Experiment, Judge, Proposal, Value } from "./wire";

/** How the word begins that stands for another trainer's name, for whoever isn't told it (server/privacy.py). */
const VEILED = "somebody-";

/** A trainer as this page may call them. */
export const called = (name: string): string =>
  name.startsWith(VEILED) ? t("together.others", { count: 1 }) : name;

/** Names as a list; those that this page isn't told are counted. */
function people(names: string[]): string {
  const told = names.filter((name) => !name.startsWith(VEILED));
  const count = names.length - told.length;
  return listed(count > 0 ? [...told, t("together.others", { count })] : told);
}

/** Who is waited for, in words. */
export const waitedFor = (proposal: Proposal): string => people(missing(proposal));

export function judgeOf(judges: Judge[], trainer: string = ME): Judge | null {
  return judges.find((judge) => judge.trainer === trainer) ?? null;
}

/** As the service rules: whether this trainer's vote on an open proposal is asked for and would count. */
export function asked(proposal: Proposal, experiment: Experiment | null, judges: Judge[]): boolean {
  const { electorate, heard } = proposal;
  if (heard.includes(ME)) return false;
  const least = experiment?.together.least ?? 1;
  const anybody = experiment?.aggregation === "first" || electorate.length < least;
  if (!anybody && !electorate.includes(ME)) return false;
  const exclusive = experiment?.aggregation === "first" && experiment.together.parallel && least === 1;
  return !exclusive || !judges.some((each) => each.proposal_id === proposal.id && each.trainer !== ME);
}

/** Of one robot's open proposals, in the order they opened, the one that the page shows; null: the one before stays. */
function pick(
  open: Proposal[],
  before: Proposal | null,
  experiment: Experiment | null,
  judges: Judge[],
): Proposal | null {
  const me = judgeOf(judges);
  const mine = open.find(({ id }) => id === me?.proposal_id);
  if (mine) return mine;
  const stays = open.find(({ id }) => id === before?.id) ?? null;
  // Another's own proposal must not flash by until this trainer is given the next one.
  if (me && experiment?.together.parallel) return stays;
  return open.findLast((proposal) => asked(proposal, experiment, judges)) ?? stays ?? open.at(-1) ?? null;
}

/** Every robot with the one of its open proposals that this trainer has before them, if any. */
export function showing(
  robots: RobotState[],
  opened: Proposal[],
  judges: Judge[],
  experiment: Experiment | null,
): RobotState[] {
  const me = judgeOf(judges);
  return robots.map((was, robot) => {
    if (was.finishing && me?.finishing && me.proposal_id === was.finishing.id)
      return was.asks === "first" ? was : { ...was, asks: "first" };
    const before = was.finishing ? { ...was, proposal: was.finishing, finishing: null } : was;
    const open = opened.filter((each) => each.robot === robot);
    const picked = pick(open, before.proposal, experiment, judges);
    const mine = picked !== null && judgeOf(judges)?.proposal_id === picked.id;
    const asks = mine ? "first" : picked && asked(picked, experiment, judges) ? "too" : "no";
    const fresh = picked !== null && picked.id !== before.proposal?.id && !before.execution;
    return { ...before, proposal: picked ?? before.proposal, asks, live: fresh ? null : before.live };
  });
}

/** How many the same answers close an open proposal; null where that isn't a matter of heads alone. */
export function needed(proposal: Proposal, experiment: Experiment): number | null {
  const count = proposal.electorate.length;
  if (experiment.aggregation === "majority") return Math.floor(count / 2) + 1;
  return experiment.aggregation === "unanimous" ? count : null;
}

/** Those of the electorate who haven't voted on it. */
export function missing(proposal: Proposal): string[] {
  return proposal.electorate.filter((name) => !proposal.heard.includes(name));
}

/** Whether this trainer may still say what they think of a proposal that another one's approval has closed. */
export function mayFinish(proposal: Proposal, judges: Judge[]): boolean {
  const me = judgeOf(judges);
  return (me?.finishing ?? false) && me?.proposal_id === proposal.id;
}

/** What to say of a proposal that another one's approval has closed; null: nothing that this trainer doesn't know. */
export function overtaken(
  proposal: Proposal,
  approved: Proposal | null,
  said: Value | undefined,
  seen: "no" | "seen" | "finishing",
): string | null {
  if (proposal.close_reason !== "superseded" || approved?.heard.includes(ME)) return null;
  const told = approved?.heard.some((name) => !name.startsWith(VEILED));
  const who = approved && told ? people(approved.heard) : t("together.somebody");
  if (said !== undefined && said !== "cant_tell")
    return t("together.stillTrains", { who, number: proposal.number });
  if (seen === "no") return null;
  const overtaken = t("together.overtaken", { who });
  return seen === "finishing" ? `${overtaken} ${t("together.finishIt")}` : overtaken;
}
