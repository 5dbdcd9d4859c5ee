// One experiment in the list: a row of the table on a desk, a card on a phone.
import { useState } from "react";
import * as http from "../http";
import { t } from "../i18n";
import { shortMoment, whole } from "../i18n/numbers";
import { Link } from "../router";
import type { Experiment, Problem, Verb } from "../wire";
import { goodShare } from "./Counters";
import type { Question } from "./Dialog";
import { StatePill } from "./StatePill";
import { Tags } from "./Tags";
import { finishQuestion } from "./TrainerTitle";
import { Verbs } from "./Verbs";

export interface ExperimentRowProps {
  experiment: Experiment;
  selected: boolean;
  knownTags: string[];
  onSelect: (selected: boolean) => void;
  onTag: (tag: string) => void;
  onChanged: () => void;
  onProblem: (problem: Problem | null) => void;
  onAsk: (question: Question) => void;
}

export function factsOf(experiment: Experiment): string {
  const { task, adapter, algorithm, preset, teacher, seed } = experiment;
  return [
    task,
    adapter,
    preset ? `${algorithm} ${preset}` : algorithm,
    t("title.seed", { seed }),
    teacher && t("create.teacher", { teacher }),
  ]
    .filter(Boolean)
    .join(" · ");
}

export function ExperimentRow(props: ExperimentRowProps) {
  const { experiment, onChanged, onProblem, onAsk } = props;
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
    <tr data-testid="experiment" data-id={experiment.id} data-selected={props.selected}>
      <td className="pick">
        <input
          type="checkbox"
          checked={props.selected}
          aria-label={t("list.select", { name: experiment.name })}
          onChange={(event) => props.onSelect(event.target.checked)}
        />
      </td>
      <th scope="row" className="what">
        <div className="title-line">
          <Link to={`/experiments/${experiment.id}`}>{experiment.name}</Link>
          <StatePill experiment={experiment} />
        </div>
        <p className="facts">{factsOf(experiment)}</p>
        {experiment.failure && <p className="error">{experiment.failure}</p>}
        <Tags
          experiment={experiment}
          known={props.knownTags}
          onChanged={onChanged}
          onProblem={onProblem}
          onChoose={props.onTag}
        />
      </th>
      <td data-label={t("counters.feedback")}>{whole(counters.feedback)}</td>
      <td data-label={t("counters.goodShare")}>{goodShare(counters)}</td>
      <td data-label={t("counters.successes")}>{whole(counters.successes)}</td>
      <td data-label={t("list.violations")} className={counters.violations > 0 ? "alarm" : undefined}>
        {whole(counters.violations)}
      </td>
      <td data-label={t("list.sort_updated")} className="when">
        {shortMoment(experiment.updated_at)}
      </td>
      <td className="acts">
        <Verbs
          experiment={experiment}
          busy={busy}
          onVerb={(verb) =>
            verb === "finish" ? onAsk(finishQuestion(experiment.name, () => void run(verb))) : void run(verb)
          }
        />
        <div className="actions">
          <Link
            to={`/experiments/${experiment.id}/results`}
            className="button quiet"
            label={t("list.resultsOf", { name: experiment.name })}
          >
            {t("nav.results")}
          </Link>
          <Link
            to={`/experiments/new?from=${experiment.id}`}
            className="button quiet"
            label={t("list.cloneOf", { name: experiment.name })}
            testId="clone"
          >
            {t("list.clone")}
          </Link>
        </div>
      </td>
    </tr>
  );
}
