// What the critic thinks: the predicted feedback all over the table for one skill, in the situation of one proposal.

import { useEffect, useState } from "react";
import { CriticPicture } from "../components/CriticPicture";
import { ExperimentTabs } from "../components/ExperimentTabs";
import { Header } from "../components/Header";
import { Picture } from "../components/History";
import { Sprout } from "../components/icons";
import { ProblemBanner } from "../components/ProblemBanner";
import { ProblemCard } from "../components/ProblemCard";
import * as http from "../http";
import { skillName, t } from "../i18n";
import { decimal } from "../i18n/numbers";
import { Link, setSearch, useSearch } from "../router";
import { useTask } from "../useCatalogue";
import { useDelayed } from "../useDelayed";
import type { CriticMap, Experiment, HistoryEntry, Problem, TaskInfo } from "../wire";

type Others = Record<string, number>;

function useCritic(proposal: number | null, skill: string, others: Others) {
  const [told, setTold] = useState<{ map: CriticMap | null; problem: Problem | null; busy: boolean }>({
    map: null,
    problem: null,
    busy: false,
  });
  const query = useDelayed(JSON.stringify([proposal, skill, others]));
  useEffect(() => {
    const [id, which, held] = JSON.parse(query) as [number | null, string, Others];
    if (id === null) return;
    let gone = false;
    setTold((before) => ({ ...before, busy: true }));
    http.critic(id, which, held).then(
      (map) => gone || setTold({ map, problem: null, busy: false }),
      (error: unknown) => gone || setTold({ map: null, problem: http.problemOf(error), busy: false }),
    );
    return () => {
      gone = true;
    };
  }, [query]);
  return told;
}

/** The experiment and its newest closed proposals, of which one is the situation. */
function useSituations(id: number) {
  const [experiment, setExperiment] = useState<Experiment | null>(null);
  const [entries, setEntries] = useState<HistoryEntry[] | null>(null);
  const [problem, setProblem] = useState<Problem | null>(null);
  useEffect(() => {
    Promise.all([http.experiment(id), http.told(id, "purpose=training", null)]).then(
      ([found, page]) => {
        setExperiment(found);
        setEntries(page.items);
      },
      (error: unknown) => setProblem(http.problemOf(error)),
    );
  }, [id]);
  return { experiment, entries, problem };
}

/** Skills that have a place on the table. */
const placed = (task: TaskInfo | null) =>
  (task?.skills ?? []).filter(({ parameters }) =>
    ["x", "y"].every((axis) => parameters.some(({ name }) => name === axis)),
  );

export function CriticPage({ id }: { id: number }) {
  const { experiment, entries, problem } = useSituations(id);
  const task = useTask(experiment?.task);
  useEffect(() => {
    document.title = `${t("nav.critic")} · SEED`;
  }, []);
  if (problem) return <ProblemCard problem={problem} />;
  return (
    <>
      <Header back />
      <main className="page" data-testid="critic">
        <div className="title-row">
          <h1 className="title-text">{experiment?.name ?? t("common.loading")}</h1>
        </div>
        <ExperimentTabs id={id} here="critic" />
        {!entries && <div className="skeleton tall" role="status" aria-label={t("common.loading")} />}
        {entries?.length === 0 && (
          <div className="empty">
            <Sprout />
            <h2>{t("critic.empty")}</h2>
            <p>{t("critic.emptyWhat")}</p>
            <Link to={`/experiments/${id}`} className="button primary">
              {t("nav.judge")}
            </Link>
          </div>
        )}
        {entries && entries.length > 0 && task && <Looking entries={entries} task={task} />}
      </main>
    </>
  );
}

function Looking({ entries, task }: { entries: HistoryEntry[]; task: TaskInfo }) {
  const query = new URLSearchParams(useSearch());
  const entry =
    entries.find(({ proposal }) => String(proposal.number) === query.get("proposal")) ?? entries[0];
  const skills = placed(task);
  const proposed = skills.find(({ name }) => name === entry?.proposal.skill);
  const skill = skills.find(({ name }) => name === query.get("skill")) ?? proposed ?? skills[0];
  const [others, setOthers] = useState<Others>({});
  const [all, setAll] = useState(false);
  const { map, problem, busy } = useCritic(entry?.proposal.id ?? null, skill?.name ?? "", others);
  const choose = (key: string, value: string) => {
    query.set(key, value);
    setSearch(query);
    setOthers({});
  };
  if (!entry || !skill) return <p className="empty-chart card">{t("critic.noPlace")}</p>;
  const { proposal } = entry;
  return (
    <div className="critic">
      <section className="card" aria-label={t("critic.title")} aria-busy={busy}>
        <div className="list-tools">
          <select
            aria-label={t("gallery.skill")}
            value={skill.name}
            data-testid="critic-skill"
            onChange={(event) => choose("skill", event.target.value)}
          >
            {skills.map(({ name }) => (
              <option key={name} value={name}>
                {skillName(name)}
              </option>
            ))}
          </select>
          <select
            aria-label={t("critic.situation")}
            value={proposal.number}
            data-testid="critic-proposal"
            onChange={(event) => choose("proposal", event.target.value)}
          >
            {entries.map(({ proposal: each }) => (
              <option key={each.id} value={each.number}>
                {t("critic.situationOf", { number: each.number, skill: skillName(each.skill) })}
              </option>
            ))}
          </select>
          <label className="switch">
            <input type="checkbox" checked={all} onChange={(event) => setAll(event.target.checked)} />
            {t("critic.all")}
          </label>
        </div>
        {problem && <ProblemBanner problem={problem} testId="critic-problem" />}
        {!map && !problem && <div className="skeleton tall" role="status" aria-label={t("critic.asking")} />}
        {map && <CriticPicture map={map} proposal={proposal} scene={task.scene} all={all} />}
        {map && (
          <Held
            map={map}
            skill={skill}
            onChange={(name, value) => setOthers({ ...map.others, [name]: value })}
          />
        )}
      </section>
      <aside className="card critic-side" aria-label={t("critic.situation")}>
        <h2>{t("critic.situation")}</h2>
        {proposal.views.map((view) => (
          <Picture key={view.camera} view={view} />
        ))}
        {map && (
          <p className="soft small" data-testid="critic-source">
            {t(`critic.from_${map.source}`, { version: map.policy_version })}
          </p>
        )}
        <p className="soft small">{t("critic.legend")}</p>
      </aside>
    </div>
  );
}

interface HeldProps {
  map: CriticMap;
  skill: TaskInfo["skills"][number];
  onChange: (name: string, value: number) => void;
}

/** What is the same all over the table. */
function Held({ map, skill, onChange }: HeldProps) {
  const held = skill.parameters.filter(({ name }) => name in map.others);
  return (
    <div className="held">
      {held.map(({ name, unit, low, high, description }) => {
        const value = map.others[name] ?? 0;
        return (
          <label key={name} title={description}>
            <code>{name}</code>
            <input
              type="range"
              min={low}
              max={high}
              step={(high - low) / 100 || 0.01}
              defaultValue={value}
              key={`${map.skill} ${map.proposal_id}`}
              data-testid={`held-${name}`}
              onChange={(event) => onChange(name, Math.min(high, Math.max(low, Number(event.target.value))))}
            />
            <span className="number">{`${decimal(value, 3)} ${unit}`}</span>
          </label>
        );
      })}
    </div>
  );
}
