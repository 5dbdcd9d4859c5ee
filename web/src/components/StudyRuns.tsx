// The runs of one scenario: a line each, with how far, how fast and how well.
import { t } from "../i18n";
import { decimal, percent, whole } from "../i18n/numbers";
import type { StudyRun, StudyScenario } from "../wire";

const UNITS = { low_level_steps: "studies.steps", decisions: "studies.decisions" } as const;

function seconds(run: StudyRun): string {
  const taken = Math.round(run.seconds);
  return taken < 60
    ? t("studies.seconds", { count: taken })
    : t("studies.minutes", { count: Math.floor(taken / 60) });
}

function RunRow({ run, scenario }: { run: StudyRun; scenario: StudyScenario }) {
  const done = Math.floor(100 * run.done);
  return (
    <tr data-testid="run" data-id={run.id} data-state={run.state}>
      <th scope="row">{run.title}</th>
      <td className="number">{run.seed}</td>
      <td>
        <span className="pill" data-state={run.state}>
          <span className="dot" />
          {t(`studies.state.${run.state}`)}
        </span>
        {run.error && <p className="error">{run.error}</p>}
      </td>
      <td className="number">
        <span className="track" aria-hidden="true">
          <i style={{ width: `${done}%` }} />
        </span>
        {`${done} %`}
      </td>
      <td className="number">{whole(run[scenario.axis])}</td>
      <td className="number">{run.rate ? `${decimal(run.rate, 1)}/s` : ""}</td>
      <td className="number">{run.success_rate === null ? "" : percent(run.success_rate)}</td>
      <td className="number">{run.successes}</td>
      <td className="number">{run.violations}</td>
      <td className="number">{seconds(run)}</td>
    </tr>
  );
}

/** "27 runs: 2 running, 5 finished". */
function counted(runs: StudyRun[]): string {
  const states = [...new Set(runs.map((run) => run.state))];
  const told = states.map(
    (state) => `${runs.filter((run) => run.state === state).length} ${t(`studies.state.${state}`)}`,
  );
  return t("studies.runsCounted", { count: runs.length, states: told.join(", ") });
}

export function StudyRuns({ scenario, runs }: { scenario: StudyScenario; runs: StudyRun[] }) {
  const busy = runs.some((run) => run.state === "running" || run.state === "failed");
  return (
    <details open={busy}>
      <summary data-testid="runs">{counted(runs)}</summary>
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls must be reachable by keyboard */}
      <section className="scroll" tabIndex={0} aria-label={t("studies.runsOf", { title: scenario.title })}>
        <table className="runs">
          <thead>
            <tr>
              <th scope="col">{t("studies.columnAlgorithm")}</th>
              <th scope="col">{t("studies.columnSeed")}</th>
              <th scope="col">{t("studies.columnState")}</th>
              <th scope="col">{t("studies.columnDone")}</th>
              <th scope="col">{t(UNITS[scenario.axis])}</th>
              <th scope="col">{t("studies.columnRate")}</th>
              <th scope="col">{t("studies.columnSuccessRate")}</th>
              <th scope="col">{t("studies.columnSuccesses")}</th>
              <th scope="col">{t("studies.columnViolations")}</th>
              <th scope="col">{t("studies.columnTime")}</th>
            </tr>
          </thead>
          <tbody>
            {runs.map((run) => (
              <RunRow key={run.id} run={run} scenario={scenario} />
            ))}
          </tbody>
        </table>
      </section>
    </details>
  );
}
