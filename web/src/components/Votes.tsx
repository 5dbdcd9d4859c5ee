// How far the open proposal's votes are, where several trainers judge; never what anybody has said.
import { useEffect, useState } from "react";
import { t } from "../i18n";
import { ME } from "../me";
import { isOpen } from "../robots";
import { asked, judgeOf, needed, waitedFor } from "../together";
import type { Experiment, Judge, Proposal } from "../wire";

export interface VotesProps {
  proposal: Proposal | null;
  experiment: Experiment;
  judges: Judge[];
  /** Seconds until what one has before oneself goes to the others, without a sign of life. */
  leaseLeft: () => number;
}

const CHECK_MS = 500;
/** Seconds before a lease's end at which it is told of; of a short one a third. */
const TOLD = 15;

function rule(proposal: Proposal, experiment: Experiment): string {
  const need = needed(proposal, experiment) ?? 0;
  if (experiment.aggregation === "majority") return t("together.majorityNeeds", { need });
  return experiment.aggregation === "unanimous" ? t("together.unanimousNeeds") : t("together.weightedNeeds");
}

/** What to say of it; null where this trainer is alone with it, and that is enough. */
export function votesIn(proposal: Proposal, experiment: Experiment, judges: Judge[]): string | null {
  const { least } = experiment.together;
  const told = byRule(proposal, experiment, judges);
  return least === 1 ? told : [told, t("together.leastNeeds", { count: least })].filter(Boolean).join(" ");
}

function byRule(proposal: Proposal, experiment: Experiment, judges: Judge[]): string | null {
  const others = judges.filter(({ trainer, away }) => trainer !== ME && !away).length;
  const { electorate, heard } = proposal;
  if (experiment.aggregation === "first") {
    if (others === 0) return null;
    if (experiment.together.least > 1)
      return t("together.votesIn", { heard: heard.length, count: others + 1 });
    const busy = judges.filter(
      ({ trainer, away, proposal_id }) => trainer !== ME && !away && proposal_id !== null,
    );
    const too = busy.filter(({ proposal_id }) => proposal_id === proposal.id).length;
    if (!experiment.together.parallel && too > 0) return t("together.firstDecides", { count: too });
    const me = judgeOf(judges);
    const mine = me?.proposal_id === proposal.id && !me.finishing;
    return mine && busy.length > 0 ? t("together.yours", { count: busy.length }) : null;
  }
  const alone = electorate.length === 0 || (electorate.length === 1 && electorate[0] === ME);
  if (alone && others === 0) return null;
  const votes = t("together.votesIn", { heard: heard.length, count: electorate.length });
  if (heard.includes(ME)) {
    const who = waitedFor(proposal);
    return who ? `${votes} ${t("together.waitingFor", { who })}` : votes;
  }
  const mine = asked(proposal, experiment, judges);
  return `${votes} ${mine ? rule(proposal, experiment) : t("together.notAsked")}`;
}

/** Whether the lease of what is on the screen is about to end, or has ended: then nobody waits for this trainer. */
function useLease({ experiment, judges, leaseLeft }: VotesProps): "fresh" | "ends" | "ended" {
  const [soon, setSoon] = useState(false);
  const { parallel, lease_seconds: lease } = experiment.together;
  const me = judgeOf(judges);
  const waited = parallel || experiment.aggregation !== "first";
  const watched = waited && me !== null && me.proposal_id !== null && !me.finishing && judges.length > 1;
  useEffect(() => {
    if (!watched) return;
    const check = () => setSoon(leaseLeft() <= Math.min(TOLD, lease / 3));
    const timer = setInterval(check, CHECK_MS);
    return () => {
      clearInterval(timer);
      setSoon(false);
    };
  }, [watched, lease, leaseLeft]);
  if (me?.away) return "ended";
  return watched && soon ? "ends" : "fresh";
}

export function Votes(props: VotesProps) {
  const { proposal, experiment, judges } = props;
  const lease = useLease(props);
  const open = proposal !== null && isOpen(proposal) && experiment.lifecycle === "running";
  const away = lease === "ended";
  const votes = open && !away ? votesIn(proposal, experiment, judges) : null;
  if (experiment.teacher || experiment.lifecycle !== "running" || (votes === null && lease === "fresh"))
    return null;
  const ends = experiment.together.parallel ? t("together.leaseEnds") : t("together.leaseEndsShared");
  return (
    <p className="votes soft" role="status" data-testid="votes" data-lease={lease}>
      {votes && <span>{votes}</span>}
      {lease !== "fresh" && <b>{away ? t("together.youAreAway") : ends}</b>}
    </p>
  );
}
