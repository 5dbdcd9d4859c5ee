// An experiment's tags: shown as chips that narrow the list, and edited in place.
import { type FormEvent, useRef, useState } from "react";
import * as http from "../http";
import { t } from "../i18n";
import type { Experiment, Problem } from "../wire";
import { Plus } from "./icons";

export interface TagsProps {
  experiment: Experiment;
  /** Suggested while one is written. */
  known: string[];
  onChanged: () => void;
  onProblem: (problem: Problem | null) => void;
  onChoose?: (tag: string) => void;
}

export function Tags({ experiment, known, onChanged, onProblem, onChoose }: TagsProps) {
  const [editing, setEditing] = useState(false);
  const opener = useRef<HTMLButtonElement>(null);
  const save = async (tags: string[]) => {
    try {
      await http.setTags(experiment.id, tags);
      onProblem(null);
    } catch (error) {
      onProblem(http.problemOf(error));
    }
    onChanged();
  };
  const done = () => {
    setEditing(false);
    requestAnimationFrame(() => opener.current?.focus());
  };
  return (
    <ul className="tags" aria-label={t("tags.of", { name: experiment.name })} data-testid="tags">
      {experiment.tags.map((tag) => (
        <li key={tag} className="tag">
          {onChoose ? (
            <button type="button" onClick={() => onChoose(tag)} aria-label={t("tags.narrow", { tag })}>
              {tag}
            </button>
          ) : (
            <span>{tag}</span>
          )}
          {editing && (
            <button
              type="button"
              className="off"
              aria-label={t("tags.remove", { tag })}
              onClick={() => void save(experiment.tags.filter((each) => each !== tag))}
            >
              ×
            </button>
          )}
        </li>
      ))}
      <li>
        {editing ? (
          <NewTag
            id={experiment.id}
            known={known}
            onAdd={(tag) => void save([...experiment.tags, tag])}
            onDone={done}
          />
        ) : (
          <button
            ref={opener}
            type="button"
            className="tag add"
            data-testid="edit-tags"
            aria-label={t("tags.edit", { name: experiment.name })}
            onClick={() => setEditing(true)}
          >
            <Plus />
            {experiment.tags.length === 0 && t("tags.add")}
          </button>
        )}
      </li>
    </ul>
  );
}

function NewTag(props: { id: number; known: string[]; onAdd: (tag: string) => void; onDone: () => void }) {
  const [text, setText] = useState("");
  const add = (event: FormEvent) => {
    event.preventDefault();
    if (text.trim()) props.onAdd(text.trim());
    else props.onDone();
    setText("");
  };
  const list = `known-tags-${props.id}`;
  return (
    <form className="new-tag" onSubmit={add}>
      <input
        // biome-ignore lint/a11y/noAutofocus: it takes the place of the button that was pressed for it
        autoFocus
        value={text}
        maxLength={40}
        list={list}
        aria-label={t("tags.new")}
        placeholder={t("tags.new")}
        onChange={(event) => setText(event.target.value.replace(/,/g, ""))}
        onKeyDown={(event) => {
          if (event.key === "Escape") props.onDone();
        }}
      />
      <datalist id={list}>
        {props.known.map((tag) => (
          <option key={tag} value={tag} />
        ))}
      </datalist>
      <button type="button" className="button quiet" onClick={props.onDone}>
        {t("common.done")}
      </button>
    </form>
  );
}
