// The verbs that an experiment's state allows (DESIGN.md section 6).
import { t } from "../i18n";
import { may } from "../me";
import type { Experiment, Verb } from "../wire";

type Shown = Exclude<Verb, "reset" | "halt" | "rearm">;

const ALLOWED: Record<Experiment["lifecycle"], Shown[]> = {
  created: ["start"],
  running: ["pause", "finish"],
  paused: ["resume", "finish"],
  failed: ["resume"],
  finished: [],
  archived: [],
};

export function Verbs(props: { experiment: Experiment; busy: boolean; onVerb: (verb: Shown) => void }) {
  const { experiment } = props;
  return (
    <div className="actions">
      {ALLOWED[experiment.lifecycle].map((verb) => {
        const moves = verb === "start" || verb === "resume";
        const blocked =
          props.busy ||
          !may("operator") ||
          (moves && (experiment.halted || experiment.phase === "evaluating"));
        return (
          <button
            key={verb}
            type="button"
            className={moves ? "button primary" : "button"}
            data-testid={verb}
            aria-label={t("verbs.of", { verb: t(`verbs.${verb}`), name: experiment.name })}
            disabled={blocked}
            onClick={() => props.onVerb(verb)}
          >
            {t(`verbs.${verb}`)}
          </button>
        );
      })}
    </div>
  );
}
