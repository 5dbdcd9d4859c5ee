// The runs of one scenario: a line each, with how far, how fast and how well.
import type { StudyRun, StudyScenario } from "../wire";

const UNITS = { low_level_steps: "low-level steps", decisions: "decisions" };

function seconds(run: StudyRun): string {
  const whole = Math.round(run.seconds);
  return whole < 60 ? `${whole} s` : `${Math.floor(whole / 60)} min`;
}

function RunRow({ run, scenario }: { run: StudyRun; scenario: StudyScenario }) {
  const percent = Math.floor(100 * run.done);
  return (
    <tr data-testid="run" data-id={run.id} data-state={run.state}>
      <th scope="row">{run.title}</th>
      <td className="number">{run.seed}</td>
      <td>
        <span className="pill" data-state={run.state}>
          <span className="dot" />
          {run.state}
        </span>
        {run.error && <p className="error">{run.error}</p>}
      </td>
      <td className="number">
        <span className="track" aria-hidden="true">
          <i style={{ width: `${percent}%` }} />
        </span>
        {`${percent} %`}
      </td>
      <td className="number">{run[scenario.axis].toLocaleString()}</td>
      <td className="number">{run.rate ? `${run.rate.toFixed(1)}/s` : ""}</td>
      <td className="number">{run.success_rate === null ? "" : `${Math.round(100 * run.success_rate)} %`}</td>
      <td className="number">{run.successes}</td>
      <td className="number">{run.violations}</td>
      <td className="number">{seconds(run)}</td>
    </tr>
  );
}

/** "27 runs: 2 running, 5 finished". */
function counted(runs: StudyRun[]): string {
  const states = [...new Set(runs.map((run) => run.state))];
  const told = states.map((state) => `${runs.filter((run) => run.state === state).length} ${state}`);
  return `${runs.length} ${runs.length === 1 ? "run" : "runs"}: ${told.join(", ")}`;
}

export function StudyRuns({ scenario, runs }: { scenario: StudyScenario; runs: StudyRun[] }) {
  const busy = runs.some((run) => run.state === "running" || run.state === "failed");
  return (
    <details open={busy}>
      <summary data-testid="runs">{counted(runs)}</summary>
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls must be reachable by keyboard */}
      <section className="scroll" tabIndex={0} aria-label={`Runs of ${scenario.title}`}>
        <table className="runs">
          <thead>
            <tr>
              <th scope="col">Algorithm</th>
              <th scope="col">Seed</th>
              <th scope="col">State</th>
              <th scope="col">Done</th>
              <th scope="col">{UNITS[scenario.axis]}</th>
              <th scope="col">Rate</th>
              <th scope="col">Success rate</th>
              <th scope="col">Successes</th>
              <th scope="col">Violations</th>
              <th scope="col">Time</th>
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
