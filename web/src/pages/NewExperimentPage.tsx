// The form of a new experiment, made from what the catalogue says there is. The service validates; its field errors
// are shown at their fields.

import { type FormEvent, useEffect, useRef, useState } from "react";
import { Choice, Field } from "../components/Field";
import { Header } from "../components/Header";
import { ProblemBanner } from "../components/ProblemBanner";
import { ProblemCard } from "../components/ProblemCard";
import { SettingsPart } from "../components/SettingsPart";
import { heads, RULES } from "../components/Together";
import {
  bodiesOf,
  cloneOf,
  type Draft,
  errorAt,
  firstDraft,
  MOST_SEEDS,
  modeFor,
  PARTS,
  type Part,
  presetFor,
  unplaced,
} from "../draft";
import * as http from "../http";
import { t, taskWords } from "../i18n";
import { Link, navigate, useSearch } from "../router";
import type { Json } from "../schemaForm";
import { useCatalogue } from "../useCatalogue";
import type { Aggregation, Experiment, Mode, Problem } from "../wire";

const BASICS = [
  "name",
  "task",
  "adapter",
  "algorithm",
  "preset",
  "teacher",
  "seed",
  "num_envs",
  "mode",
  "aggregation",
  "together",
  "feedback_timeout",
  "tags",
];

/** The experiment to clone, if the address names one. */
function useOriginal(id: string | null): { original: Experiment | null; problem: Problem | null } {
  const [answer, setAnswer] = useState<{ original: Experiment | null; problem: Problem | null }>({
    original: null,
    problem: null,
  });
  useEffect(() => {
    if (!id) return;
    http.experiment(Number(id)).then(
      (original) => setAnswer({ original, problem: null }),
      (error: unknown) => setAnswer({ original: null, problem: http.problemOf(error) }),
    );
  }, [id]);
  return answer;
}

export function NewExperimentPage() {
  const from = new URLSearchParams(useSearch()).get("from");
  const { catalogue, problem } = useCatalogue();
  const { original, problem: lost } = useOriginal(from);
  const wrong = problem ?? lost;
  useEffect(() => {
    document.title = `${t("create.title")} · SEED`;
  }, []);
  if (wrong) return <ProblemCard problem={wrong} />;
  const ready = catalogue && (!from || original);
  return (
    <>
      <Header back />
      <main className="page narrow">
        <div className="title-row">
          <div className="title-text">
            <h1>{original ? t("create.cloneTitle", { name: original.name }) : t("create.title")}</h1>
          </div>
        </div>
        {ready ? (
          <NewForm
            key={from}
            catalogue={catalogue}
            first={original ? cloneOf(catalogue, original) : firstDraft(catalogue)}
          />
        ) : (
          <div className="skeleton" role="status" aria-label={t("common.loading")} />
        )}
      </main>
    </>
  );
}

function NewForm({ catalogue, first }: { catalogue: http.Catalogue; first: Draft }) {
  const [draft, setDraft] = useState(first);
  const [problem, setProblem] = useState<Problem | null>(null);
  const [busy, setBusy] = useState(false);
  const made = useRef<number[]>([]); // of several, those before one that failed: they aren't made twice
  const set = (change: Partial<Draft>) => setDraft((before) => ({ ...before, ...change }));
  const setIn = (part: Part, name: string, value: Json) =>
    setDraft((before) => ({ ...before, [part]: { ...before[part], [name]: value } }));
  const submit = async (event: FormEvent) => {
    event.preventDefault();
    setBusy(true);
    try {
      const bodies = bodiesOf(catalogue, draft);
      for (const body of bodies.slice(made.current.length))
        made.current.push((await http.createExperiment(body)).id);
      navigate(bodies.length === 1 ? `/experiments/${made.current[0]}` : "/");
    } catch (failure) {
      setProblem(http.problemOf(failure));
      setBusy(false);
    }
  };
  const algorithm = catalogue.algorithms.find(({ name }) => name === draft.algorithm);
  const adapter = catalogue.adapters.find(({ name }) => name === draft.adapter);
  const teacher = catalogue.teachers.find(({ name }) => name === draft.teacher);
  const homeless = unplaced(problem, [...BASICS, ...PARTS]);
  const whose = { settings: algorithm, adapter_settings: adapter, teacher_settings: teacher };
  return (
    <form className="new-experiment" onSubmit={submit} noValidate>
      <Basics catalogue={catalogue} draft={draft} problem={problem} onChange={set} />
      {PARTS.map((part) => (
        <SettingsPart
          key={part}
          part={part}
          of={whose[part]?.name ?? ""}
          about={whose[part]?.description ?? ""}
          catalogue={catalogue}
          draft={draft}
          problem={problem}
          onChange={setIn}
        />
      ))}
      {problem && (
        <ProblemBanner problem={problem} testId="create-problem">
          {homeless.map((each) => (
            <p key={each}>{each}</p>
          ))}
        </ProblemBanner>
      )}
      <div className="actions form-end">
        <button type="submit" className="button primary" disabled={busy} data-testid="create">
          {t("create.submit")}
        </button>
        <Link to="/" className="button">
          {t("common.cancel")}
        </Link>
      </div>
    </form>
  );
}

interface BasicsProps {
  catalogue: http.Catalogue;
  draft: Draft;
  problem: Problem | null;
  onChange: (change: Partial<Draft>) => void;
}

function Basics(props: BasicsProps) {
  const { draft, problem, onChange } = props;
  const text = (name: "name" | "seed" | "seeds" | "num_envs" | "feedback_timeout" | "tags") => ({
    name,
    value: draft[name],
    error: errorAt(problem, name),
    onChange: (value: string) => onChange({ [name]: value }),
  });
  return (
    <section className="card form" aria-label={t("create.basics")}>
      <Field wide label={t("create.name")} {...text("name")} />
      <Choices {...props} />
      <Field label={t("create.seed")} numeric {...text("seed")} />
      <Field
        label={t("create.seeds")}
        numeric
        hint={t("create.seedsWhat", { most: MOST_SEEDS })}
        {...text("seeds")}
      />
      <Field label={t("create.robots")} numeric hint={t("create.robotsWhat")} {...text("num_envs")} />
      <Field
        label={t("create.timeout")}
        numeric
        hint={t("create.timeoutWhat")}
        {...text("feedback_timeout")}
      />
      <Field wide label={t("create.tags")} hint={t("create.tagsWhat")} {...text("tags")} />
    </section>
  );
}

function Choices({ catalogue, draft, problem, onChange }: BasicsProps) {
  const names = (items: { name: string }[]) => items.map(({ name }) => ({ value: name, label: name }));
  const adapters = catalogue.adapters.filter((each) => each.tasks.includes(draft.task));
  const algorithm = catalogue.algorithms.find(({ name }) => name === draft.algorithm);
  const setAdapter = (adapter: string) =>
    onChange({ adapter, adapter_settings: {}, mode: modeFor(catalogue, adapter) });
  const setTask = (task: string) => {
    const before = catalogue.tasks.find((each) => each.name === draft.task);
    const after = catalogue.tasks.find((each) => each.name === task);
    const untouched = before && draft.name === taskWords(before.title);
    const stages = catalogue.adapters.filter((each) => each.tasks.includes(task));
    onChange({
      task,
      ...(untouched && after ? { name: taskWords(after.title) } : {}),
    });
    if (!stages.some(({ name }) => name === draft.adapter)) setAdapter(stages[0]?.name ?? "");
  };
  return (
    <>
      <Choice
        label={t("create.task")}
        name="task"
        value={draft.task}
        hint={taskWords(catalogue.tasks.find(({ name }) => name === draft.task)?.instruction ?? "")}
        options={catalogue.tasks.map(({ name, title }) => ({ value: name, label: taskWords(title) }))}
        error={errorAt(problem, "task")}
        onChange={setTask}
      />
      <Choice
        label={t("create.adapter")}
        name="adapter"
        value={draft.adapter}
        hint={catalogue.adapters.find(({ name }) => name === draft.adapter)?.description}
        options={names(adapters)}
        error={errorAt(problem, "adapter")}
        onChange={setAdapter}
      />
      <Choice
        label={t("create.algorithm")}
        name="algorithm"
        value={draft.algorithm}
        hint={algorithm?.description}
        options={names(catalogue.algorithms)}
        error={errorAt(problem, "algorithm")}
        onChange={(name) => onChange({ algorithm: name, preset: presetFor(catalogue, name), settings: {} })}
      />
      <Choice
        label={t("create.preset")}
        name="preset"
        value={draft.preset}
        hint={t("create.presetWhat")}
        options={[
          { value: "", label: t("create.presetDefault") },
          ...Object.keys(algorithm?.presets ?? {}).map((value) => ({ value, label: value })),
        ]}
        error={errorAt(problem, "preset")}
        onChange={(preset) => onChange({ preset })}
      />
      <Choice
        label={t("create.judge")}
        name="teacher"
        value={draft.teacher}
        hint={catalogue.teachers.find(({ name }) => name === draft.teacher)?.description}
        options={[
          { value: "", label: t("create.you") },
          ...catalogue.teachers.map(({ name }) => ({
            value: name,
            label: t("create.teacher", { teacher: name }),
          })),
        ]}
        error={errorAt(problem, "teacher")}
        onChange={(teacher) => onChange({ teacher, teacher_settings: {} })}
      />
      {!draft.teacher && <TogetherChoices draft={draft} problem={problem} onChange={onChange} />}
      <Choice
        label={t("create.approved")}
        name="mode"
        value={draft.mode}
        options={[
          { value: "execute_approved", label: t("create.executed") },
          { value: "propose_only", label: t("create.onlyTrain") },
        ]}
        error={errorAt(problem, "mode")}
        onChange={(mode) => onChange({ mode: mode as Mode })}
      />
    </>
  );
}

/** How several people judge; both can be changed while it runs. */
function TogetherChoices({ draft, problem, onChange }: Omit<BasicsProps, "catalogue">) {
  return (
    <>
      <Choice
        label={t("create.rule")}
        name="aggregation"
        value={draft.aggregation}
        hint={t(`together.rulesWhat.${draft.aggregation}`)}
        options={RULES.map((value) => ({ value, label: t(`together.rules.${value}`) }))}
        error={errorAt(problem, "aggregation")}
        onChange={(value) => onChange({ aggregation: value as Aggregation })}
      />
      <Choice
        label={t("together.least")}
        name="least"
        value={String(draft.least)}
        options={heads(draft.least)}
        onChange={(value) => onChange({ least: Number(value) })}
      />
      <Choice
        label={t("create.proposals")}
        name="parallel"
        value={draft.parallel ? "own" : "shared"}
        hint={t("create.proposalsWhat")}
        options={[
          { value: "shared", label: t("together.shared") },
          { value: "own", label: t("together.own") },
        ]}
        error={errorAt(problem, "together")}
        onChange={(value) => onChange({ parallel: value === "own" })}
      />
    </>
  );
}
