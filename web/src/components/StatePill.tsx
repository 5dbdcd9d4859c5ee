import { t } from "../i18n";
import type { Experiment } from "../wire";

/** Where an experiment is; an emergency stop outshines it. */
export function StatePill({ experiment }: { experiment: Experiment }) {
  const state = experiment.halted ? "halted" : experiment.lifecycle;
  return (
    <span className="pill" data-state={state} data-testid="lifecycle">
      <span className="dot" />
      {t(`lifecycle.${state}`)}
    </span>
  );
}
