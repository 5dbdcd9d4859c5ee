// How good the labels are: one's own figures, everybody's, how far they agree, and all of it as a table to take away.

import { type ReactNode, useCallback } from "react";
import * as http from "../http";
import { t } from "../i18n";
import { decimal, percent, whole } from "../i18n/numbers";
import { said } from "../i18n/said";
import { Link } from "../router";
import { usePolled } from "../usePolled";
import type { Experiment, LabelQuality, Problem, TrainerFigures } from "../wire";
import { QualitySettings } from "./QualitySettings";

type Share = TrainerFigures["gold"];

const share = ({ count, of }: Share) => (of === 0 ? "–" : `${percent(count / of)} (${count}/${of})`);
const pace = (perMinute: number | null) => (perMinute === null ? "–" : decimal(perMinute, 1));

function accuracy({ estimate }: TrainerFigures): string {
  if (!estimate?.interval || estimate.accuracy === null) return "–";
  const { accuracy: found, interval, informative } = estimate;
  const [low, high] = interval;
  return t("quality.estimate", {
    accuracy: percent(found),
    low: percent(low),
    high: percent(high),
    count: informative,
  });
}

export function OwnFigures({ id, mine }: { id: number; mine: TrainerFigures | null }) {
  const facts: [string, string][] = mine
    ? [
        [t("quality.labels"), whole(mine.labels)],
        [t("quality.pace"), pace(mine.per_minute)],
        [t("quality.withVerdicts"), share(mine.with_verdicts)],
        [t("quality.withOthers"), share(mine.with_others)],
        [t("quality.gold"), share(mine.gold)],
        [t("quality.streak"), whole(mine.streak)],
      ]
    : [];
  return (
    <section className="card" aria-label={t("quality.mine")} data-testid="own-figures">
      <h2>{t("quality.mine")}</h2>
      {mine && mine.labels + mine.cant_tell + mine.late > 0 ? (
        <dl className="figures">
          {facts.map(([name, value]) => (
            <div key={name}>
              <dt>{name}</dt>
              <dd>{value}</dd>
            </div>
          ))}
        </dl>
      ) : (
        <p className="soft">{t("quality.noneYet")}</p>
      )}
      <div className="actions">
        <Link to={`/experiments/${id}/practice`} className="button">
          {t("practice.start")}
        </Link>
      </div>
    </section>
  );
}

function Everybody({ trainers }: { trainers: TrainerFigures[] }) {
  return (
    // biome-ignore lint/a11y/noNoninteractiveTabindex: a wide table scrolls on a narrow page, by keyboard too
    <section className="scrolls" tabIndex={0} aria-label={t("quality.everybody")}>
      <table className="table" data-testid="trainers">
        <thead>
          <tr>
            <th scope="col">{t("quality.trainer")}</th>
            <th scope="col">{t("quality.labels")}</th>
            <th scope="col">{t("quality.pace")}</th>
            <th scope="col">{t("quality.accuracy")}</th>
            <th scope="col">{t("quality.withOthers")}</th>
            <th scope="col">{t("quality.gold")}</th>
          </tr>
        </thead>
        <tbody>
          {trainers.map((each) => (
            <tr key={`${each.kind}:${each.trainer}`}>
              <th scope="row">{each.trainer}</th>
              <td>{whole(each.labels)}</td>
              <td>{pace(each.per_minute)}</td>
              <td>{accuracy(each)}</td>
              <td>{share(each.with_others)}</td>
              <td>{share(each.gold)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}

export function QualityCard(props: {
  told: LabelQuality;
  table: (form: "csv" | "jsonl") => string;
  children?: ReactNode;
}) {
  const { told, table } = props;
  const { agreement, trainers } = told;
  return (
    <section className="card quality" aria-label={t("quality.title")} data-testid="quality">
      <h2>{t("quality.title")}</h2>
      <p data-testid="agreement">
        {agreement.alpha === null
          ? t("quality.noAlpha", { why: said(agreement.why ?? "") })
          : t("quality.alpha", {
              alpha: decimal(agreement.alpha),
              proposals: whole(agreement.proposals),
              trainers: whole(agreement.trainers),
            })}
      </p>
      {trainers.length > 0 && <Everybody trainers={trainers} />}
      {props.children}
      <div className="actions">
        <a className="button" href={table("csv")} download>
          {t("quality.csv")}
        </a>
        <a className="button" href={table("jsonl")} download>
          {t("quality.jsonl")}
        </a>
      </div>
    </section>
  );
}

const REFRESH_MS = 5000; // as often as trainers are measured anew

/** Whoever may not see the others' figures sees their own only. */
export function LabelQualityPanel(props: { experiment: Experiment; onProblem: (problem: Problem) => void }) {
  const { experiment } = props;
  const { id } = experiment;
  const askMine = useCallback(() => http.ownFigures(id), [id]);
  const askAll = useCallback(() => http.labelQuality(id), [id]);
  const { value: mine } = usePolled(askMine, REFRESH_MS);
  const { value: told } = usePolled(askAll, REFRESH_MS);
  return (
    <>
      <OwnFigures id={id} mine={mine} />
      {told && (
        <QualityCard told={told} table={(form) => http.feedbackTable(id, form)}>
          {!experiment.teacher && <QualitySettings experiment={experiment} onProblem={props.onProblem} />}
        </QualityCard>
      )}
    </>
  );
}
