// What narrows the list of experiments: words, choices, tags; and its order where there are no columns to press.
import { useEffect, useRef, useState } from "react";
import type { Catalogue } from "../http";
import { t, taskWords } from "../i18n";
import { changed, NARROWING, type Narrowing, SORTS, STATES, sortOf, withoutTag, withTag } from "../listing";

const TYPING_MS = 250;

export interface ListToolsProps {
  listing: URLSearchParams;
  catalogue: Catalogue | null;
  tags: string[];
  onChange: (listing: URLSearchParams) => void;
}

function choicesOf(what: Narrowing, catalogue: Catalogue | null): { value: string; label: string }[] {
  if (what === "lifecycle") return STATES.map((value) => ({ value, label: t(`lifecycle.${value}`) }));
  if (what === "task")
    return (catalogue?.tasks ?? []).map(({ name, title }) => ({ value: name, label: taskWords(title) }));
  const items = (what === "adapter" ? catalogue?.adapters : catalogue?.algorithms) ?? [];
  return items.map(({ name }) => ({ value: name, label: name }));
}

export function ListTools({ listing, catalogue, tags, onChange }: ListToolsProps) {
  const { sort, order } = sortOf(listing);
  const chosen = listing.getAll("tag");
  return (
    <search className="list-tools" aria-label={t("list.narrow")}>
      <SearchBox listing={listing} onChange={onChange} />
      {NARROWING.map((what) => (
        <select
          key={what}
          aria-label={t(`list.${what}`)}
          data-testid={`narrow-${what}`}
          data-set={listing.has(what)}
          value={listing.get(what) ?? ""}
          onChange={(event) => onChange(changed(listing, what, event.target.value))}
        >
          <option value="">{t(`list.any_${what}`)}</option>
          {choicesOf(what, catalogue).map(({ value, label }) => (
            <option key={value} value={value}>
              {label}
            </option>
          ))}
        </select>
      ))}
      {tags.length > 0 && (
        <select
          aria-label={t("list.tag")}
          data-testid="narrow-tag"
          value=""
          onChange={(event) => event.target.value && onChange(withTag(listing, event.target.value))}
        >
          <option value="">{t("list.any_tag")}</option>
          {tags
            .filter((tag) => !chosen.includes(tag))
            .map((tag) => (
              <option key={tag} value={tag}>
                {tag}
              </option>
            ))}
        </select>
      )}
      <select
        className="sort-by"
        aria-label={t("list.order")}
        value={`${sort} ${order}`}
        onChange={(event) => {
          const [by = "", way = ""] = event.target.value.split(" ");
          onChange(changed(changed(listing, "sort", by), "order", way));
        }}
      >
        {SORTS.flatMap((each) =>
          (["desc", "asc"] as const).map((way) => (
            <option key={`${each} ${way}`} value={`${each} ${way}`}>
              {t("list.sorted", { by: t(`list.sort_${each}`), way: way === "desc" ? "↓" : "↑" })}
            </option>
          )),
        )}
      </select>
      {chosen.map((tag) => (
        <button
          key={tag}
          type="button"
          className="tag on"
          aria-label={t("tags.widen", { tag })}
          onClick={() => onChange(withoutTag(listing, tag))}
        >
          {tag} ×
        </button>
      ))}
    </search>
  );
}

function SearchBox({ listing, onChange }: Pick<ListToolsProps, "listing" | "onChange">) {
  const given = listing.get("text") ?? "";
  const [text, setText] = useState(given);
  const timer = useRef<ReturnType<typeof setTimeout>>(undefined);
  useEffect(() => {
    setText(given);
    return () => clearTimeout(timer.current);
  }, [given]);
  const type = (value: string) => {
    setText(value);
    clearTimeout(timer.current);
    timer.current = setTimeout(() => onChange(changed(listing, "text", value.trim())), TYPING_MS);
  };
  return (
    <input
      type="search"
      value={text}
      maxLength={120}
      data-testid="search"
      aria-label={t("list.search")}
      placeholder={t("list.search")}
      onChange={(event) => type(event.target.value)}
    />
  );
}
