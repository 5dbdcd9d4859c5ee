// What the service says in English, in the reader's language: each sentence is looked up by what is the same in it.
//
// The section `said` of a language has the service's sentences, with blanks for what differs. What isn't there, and
// everything in English, stays as the service said it.
import type { Problem } from "../wire";
import { FALLBACK, known, language, t } from "./index";
import en from "./locales/en.json";

type Key = keyof typeof en.said;

interface Sentence {
  key: Key;
  blanks: string[];
  pattern: RegExp;
}

/** The keys are known, but which blanks each has is not a matter of types. */
const filled = t as unknown as (key: string, blanks: Record<string, string>) => string;
const BLANK = /{{(\w+)}}/g;
let sentences: Sentence[] | null = null;

/** Those with most letters of their own first: a blank takes in anything. */
function all(): Sentence[] {
  const own = (text: string) => text.replace(BLANK, "").length;
  sentences ??= Object.entries(en.said)
    .filter(([key]) => !key.startsWith("fields_"))
    .sort(([, one], [, other]) => own(other) - own(one))
    .map(([key, text]) => ({
      key: key as Key,
      blanks: [...text.matchAll(BLANK)].map(([, name]) => String(name)),
      pattern: new RegExp(
        `^${text
          .split(BLANK)
          .map((part, index) => (index % 2 ? "(.+?)" : part.replace(/[.*+?^${}()|[\]\\]/g, "\\$&")))
          .join("")}$`,
        "s",
      ),
    }));
  return sentences;
}

/** A name that the service uses, or several of them, as the page calls them. */
function word(text: string): string {
  return text
    .split(", ")
    .map((each) => (known(`saidWord.${each}`) ? t(`saidWord.${each as "good"}`) : each))
    .join(", ");
}

export function said(text: string): string {
  if (language() === FALLBACK) return text;
  for (const { key, blanks, pattern } of all()) {
    const found = pattern.exec(text);
    if (!found) continue;
    const values = blanks.map((name, index) => [name, word(said(found[index + 1] ?? ""))] as const);
    return filled(`said.${key}`, Object.fromEntries(values));
  }
  return text;
}

/** As sentences stand in a text: the service's begin small and have no full stop. */
export function sentence(text: string): string {
  const begun = text.replace(/(^|[.!?] )(\p{Ll})/gu, (start) => start.toUpperCase());
  return begun === "" || /[.!?…:]$/.test(begun) ? begun : `${begun}.`;
}

/** Which field is wrong, and how; the others are counted. */
function detailOf(problem: Problem): string {
  const [first, ...more] = problem.fields ?? [];
  if (!first || !problem.detail.startsWith(`${first.field}: `)) return sentence(said(problem.detail));
  const blanks = { field: first.field, message: said(first.message), count: more.length };
  const text = more.length > 0 ? t("said.fields_more", blanks) : t("said.fields_first", blanks);
  return text.endsWith(".") ? text : `${text}.`;
}

/** A problem of the service in the reader's language; what it says of its own status too. */
export function inWords(problem: Problem): Problem {
  const title = `problem.title_${problem.status}`;
  return {
    ...problem,
    title: known(title) ? t(title as "problem.title_404") : problem.title,
    detail: detailOf(problem),
    remedy: sentence(said(problem.remedy)),
    fields: (problem.fields ?? []).map((each) => ({ ...each, message: said(each.message) })),
  };
}

export function inOneLine(problem: Problem): string {
  const { detail, remedy } = inWords(problem);
  return `${detail} ${remedy}`;
}
