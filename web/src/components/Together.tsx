// How several trainers judge together: the rule, who judges what, and who is there. For operators, live.
import { useCallback } from "react";
import * as http from "../http";
import { t } from "../i18n";
import { percent } from "../i18n/numbers";
import { ME } from "../me";
import type { Session } from "../session";
import { usePolled } from "../usePolled";
import type { Aggregation, Experiment, Judge, LabelQuality, Proposal } from "../wire";
import type { Question } from "./Dialog";
import { Choice } from "./Field";

export const RULES: Aggregation[] = ["first", "majority", "unanimous", "weighted"];
const LEAST = [1, 2, 3, 4, 5];
const LEASES = [15, 30, 60, 120, 300];
const VANISHING = [0, 5, 10, 30, 60];
const FINISHING = [0, 10, 20, 60];
const REFRESH_MS = 5000; // as often as trainers are measured anew

/** Those on offer, and the one that is set by other means. */
function seconds(offered: number[], now: number): { value: string; label: string }[] {
  return [...new Set([...offered, now])]
    .sort((one, other) => one - other)
    .map((each) => ({ value: String(each), label: t("together.seconds", { count: each }) }));
}

/** How many have to say good, on offer and as it is set. */
export function heads(now: number): { value: string; label: string }[] {
  return [...new Set([...LEAST, now])]
    .sort((one, other) => one - other)
    .map((count) => ({ value: String(count), label: t("together.leastOf", { count }) }));
}

function at(judge: Judge, opened: Proposal[]): string {
  if (judge.away) return t("together.isAway");
  if (judge.finishing) return t("together.isFinishing");
  const number = opened.find(({ id }) => id === judge.proposal_id)?.number;
  return number === undefined ? t("together.isWaiting") : t("together.isAt", { number });
}

/** How often a trainer's labels are right, as estimated from everybody's. */
function reliability(told: LabelQuality | null, trainer: string): string {
  const estimate = told?.trainers.find(
    (each) => each.trainer === trainer && each.kind === "person",
  )?.estimate;
  return estimate?.accuracy == null ? t("together.unknown") : percent(estimate.accuracy);
}

function Who(props: { experiment: Experiment; judges: Judge[]; opened: Proposal[] }) {
  const { id } = props.experiment;
  const ask = useCallback(() => http.labelQuality(id), [id]);
  const { value: told } = usePolled(ask, REFRESH_MS);
  return (
    <table className="table who" data-testid="judges">
      <thead>
        <tr>
          <th scope="col">{t("together.who")}</th>
          <th scope="col">{t("together.doing")}</th>
          <th scope="col">{t("together.reliability")}</th>
        </tr>
      </thead>
      <tbody>
        {props.judges.map((judge) => (
          <tr key={judge.trainer} data-away={judge.away}>
            <th scope="row">
              {judge.trainer === ME ? t("together.you", { name: judge.trainer }) : judge.trainer}
            </th>
            <td>{at(judge, props.opened)}</td>
            <td>{reliability(told, judge.trainer)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

export interface TogetherProps {
  experiment: Experiment;
  judges: Judge[];
  opened: Proposal[];
  session: Session;
  onAsk: (question: Question) => void;
}

export function TogetherPanel({ experiment, judges, opened, session, onAsk }: TogetherProps) {
  const { aggregation, together, lockstep } = experiment;
  const set = (change: http.TogetherChange) => void session.setTogether(change);
  const alone = (act: () => void): Question => ({
    title: t("together.alone"),
    text: t("together.aloneWhat"),
    yes: t("together.aloneYes"),
    danger: true,
    testId: "weighted-confirm",
    act,
  });
  return (
    <section className="together" aria-label={t("together.title")}>
      <h3>{t("together.title")}</h3>
      <div className="form">
        <Choice
          label={t("together.rule")}
          name="aggregation"
          value={aggregation}
          options={RULES.map((value) => ({ value, label: t(`together.rules.${value}`) }))}
          onChange={(value) => set({ aggregation: value as Aggregation })}
        />
        <Choice
          label={t("together.least")}
          name="least"
          value={String(together.least)}
          options={heads(together.least)}
          onChange={(value) => set({ together: { least: Number(value) } })}
        />
        <Choice
          label={t("together.proposals")}
          name="parallel"
          value={together.parallel ? "own" : "shared"}
          options={["shared", "own"].map((value) => ({
            value,
            label: t(`together.${value as "shared" | "own"}`),
          }))}
          error={lockstep ? t("together.lockstep") : undefined}
          onChange={(value) => set({ together: { parallel: value === "own" } })}
        />
        <Choice
          label={t("together.lease")}
          name="lease_seconds"
          value={String(together.lease_seconds)}
          options={seconds(LEASES, together.lease_seconds)}
          onChange={(value) => set({ together: { lease_seconds: Number(value) } })}
        />
        <Choice
          label={t("together.vanish")}
          name="vanish_seconds"
          value={String(together.vanish_seconds)}
          options={seconds(VANISHING, together.vanish_seconds)}
          onChange={(value) => set({ together: { vanish_seconds: Number(value) } })}
        />
        {together.parallel && (
          <Choice
            label={t("together.finish")}
            name="finish_seconds"
            value={String(together.finish_seconds)}
            options={seconds(FINISHING, together.finish_seconds)}
            onChange={(value) => set({ together: { finish_seconds: Number(value) } })}
          />
        )}
        {aggregation === "weighted" && (
          <label className="check wide">
            <input
              type="checkbox"
              checked={together.weighted_approves}
              data-testid="weighted-approves"
              onChange={(event) => {
                if (!event.target.checked) set({ together: { weighted_approves: false } });
                else onAsk(alone(() => set({ together: { weighted_approves: true } })));
              }}
            />
            {t("together.alone")}
          </label>
        )}
      </div>
      <p className="hint">{t(`together.rulesWhat.${aggregation}`)}</p>
      {judges.length > 0 && <Who experiment={experiment} judges={judges} opened={opened} />}
    </section>
  );
}
