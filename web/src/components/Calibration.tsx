// How well the critic's predictions were borne out: its reliability curve, from what it predicted before each click.

import * as http from "../http";
import { t } from "../i18n";
import { decimal, signed } from "../i18n/numbers";
import { useLatest } from "../useLatest";
import type { Calibration, Experiment } from "../wire";

const SIZE = 200;
const EDGE = { left: 34, right: 10, top: 8, bottom: 34 };
const TICKS = [-1, 0, 1];

const across = (value: number) => EDGE.left + ((clamped(value) + 1) / 2) * (SIZE - EDGE.left - EDGE.right);
const up = (value: number) =>
  SIZE - EDGE.bottom - ((clamped(value) + 1) / 2) * (SIZE - EDGE.top - EDGE.bottom);

function clamped(value: number): number {
  return Math.max(-1, Math.min(1, value));
}

function Plot({ bins, labels }: { bins: Calibration["bins"]; labels: number }) {
  const most = Math.max(...bins.map((bin) => bin.count));
  return (
    <svg viewBox={`0 0 ${SIZE} ${SIZE}`} role="img" aria-label={t("calibration.curve", { count: labels })}>
      {TICKS.map((tick) => (
        <g key={tick} className="axis">
          <path d={`M${across(tick)} ${up(-1)}V${up(1)}M${across(-1)} ${up(tick)}H${across(1)}`} />
          <text x={across(tick)} y={up(-1) + 14} textAnchor="middle">
            {signed(tick, 0)}
          </text>
          <text x={across(-1) - 6} y={up(tick) + 4} textAnchor="end">
            {signed(tick, 0)}
          </text>
        </g>
      ))}
      <path className="ideal" d={`M${across(-1)} ${up(-1)}L${across(1)} ${up(1)}`} />
      {bins.map((bin) => (
        <g key={bin.low} className="bin">
          <path d={`M${across(bin.predicted)} ${up(bin.predicted)}V${up(bin.label)}`} />
          <circle cx={across(bin.predicted)} cy={up(bin.label)} r={2.5 + 5 * Math.sqrt(bin.count / most)}>
            <title>
              {t("calibration.bin", {
                predicted: signed(bin.predicted),
                label: signed(bin.label),
                count: bin.count,
              })}
            </title>
          </circle>
        </g>
      ))}
      <text className="name" x={(across(-1) + across(1)) / 2} y={SIZE - 4} textAnchor="middle">
        {t("calibration.across")}
      </text>
      <text className="name" x={9} y={up(0)} textAnchor="middle" transform={`rotate(-90 9 ${up(0)})`}>
        {t("calibration.up")}
      </text>
    </svg>
  );
}

/** The same figures for those who don't see the chart. */
function Figures({ bins }: { bins: Calibration["bins"] }) {
  return (
    <table className="sr-only">
      <caption>{t("calibration.caption")}</caption>
      <thead>
        <tr>
          <th scope="col">{t("calibration.predicted")}</th>
          <th scope="col">{t("calibration.mean")}</th>
          <th scope="col">{t("calibration.labels")}</th>
        </tr>
      </thead>
      <tbody>
        {bins.map((bin) => (
          <tr key={bin.low}>
            <td>{signed(bin.predicted)}</td>
            <td>{signed(bin.label)}</td>
            <td>{bin.count}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

export function CalibrationCard({ told }: { told: Calibration | null }) {
  return (
    <section className="card" aria-label={t("calibration.label")}>
      <h2>{t("calibration.title")}</h2>
      <div className="calibration" data-testid="calibration" data-labels={told?.labels ?? 0}>
        {told && told.error !== null ? (
          <>
            <Plot bins={told.bins} labels={told.labels} />
            <Figures bins={told.bins} />
            <div className="result">
              <b className="number" data-testid="calibration-error">{`± ${decimal(told.error)}`}</b>
              <p className="soft">{t("calibration.error", { labels: told.labels })}</p>
              <p className="hint">{t("calibration.hint")}</p>
            </div>
          </>
        ) : (
          <p className="empty-chart" data-testid="calibration-empty">
            {told
              ? t("calibration.needs", { needed: told.needed, labels: told.labels })
              : t("common.loading")}
          </p>
        )}
      </div>
    </section>
  );
}

export function CalibrationPanel({ experiment }: { experiment: Experiment }) {
  const { id, counters } = experiment;
  const told = useLatest(() => http.calibration(id), `${id}:${counters.feedback}`);
  return <CalibrationCard told={told} />;
}
