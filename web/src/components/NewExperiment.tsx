// The form of a new experiment. The service validates; its field errors are shown at their fields.

import { type FormEvent, useEffect, useState } from "react";
import * as http from "../http";
import { t } from "../i18n";
import { navigate } from "../router";
import type { ExperimentCreate, Mode, Problem } from "../wire";
import { Dialog } from "./Dialog";
import { Choice, Field } from "./Field";

type Draft = Pick<ExperimentCreate, "name" | "task" | "adapter" | "algorithm" | "mode"> & {
  preset: string;
  seed: string;
  num_envs: string;
  teacher: string;
};

function firstDraft(catalogue: http.Catalogue, count: number): Draft {
  const task = catalogue.tasks.find((each) => each.name === "stacking") ?? catalogue.tasks[0];
  const algorithm = catalogue.algorithms[0];
  const fitting = catalogue.adapters.filter((each) => each.tasks.includes(task?.name ?? ""));
  return {
    name: t("create.nameOf", { task: task?.title ?? t("create.untitled"), number: count + 1 }),
    task: task?.name ?? "",
    adapter: (fitting.find((each) => each.name === "robosuite") ?? fitting[0])?.name ?? "",
    algorithm: algorithm?.name ?? "",
    preset: "",
    seed: "0",
    num_envs: "1",
    mode: "execute_approved",
    teacher: "",
  };
}

function bodyOf(draft: Draft): ExperimentCreate {
  const { preset, seed, num_envs, teacher, ...rest } = draft;
  const body = {
    ...rest,
    preset: preset || null,
    seed: Number(seed),
    num_envs: Number(num_envs),
    teacher: teacher || null,
  };
  // Everything left out has its default in the service.
  return body as ExperimentCreate;
}

/** The message for a field, whichever way the service spells its path (`task`, `body.task`). */
function errorFor(problem: Problem | null, name: string): string | undefined {
  return problem?.fields?.find(({ field }) => field.split(/[./]/).includes(name))?.message;
}

function useCatalogue(): { catalogue: http.Catalogue | null; problem: Problem | null } {
  const [answer, setAnswer] = useState<{ catalogue: http.Catalogue | null; problem: Problem | null }>({
    catalogue: null,
    problem: null,
  });
  useEffect(() => {
    http.catalogue().then(
      (catalogue) => setAnswer({ catalogue, problem: null }),
      (error: unknown) => setAnswer({ catalogue: null, problem: http.problemOf(error) }),
    );
  }, []);
  return answer;
}

export function NewExperiment({ count, onClose }: { count: number; onClose: () => void }) {
  const { catalogue, problem } = useCatalogue();
  return (
    <Dialog title={t("create.title")} onClose={onClose}>
      {problem && <p className="error" role="alert">{`${problem.detail} ${problem.remedy}`}</p>}
      {!catalogue && !problem && (
        <p className="soft" role="status">
          {t("common.loading")}
        </p>
      )}
      {catalogue ? (
        <NewForm catalogue={catalogue} count={count} onClose={onClose} />
      ) : (
        <div className="actions">
          <button type="button" className="button" onClick={onClose}>
            {t("common.cancel")}
          </button>
        </div>
      )}
    </Dialog>
  );
}

function NewForm({
  catalogue,
  count,
  onClose,
}: {
  catalogue: http.Catalogue;
  count: number;
  onClose: () => void;
}) {
  const [draft, setDraft] = useState(() => firstDraft(catalogue, count));
  const [problem, setProblem] = useState<Problem | null>(null);
  const [busy, setBusy] = useState(false);
  const set = (change: Partial<Draft>) => setDraft((before) => ({ ...before, ...change }));
  const adapters = catalogue.adapters.filter((each) => each.tasks.includes(draft.task));
  const presets = Object.keys(
    catalogue.algorithms.find((each) => each.name === draft.algorithm)?.presets ?? {},
  );
  const error = (name: string) => errorFor(problem, name);
  const submit = async (event: FormEvent) => {
    event.preventDefault();
    setBusy(true);
    try {
      const made = await http.createExperiment(bodyOf(draft));
      navigate(`/experiments/${made.id}`);
    } catch (failure) {
      setProblem(http.problemOf(failure));
      setBusy(false);
    }
  };
  const names = (items: { name: string }[]) => items.map(({ name }) => ({ value: name, label: name }));
  return (
    <form className="form" onSubmit={submit} noValidate>
      <Field
        wide
        label={t("create.name")}
        name="name"
        value={draft.name}
        error={error("name")}
        onChange={(name) => set({ name })}
      />
      <Choice
        label={t("create.task")}
        name="task"
        value={draft.task}
        options={catalogue.tasks.map((each) => ({ value: each.name, label: each.title }))}
        error={error("task")}
        onChange={(task) => set({ task })}
      />
      <Choice
        label={t("create.adapter")}
        name="adapter"
        value={draft.adapter}
        options={names(adapters)}
        error={error("adapter")}
        onChange={(adapter) => {
          const real = adapters.find(({ name }) => name === adapter)?.simulated === false;
          set({ adapter, mode: real ? "propose_only" : "execute_approved" });
        }}
      />
      <Choice
        label={t("create.algorithm")}
        name="algorithm"
        value={draft.algorithm}
        options={names(catalogue.algorithms)}
        error={error("algorithm")}
        onChange={(algorithm) => set({ algorithm, preset: "" })}
      />
      <Choice
        label={t("create.preset")}
        name="preset"
        value={draft.preset}
        options={[
          { value: "", label: t("create.presetDefault") },
          ...presets.map((value) => ({ value, label: value })),
        ]}
        error={error("preset")}
        onChange={(preset) => set({ preset })}
      />
      <Choice
        label={t("create.judge")}
        name="teacher"
        value={draft.teacher}
        options={[
          { value: "", label: t("create.you") },
          ...catalogue.teachers.map(({ name }) => ({
            value: name,
            label: t("create.teacher", { teacher: name }),
          })),
        ]}
        error={error("teacher")}
        onChange={(teacher) => set({ teacher })}
      />
      <Field
        label={t("create.seed")}
        name="seed"
        value={draft.seed}
        numeric
        error={error("seed")}
        onChange={(seed) => set({ seed })}
      />
      <Field
        label={t("create.robots")}
        name="num_envs"
        value={draft.num_envs}
        numeric
        error={error("num_envs")}
        onChange={(num_envs) => set({ num_envs })}
      />
      <Choice
        wide
        label={t("create.approved")}
        name="mode"
        value={draft.mode ?? "execute_approved"}
        options={[
          { value: "execute_approved", label: t("create.executed") },
          { value: "propose_only", label: t("create.onlyTrain") },
        ]}
        error={error("mode")}
        onChange={(mode) => set({ mode: mode as Mode })}
      />
      {problem && !problem.fields?.length && (
        <p className="error wide" role="alert">{`${problem.detail} ${problem.remedy}`}</p>
      )}
      <div className="actions wide">
        <button type="button" className="button" onClick={onClose}>
          {t("common.cancel")}
        </button>
        <button type="submit" className="button primary" disabled={busy} data-testid="create">
          {t("create.submit")}
        </button>
      </div>
    </form>
  );
}
