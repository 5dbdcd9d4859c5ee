// A new experiment as it is being filled in, from nothing or from another one.
import type { Catalogue } from "./http";
import { t, taskWords } from "./i18n";
import { baseOf, differences, type Schema, settingsOf, type Values } from "./schemaForm";
import type { Aggregation, Experiment, ExperimentCreate, Mode, Problem } from "./wire";

export const PARTS = ["settings", "adapter_settings", "teacher_settings"] as const;
export type Part = (typeof PARTS)[number];

export interface Draft {
  name: string;
  task: string;
  adapter: string;
  algorithm: string;
  preset: string;
  teacher: string;
  mode: Mode;
  aggregation: Aggregation;
  /** Whether each trainer judges proposals of their own. */
  parallel: boolean;
  /** How many have to say good before the robot moves. */
  least: number;
  seed: string;
  seeds: string;
  num_envs: string;
  feedback_timeout: string;
  tags: string;
  /** What was changed by hand, part by part. */
  settings: Values;
  adapter_settings: Values;
  teacher_settings: Values;
}

const RECOMMENDED = "recommended";

export function firstDraft(catalogue: Catalogue): Draft {
  const task = catalogue.tasks.find((each) => each.name === "stacking") ?? catalogue.tasks[0];
  const algorithm = catalogue.algorithms.find((each) => each.name === "seed") ?? catalogue.algorithms[0];
  const fitting = catalogue.adapters.filter((each) => each.tasks.includes(task?.name ?? ""));
  const adapter = (fitting.find((each) => each.name === "robosuite") ?? fitting[0])?.name ?? "";
  return {
    name: task ? taskWords(task.title) : t("create.untitled"),
    task: task?.name ?? "",
    adapter,
    algorithm: algorithm?.name ?? "",
    preset: presetFor(catalogue, algorithm?.name ?? ""),
    teacher: "",
    mode: modeFor(catalogue, adapter),
    aggregation: "first",
    parallel: false,
    least: 1,
    seed: "0",
    seeds: "1",
    num_envs: "1",
    feedback_timeout: "",
    tags: "",
    settings: {},
    adapter_settings: {},
    teacher_settings: {},
  };
}

/** A real robot begins by proposing only, whatever was chosen for another. */
export function modeFor(catalogue: Catalogue, adapter: string): Mode {
  const real = catalogue.adapters.find((each) => each.name === adapter)?.simulated === false;
  return real ? "propose_only" : "execute_approved";
}

/** The preset to begin with. */
export function presetFor(catalogue: Catalogue, algorithm: string): string {
  const presets = catalogue.algorithms.find((each) => each.name === algorithm)?.presets ?? {};
  return RECOMMENDED in presets ? RECOMMENDED : "";
}

export function schemaOf(catalogue: Catalogue, draft: Draft, part: Part): Schema | undefined {
  const named = {
    settings: catalogue.algorithms.find((each) => each.name === draft.algorithm),
    adapter_settings: catalogue.adapters.find((each) => each.name === draft.adapter),
    teacher_settings: catalogue.teachers.find((each) => each.name === draft.teacher),
  };
  return named[part]?.settings_schema as Schema | undefined;
}

/** What the settings of a part are before anything is changed by hand. */
export function partBase(catalogue: Catalogue, draft: Draft, part: Part): Values {
  const presets = catalogue.algorithms.find((each) => each.name === draft.algorithm)?.presets ?? {};
  const preset = part === "settings" ? ((presets[draft.preset] as Values | undefined) ?? {}) : {};
  return baseOf(settingsOf(schemaOf(catalogue, draft, part)), preset);
}

/** Another experiment's draft: what it was told to be different from its preset is changed by hand here. */
export function cloneOf(catalogue: Catalogue, from: Experiment): Draft {
  const draft: Draft = {
    ...firstDraft(catalogue),
    name: t("create.copyOf", { name: from.name }).slice(0, 120),
    task: from.task,
    adapter: from.adapter,
    algorithm: from.algorithm,
    preset: from.preset ?? "",
    teacher: from.teacher ?? "",
    mode: modeFor(catalogue, from.adapter) === "propose_only" ? "propose_only" : from.mode,
    aggregation: from.aggregation,
    parallel: from.together.parallel,
    least: from.together.least,
    seed: String(from.seed),
    num_envs: String(from.num_envs),
    feedback_timeout: from.feedback_timeout === null ? "" : String(from.feedback_timeout),
    tags: from.tags.join(", "),
  };
  for (const part of PARTS) draft[part] = differences(from[part] as Values, partBase(catalogue, draft, part));
  return draft;
}

/** Numbers as numbers; what is none goes to the service as it is, which says at which field. */
function number(text: string): number {
  const value = Number(text);
  return (text.trim() !== "" && Number.isFinite(value) ? value : text) as number;
}

/** The bodies to send, one for each seed. Everything left out has its default in the service. */
export function bodiesOf(catalogue: Catalogue, draft: Draft): ExperimentCreate[] {
  const count = Math.min(Math.max(1, Math.trunc(Number(draft.seeds)) || 1), MOST_SEEDS);
  const first = number(draft.seed);
  return Array.from({ length: count }, (_, index) => {
    const seed = count > 1 ? Number(first) + index : first;
    return {
      name: count > 1 ? `${draft.name} · ${t("title.seed", { seed })}` : draft.name,
      task: draft.task,
      adapter: draft.adapter,
      algorithm: draft.algorithm,
      preset: draft.preset || null,
      teacher: draft.teacher || null,
      mode: draft.mode,
      aggregation: draft.aggregation,
      together: { parallel: draft.parallel && !draft.teacher, least: draft.teacher ? 1 : draft.least },
      seed,
      num_envs: number(draft.num_envs),
      feedback_timeout: draft.feedback_timeout.trim() === "" ? null : number(draft.feedback_timeout),
      tags: draft.tags
        .split(",")
        .map((tag) => tag.trim())
        .filter(Boolean),
      settings: differences(draft.settings, partBase(catalogue, draft, "settings")),
      adapter_settings: differences(draft.adapter_settings, partBase(catalogue, draft, "adapter_settings")),
      teacher_settings: draft.teacher
        ? differences(draft.teacher_settings, partBase(catalogue, draft, "teacher_settings"))
        : {},
    } as ExperimentCreate;
  });
}

export const MOST_SEEDS = 20;

/** The message for a field: `task`, `body.task`, `settings.batch_size`, or anything within it. */
export function errorAt(problem: Problem | null, path: string): string | undefined {
  const found = problem?.fields?.find(({ field }) => {
    const at = field.replace(/^body[./]/, "").replaceAll("/", ".");
    return at === path || at.startsWith(`${path}.`);
  });
  return found?.message;
}

/** Messages whose field isn't on the page. */
export function unplaced(problem: Problem | null, paths: string[]): string[] {
  return (problem?.fields ?? [])
    .filter((each) => !paths.some((path) => errorAt({ ...problem, fields: [each] } as Problem, path)))
    .map(({ field, message }) => `${field}: ${message}`);
}
