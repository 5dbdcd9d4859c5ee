// Every language has every word, every word is used, and no visible text is written into the code.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import ts from "typescript";
import { afterAll, describe, expect, it } from "vitest";
import { chooseLanguage, LANGUAGES, language, matching, nameOf, t, taskWords } from "../src/i18n";
import { decimal, percent, signed } from "../src/i18n/numbers";

const LOCALES = join("src", "i18n", "locales");

type Tree = { [key: string]: string | Tree };

function flat(tree: Tree, path = ""): Map<string, string> {
  const words = new Map<string, string>();
  for (const [key, value] of Object.entries(tree)) {
    const at = path ? `${path}.${key}` : key;
    if (typeof value === "string") words.set(at, value);
    else for (const [inner, text] of flat(value, at)) words.set(inner, text);
  }
  return words;
}

const read = (tag: string) => flat(JSON.parse(readFileSync(join(LOCALES, `${tag}.json`), "utf-8")) as Tree);
const singular = (key: string) => key.replace(/_(zero|one|two|few|many|other)$/, "");
const blanks = (text: string) => [...text.matchAll(/{{\s*(\w+)[^}]*}}/g)].map(([, name]) => name).sort();

function sources(folder: string): string[] {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) return sources(path);
    return /\.tsx?$/.test(entry.name) && entry.name !== "api.ts" ? [path] : [];
  });
}

const english = read("en");

afterAll(() => chooseLanguage("en"));

describe.each(LANGUAGES)("the words in %s", (tag) => {
  const words = read(tag);

  it("are complete", () => {
    const has = new Set([...words.keys()].map(singular));
    expect([...new Set([...english.keys()].map(singular))].filter((key) => !has.has(key))).toEqual([]);
    expect([...has].filter((key) => !english.has(key) && !english.has(`${key}_other`))).toEqual([]);
    expect([...words].filter(([, text]) => text.trim() === "").map(([key]) => key)).toEqual([]);
  });

  it("have every plural that the language needs", () => {
    const forms = new Intl.PluralRules(tag).resolvedOptions().pluralCategories;
    const counted = new Set([...words.keys()].filter((key) => singular(key) !== key).map(singular));
    const missing = [...counted]
      .flatMap((key) => forms.map((form) => `${key}_${form}`))
      .filter((key) => !words.has(key));
    expect(missing).toEqual([]);
  });

  it("fill in the same blanks as in English", () => {
    const wrong = [...words].filter(([key, text]) => {
      const model = english.get(key) ?? english.get(`${singular(key)}_other`) ?? "";
      return blanks(text).join() !== blanks(model).join();
    });
    expect(wrong.map(([key]) => key)).toEqual([]);
  });

  it("are sorted, so that two people who add some seldom meet", () => {
    const keys = Object.keys(JSON.parse(readFileSync(join(LOCALES, `${tag}.json`), "utf-8")) as Tree);
    expect(keys).toEqual([...keys].sort());
  });

  it("are named by the language itself", () => {
    expect(nameOf(tag)).not.toBe(tag);
  });
});

it("every word is used", () => {
  const code = sources("src")
    .map((path) => readFileSync(path, "utf-8"))
    .join("\n");
  const whole = new Set([...code.matchAll(/["'`]([a-z]\w*(?:\.\w+)+)["'`]/g)].map(([, key]) => key));
  // `studies.state.${state}`: whatever begins so is used
  const begun = [...code.matchAll(/`([a-z]\w*\.[\w.]*)\$\{/g)].map(([, start]) => String(start));
  const unused = [...english.keys()].filter(
    (key) => !whole.has(singular(key)) && !whole.has(key) && !begun.some((start) => key.startsWith(start)),
  );
  expect(unused).toEqual([]);
});

/** What a person sees or hears: text between tags, and these attributes. */
const SPOKEN = new Set([
  "aria-label",
  "aria-description",
  "aria-valuetext",
  "title",
  "placeholder",
  "alt",
  "label",
]);
/** The product's own name, units and signs are the same in every language. */
const NAMES = new Set(["SEED", "Ĥ", "Esc Esc", "U"]);

function written(text: string): boolean {
  return /\p{L}{2,}/u.test(text) && !NAMES.has(text.trim());
}

function literalsIn(node: ts.Node): string[] {
  if (ts.isStringLiteral(node) || ts.isNoSubstitutionTemplateLiteral(node)) return [node.text];
  if (ts.isTemplateExpression(node))
    return [node.head.text, ...node.templateSpans.map((span) => span.literal.text)];
  if (ts.isConditionalExpression(node)) return [...literalsIn(node.whenTrue), ...literalsIn(node.whenFalse)];
  if (ts.isBinaryExpression(node)) {
    if (!["+", "||", "??", "&&"].includes(node.operatorToken.getText())) return [];
    return [...literalsIn(node.left), ...literalsIn(node.right)];
  }
  if (ts.isParenthesizedExpression(node)) return literalsIn(node.expression);
  return [];
}

function toTheConsole(node: ts.Node): boolean {
  if (ts.isNewExpression(node)) return node.expression.getText().endsWith("Error");
  return ts.isCallExpression(node) && node.expression.getText().startsWith("console.");
}

/** "Two words" and more, which begin as a sentence does. */
function sentencesIn(node: ts.Node): string[] {
  if (
    !ts.isStringLiteral(node) &&
    !ts.isTemplateExpression(node) &&
    !ts.isNoSubstitutionTemplateLiteral(node)
  )
    return [];
  return /^\p{Lu}\p{Ll}*['’]?\p{Ll}* \p{Ll}/u.test(node.getText().slice(1)) ? literalsIn(node) : [];
}

function visibleIn(path: string): string[] {
  const file = ts.createSourceFile(path, readFileSync(path, "utf-8"), ts.ScriptTarget.ES2022, true);
  const found: string[] = [];
  const note = (node: ts.Node, text: string) => {
    if (written(text))
      found.push(`${path}:${file.getLineAndCharacterOfPosition(node.getStart()).line + 1} ${text.trim()}`);
  };
  const inCode = (node: ts.Node): boolean =>
    ts.isJsxElement(node) && node.openingElement.tagName.getText() === "code";
  const visit = (node: ts.Node): void => {
    if (inCode(node)) return; // a command is the same in every language
    if (ts.isJsxText(node)) note(node, node.text);
    if (ts.isJsxExpression(node) && node.expression && !ts.isJsxAttribute(node.parent))
      for (const text of literalsIn(node.expression)) note(node, text);
    if (ts.isJsxAttribute(node) && SPOKEN.has(node.name.getText()) && node.initializer) {
      const value = ts.isJsxExpression(node.initializer) ? node.initializer.expression : node.initializer;
      for (const text of value ? literalsIn(value) : []) note(node, text);
    }
    // A sentence anywhere else ends on the page too, unless it goes to the browser's console.
    if (toTheConsole(node)) return;
    if (!ts.isJsxAttribute(node.parent ?? node)) for (const text of sentencesIn(node)) note(node, text);
    ts.forEachChild(node, visit);
  };
  visit(file);
  return [...new Set(found)];
}

it("no visible text is written into the code", () => {
  expect(sources("src").flatMap(visibleIn)).toEqual([]);
});

it("takes the reader's language, whatever their region", () => {
  expect(matching(["de-CH", "en"])).toBe("de");
  expect(matching(["tlh", "en-GB"])).toBe("en");
  expect(matching(["tlh"])).toBe("en");
});

it("is remembered and told to the browser", async () => {
  await chooseLanguage("de");
  expect(language()).toBe("de");
  expect(document.documentElement.lang).toBe("de");
  expect(localStorage.getItem("seed.language")).toBe("de");
  expect(t("judge.good")).toBe("Gut");
  expect(t("robots.wait", { count: 1 })).toBe("1 Vorschlag wartet");
  expect([decimal(0.15), percent(0.063, 1), signed(-0.5)]).toEqual(["0,15", "6,3 %", "−0,50"]);
});

it("says a task's own words in the reader's language, and a foreign task's as they are", async () => {
  await chooseLanguage("de");
  expect(taskWords("pick up the red block")).toBe("Nimm den roten Klotz auf");
  expect(taskWords("Move the gripper into the blue area.")).toContain("blauen Bereich");
  expect(taskWords("juggle three eggs")).toBe("juggle three eggs");
});
