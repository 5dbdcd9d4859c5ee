import { useState } from "react";
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
    title: "Finish this experiment?",
    text: `“${name}” can't be resumed afterwards. Its data stay, and it can still be evaluated.`,
    yes: "Finish",
    danger: true,
    testId: "finish-confirm",
    act,
  };
}

/** The service's words, which come in lower case and without a full stop. */
function sentences(words: string): string {
  const text = words.replace(/(^|[.!?] )(\p{Ll})/gu, (start) => start.toUpperCase());
  return /[.!?]$/.test(text) ? text : `${text}.`;
}

export function TrainerTitle({ experiment, session, onAsk }: TrainerTitleProps) {
  const [busy, setBusy] = useState(false);
  if (!experiment)
    return (
      <div className="title-row">
        <h1>Loading</h1>
      </div>
    );
  const run = async (verb: Verb) => {
    setBusy(true);
    await session.act(verb);
    setBusy(false);
  };
  const facts = [
    experiment.task,
    experiment.num_envs > 1 ? `${experiment.num_envs} robots on ${experiment.adapter}` : experiment.adapter,
    experiment.algorithm,
    experiment.preset,
    `seed ${experiment.seed}`,
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
            <b>This experiment failed.</b>{" "}
            {sentences(experiment.failure ?? "see the server’s log, then resume")}
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
