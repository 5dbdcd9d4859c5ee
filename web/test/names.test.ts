// A name that the page lets somebody go by is one that the service takes.
import { expect, it } from "vitest";
import { isName } from "../src/me";

it("a name is what the service takes from a person", () => {
  for (const name of ["Ann", "Critter", "Ann the trainer", "Teacher Ann", "日本"])
    expect(isName(name), name).toBe(true);
  for (const name of ["", "a".repeat(65), "a\tb"]) expect(isName(name), name).toBe(false);
  for (const name of ["teacher:ann", "Teacher: Ann", " critic", "trainers", "EVALUATION", "somebody-1a2b3c"])
    expect(isName(name), name).toBe(false);
});
