// The compared experiments with what they came to, and only those settings in which they differ.
import { differing } from "../comparing";
import { t } from "../i18n";
import { whole } from "../i18n/numbers";
import { Link } from "../router";
import { type Json, shownAs } from "../schemaForm";
import type { Experiment } from "../wire";
import { goodShare, violationRatio } from "./Counters";
import { StatePill } from "./StatePill";

/** Everything an experiment was made with, under one name each. */
function madeWith(experiment: Experiment): Record<string, unknown> {
  const { task, adapter, algorithm, preset, seed, teacher, num_envs, lockstep } = experiment;
  return {
    ...{ task, adapter, algorithm, preset, seed, teacher, num_envs, lockstep },
    ...experiment.settings,
    ...experiment.adapter_settings,
    ...experiment.teacher_settings,
  };
}

export interface CompareTableProps {
  experiments: Experiment[];
  onRemove: (id: number) => void;
}

export function CompareTable({ experiments, onRemove }: CompareTableProps) {
  const made = experiments.map(madeWith);
  const names = differing(made);
  if (experiments.length === 0) return null;
  return (
    <div className="card">
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls must be reached by keyboard */}
      <section className="scroll" tabIndex={0} aria-label={t("compare.table")}>
        <table className="runs compared" data-testid="compared">
          <thead>
            <tr>
              <th scope="col">{t("list.sort_name")}</th>
              <th scope="col">{t("counters.feedback")}</th>
              <th scope="col">{t("counters.successes")}</th>
              <th scope="col">{t("counters.goodShare")}</th>
              <th scope="col">{t("results.violationRatio")}</th>
              {names.map((name) => (
                <th key={name} scope="col">
                  <code>{name}</code>
                </th>
              ))}
              <th scope="col">
                <span className="sr-only">{t("list.acts")}</span>
              </th>
            </tr>
          </thead>
          <tbody>
            {experiments.map((experiment, index) => (
              <tr key={experiment.id}>
                <th scope="row">
                  <Link to={`/experiments/${experiment.id}/results`}>{experiment.name}</Link>{" "}
                  <StatePill experiment={experiment} />
                </th>
                <td>{whole(experiment.counters.feedback)}</td>
                <td>{whole(experiment.counters.successes)}</td>
                <td>{goodShare(experiment.counters)}</td>
                <td>{violationRatio(experiment.counters)}</td>
                {names.map((name) => (
                  <td key={name}>{shownAs((made[index]?.[name] ?? null) as Json) || "–"}</td>
                ))}
                <td>
                  <button
                    type="button"
                    className="button quiet"
                    aria-label={t("compare.removeOf", { name: experiment.name })}
                    onClick={() => onRemove(experiment.id)}
                  >
                    {t("compare.remove")}
                  </button>
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      </section>
    </div>
  );
}
