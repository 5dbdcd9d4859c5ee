import { useState } from "react";
import * as http from "../http";
import { t } from "../i18n";
import { Link } from "../router";
import type { Experiment, Problem, Verb } from "../wire";
import { goodShare } from "./Counters";
import type { Question } from "./Dialog";
import { StatePill } from "./StatePill";
import { finishQuestion } from "./TrainerTitle";
import { Verbs } from "./Verbs";

export interface ExperimentRowProps {
  experiment: Experiment;
  onChanged: () => void;
  onProblem: (problem: Problem | null) => void;
  onAsk: (question: Question) => void;
}

export function ExperimentRow({ experiment, onChanged, onProblem, onAsk }: ExperimentRowProps) {
  const [busy, setBusy] = useState(false);
  const { counters } = experiment;
  const run = async (verb: Verb) => {
    setBusy(true);
    try {
      await http.act(experiment.id, verb);
      onProblem(null);
    } catch (error) {
      onProblem(http.problemOf(error));
    }
    setBusy(false);
    onChanged();
  };
  return (
    <li className="row" data-testid="experiment" data-id={experiment.id}>
      <div>
        <div className="title-line">
          <h2>
            <Link to={`/experiments/${experiment.id}`}>{experiment.name}</Link>
          </h2>
          <StatePill experiment={experiment} />
        </div>
        <p className="facts">{`${experiment.task} · ${experiment.adapter} · ${experiment.algorithm}${experiment.teacher ? ` · ${t("create.teacher", { teacher: experiment.teacher })}` : ""}`}</p>
        {experiment.failure && <p className="error">{experiment.failure}</p>}
      </div>
      <dl className="figure">
        <dt>{t("counters.feedback")}</dt>
        <dd>{counters.feedback}</dd>
      </dl>
      <dl className="figure">
        <dt>{t("counters.goodShare")}</dt>
        <dd>{goodShare(counters)}</dd>
      </dl>
      <dl className="figure">
        <dt>{t("counters.successes")}</dt>
        <dd>{counters.successes}</dd>
      </dl>
      <Verbs
        experiment={experiment}
        busy={busy}
        onVerb={(verb) =>
          verb === "finish" ? onAsk(finishQuestion(experiment.name, () => void run(verb))) : void run(verb)
        }
      />
    </li>
  );
}
