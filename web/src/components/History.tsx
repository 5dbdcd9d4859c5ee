// The newest proposals as a strip of pictures with one's own labels; a press opens one, to look again or to correct.
import { type ReactNode, useState } from "react";
import { at } from "../base";
import { type Entry, FILTERS, type Filter, type History, shown } from "../history";
import { skillName, t, taskWords } from "../i18n";
import { signed } from "../i18n/numbers";
import type { Value, View } from "../wire";
import { Dialog } from "./Dialog";
import { Bolt, Cross, Dash, Eye, Tick, Warning } from "./icons";
import { OverlayDrawing } from "./OverlayDrawing";

export const LABELS = [
  { value: -1, key: "bad", Icon: Cross },
  { value: 0, key: "neutral", Icon: Dash },
  { value: 1, key: "good", Icon: Tick },
  { value: "cant_tell", key: "cantTell", Icon: Eye },
] as const;

export function labelKey(value: Value | undefined): "bad" | "neutral" | "good" | "cantTell" | "none" {
  return LABELS.find((each) => each.value === value)?.key ?? "none";
}

/** Marks belong to their picture: until it is there, and while an earlier one is still shown, there are none. */
function useLoaded({ url }: View): [boolean, () => void] {
  const [loaded, setLoaded] = useState<string | null>(null);
  return [loaded === url, () => setLoaded(url)];
}

/** The camera's picture alone; what is drawn on it waits until it has come. */
function Still({ view, onLoad }: { view: View; onLoad: () => void }) {
  const { url, width, height } = view;
  return (
    <img src={at(url)} alt="" loading="lazy" decoding="async" width={width} height={height} onLoad={onLoad} />
  );
}

export function Picture(props: { view: View; judged?: boolean; overlay?: boolean }) {
  const { view, judged, overlay = true } = props;
  const [loaded, setLoaded] = useLoaded(view);
  return (
    <div className="pictured" style={{ aspectRatio: `${view.width} / ${view.height}` }}>
      <Still view={view} onLoad={setLoaded} />
      {overlay && loaded && (
        <OverlayDrawing
          overlay={view.overlay}
          width={view.width}
          height={view.height}
          judged={judged ?? false}
          ghost={false}
        />
      )}
    </div>
  );
}

/** A thumbnail's marks: too small to be explained, so only the dot and the line. */
export function Thumb({ view }: { view: View }) {
  const { dot, line } = view.overlay;
  const [loaded, setLoaded] = useLoaded(view);
  return (
    <>
      <Still view={view} onLoad={setLoaded} />
      <svg
        style={{ visibility: loaded ? undefined : "hidden" }}
        viewBox={`0 0 ${view.width} ${view.height}`}
        aria-hidden="true"
      >
        {line && (
          <path
            className="mark"
            d={`M${line[0]}L${line[1]}`}
            stroke="var(--overlay-light)"
            strokeWidth={14}
            vectorEffect="none"
          />
        )}
        {dot && (
          <>
            <circle cx={dot[0]} cy={dot[1]} r={34} fill="var(--overlay-light)" />
            <circle cx={dot[0]} cy={dot[1]} r={24} fill="var(--overlay-dot)" />
          </>
        )}
      </svg>
    </>
  );
}

function Item({ entry, onOpen }: { entry: Entry; onOpen: () => void }) {
  const { proposal, own, execution } = entry;
  const [view] = proposal.views;
  const label = labelKey(own?.label);
  const Icon = LABELS.find(({ key }) => key === label)?.Icon;
  const violated = (execution?.violations.length ?? 0) > 0;
  const words = [
    t("history.item", { number: proposal.number, skill: skillName(proposal.skill) }),
    label === "none" ? t("history.unjudged") : t(`judge.word.${label}`),
    execution ? t("history.executed") : "",
    violated ? t("history.violation") : "",
  ];
  return (
    <li>
      <button
        type="button"
        className="past"
        data-label={label}
        data-testid="past"
        data-id={proposal.id}
        aria-label={words.filter(Boolean).join(", ")}
        onClick={onOpen}
      >
        <span className="thumb">{view && <Thumb view={view} />}</span>
        <span className="said" aria-hidden="true">
          {Icon ? <Icon /> : <span className="dot" />}
          <span>{proposal.number}</span>
          {execution && (violated ? <Warning /> : <Bolt />)}
        </span>
      </button>
    </li>
  );
}

export interface HistoryProps {
  history: History;
  onRelabel: (feedbackId: number, value: Value) => void;
  /** What an operator may do beside with a past proposal. */
  more?: (proposalId: number) => ReactNode;
}

export function HistoryStrip({ history, onRelabel, more }: HistoryProps) {
  const [filter, setFilter] = useState<Filter>("all");
  const [openId, setOpenId] = useState<number | null>(null);
  const past = history.filter(({ proposal }) => proposal.closed_at);
  const items = shown(past, filter);
  const open = past.find(({ proposal }) => proposal.id === openId);
  return (
    <section className="card history" aria-label={t("history.title")} data-testid="history">
      <div className="with-action">
        <h2>{t("history.title")}</h2>
        <fieldset className="filters" aria-label={t("history.filter")}>
          {FILTERS.map((each) => (
            <button
              key={each}
              type="button"
              aria-pressed={filter === each}
              data-testid={`filter-${each}`}
              onClick={() => setFilter(each)}
            >
              {t(`history.filter_${each}`)}
            </button>
          ))}
        </fieldset>
      </div>
      {items.length === 0 ? (
        <p className="empty-strip">{past.length === 0 ? t("history.empty") : t("history.noneSuch")}</p>
      ) : (
        <ul className="strip">
          {items.map((entry) => (
            <Item key={entry.proposal.id} entry={entry} onOpen={() => setOpenId(entry.proposal.id)} />
          ))}
        </ul>
      )}
      {open && (
        <Past
          entry={open}
          onRelabel={onRelabel}
          more={more?.(open.proposal.id)}
          onClose={() => setOpenId(null)}
        />
      )}
    </section>
  );
}

function Past(props: {
  entry: Entry;
  onRelabel: HistoryProps["onRelabel"];
  more: ReactNode;
  onClose: () => void;
}) {
  const { proposal, own, execution } = props.entry;
  const relabel = (value: Value) => {
    if (own && own.label !== value) props.onRelabel(own.id, value);
    props.onClose();
  };
  return (
    <Dialog
      title={t("history.item", { number: proposal.number, skill: skillName(proposal.skill) })}
      wide
      onClose={props.onClose}
    >
      <div className="pictures">
        {proposal.views.map((view) => (
          <Picture key={view.camera} view={view} />
        ))}
      </div>
      <p className="soft">
        {[
          taskWords(proposal.subgoal ?? ""),
          t("history.expected", { value: signed(proposal.predicted_feedback) }),
          execution?.outcome ? t(`history.outcome_${execution.outcome}`) : "",
          ...(execution?.violations.map(({ detail }) => t("notice.violation", { violation: detail })) ?? []),
        ]
          .filter(Boolean)
          .join(" · ")}
      </p>
      {own ? (
        <fieldset className="relabel" aria-label={t("history.relabel")}>
          <legend className="soft">{t("history.relabelWhat")}</legend>
          {LABELS.map(({ value, key, Icon }) => (
            <button
              key={key}
              type="button"
              className={`button ${key}`}
              aria-pressed={own.label === value}
              data-testid={`relabel-${key}`}
              onClick={() => relabel(value)}
            >
              <Icon />
              {t(`judge.${key}`)}
            </button>
          ))}
        </fieldset>
      ) : (
        <p className="hint">{t("history.notYours")}</p>
      )}
      {props.more}
      <div className="actions">
        <button type="button" className="button" onClick={props.onClose} data-first>
          {t("common.close")}
        </button>
      </div>
    </Dialog>
  );
}
