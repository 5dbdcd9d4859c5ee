import { useState } from "react";
import { t } from "../i18n";
import { sentence } from "../i18n/said";
import type { Session } from "../session";
import type { Experiment, Verb } from "../wire";
import type { Question } from "./Dialog";
import { StatePill } from "./StatePill";
import { Verbs } from "./Verbs";

export interface TrainerTitleProps {
  experiment: Experiment | null;
  session: Session;
  onAsk: (question: Question) => void;
}

/** What finishing means, asked before it is done. */
export function finishQuestion(name: string, act: () => void): Question {
  return {
    title: t("title.finish"),
    text: t("title.finishWhat", { name }),
    yes: t("verbs.finish"),
    danger: true,
    testId: "finish-confirm",
    act,
  };
}

export function TrainerTitle({ experiment, session, onAsk }: TrainerTitleProps) {
  const [busy, setBusy] = useState(false);
  if (!experiment)
    return (
      <div className="title-row">
        <h1>{t("common.loading")}</h1>
      </div>
    );
  const run = async (verb: Verb) => {
    setBusy(true);
    await session.act(verb);
    setBusy(false);
  };
  const facts = [
    experiment.task,
    experiment.num_envs > 1
      ? t("title.robotsOn", { count: experiment.num_envs, adapter: experiment.adapter })
      : experiment.adapter,
    experiment.algorithm,
    experiment.preset,
    t("title.seed", { seed: experiment.seed }),
  ];
  const verbs = (
    <Verbs
      experiment={experiment}
      busy={busy}
      onVerb={(verb) =>
        verb === "finish" ? onAsk(finishQuestion(experiment.name, () => void run(verb))) : void run(verb)
      }
    />
  );
  const failed = experiment.lifecycle === "failed";
  return (
    <>
      {failed && (
        <div className="banner" role="alert" data-testid="failed">
          <div>
            <b>{t("title.failed")}</b> {sentence(experiment.failure ?? t("title.failedHow"))}
          </div>
          {verbs}
        </div>
      )}
      <div className="title-row">
        <div className="title-text">
          <div className="title-line">
            <h1>{experiment.name}</h1>
            <StatePill experiment={experiment} />
          </div>
          <p className="soft">{facts.filter(Boolean).join(" · ")}</p>
        </div>
        {!failed && verbs}
      </div>
    </>
  );
}
