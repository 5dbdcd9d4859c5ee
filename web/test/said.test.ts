// What the service says in English is told in the reader's language, with its numbers and names; what is new, as it came.
import { afterEach, expect, it } from "vitest";
import { chooseLanguage } from "../src/i18n";
import { inWords } from "../src/i18n/said";
import type { Problem } from "../src/wire";

afterEach(() => chooseLanguage("en"));

const problem = (by: Partial<Problem>): Problem => ({
  type: "/problems/conflict",
  title: "Conflict",
  status: 409,
  detail: "",
  remedy: "",
  fields: [],
  ...by,
});

it("fills the blanks of a sentence, and translates the names in them", async () => {
  await chooseLanguage("de");
  const told = inWords(
    problem({
      detail: "can't resume an experiment that is finished",
      remedy: "use one of: archive, halt",
    }),
  );
  expect(told.title).toBe("Das geht so nicht");
  expect(told.detail).toBe("Ein Experiment im Zustand „beendet“ nimmt „Fortsetzen“ nicht an.");
  expect(told.remedy).toBe("Möglich ist: Archivieren, Not-Halt.");
});

it("takes the sentence that has most in common, not the first one that fits", async () => {
  await chooseLanguage("de");
  expect(inWords(problem({ detail: "there is no study called 'x y'" })).detail).toBe(
    "Eine Studie namens 'x y' gibt es nicht.",
  );
  expect(inWords(problem({ detail: "there is no experiment 999999" })).detail).toBe(
    "Experiment 999999 gibt es nicht.",
  );
});

it("says why within a sentence, too", async () => {
  await chooseLanguage("de");
  const detail =
    "this click on proposal 7 is kept and decides nothing: another proposal, number 9, was approved first";
  expect(inWords(problem({ detail })).detail).toBe(
    "Dieser Klick auf Vorschlag 7 ist gespeichert und entscheidet nichts: Ein anderer Vorschlag, Nummer 9, wurde zuerst freigegeben.",
  );
});

it("names the field that is wrong", async () => {
  await chooseLanguage("de");
  const message = "Input should be greater than or equal to 4";
  const told = inWords(
    problem({
      status: 422,
      detail: `settings.batch_size: ${message} (and 1 more)`,
      remedy: "correct the named fields; /docs shows the schema",
      fields: [
        { field: "settings.batch_size", message },
        { field: "seed", message: "Field required" },
      ],
    }),
  );
  expect(told.detail).toBe("settings.batch_size: Mindestens 4 (und 1 weitere).");
  expect(told.fields?.map((each) => each.message)).toEqual(["Mindestens 4", "Fehlt"]);
});

it("leaves what no language knows, and everything in English, as the service said it", async () => {
  await chooseLanguage("de");
  expect(inWords(problem({ detail: "the moon is in the way", remedy: "wait" })).detail).toBe(
    "The moon is in the way.",
  );
  await chooseLanguage("en");
  const told = inWords(
    problem({ status: 404, detail: "there is no experiment 5", remedy: "re-arm it first" }),
  );
  expect([told.detail, told.remedy]).toEqual(["There is no experiment 5.", "Re-arm it first."]);
});
