import { beforeEach, describe, expect, it } from "vitest";
import { newId } from "../src/ids";
import { Outbox } from "../src/outbox";

const click = (id: string) => ({ click_id: id, proposal_id: 7, value: -1 as const });
const anns = (id: string) => ({ ...click(id), trainer: "ann" });
const ids = (outbox: Outbox) => outbox.all().map(({ click_id }) => click_id);

describe("outbox", () => {
  beforeEach(() => localStorage.clear());

  it("keeps clicks across a reload until they are acknowledged", () => {
    const before = new Outbox(1, "ann", localStorage);
    before.add(click("a"));
    before.add(click("b"));
    const reloaded = new Outbox(1, "ann", localStorage);
    expect(ids(reloaded)).toEqual(["a", "b"]);
    reloaded.remove("a");
    expect(new Outbox(1, "ann", localStorage).all()).toEqual([anns("b")]);
  });

  it("keeps experiments apart", () => {
    new Outbox(1, "ann", localStorage).add(click("a"));
    expect(new Outbox(2, "ann", localStorage).all()).toEqual([]);
  });

  it("keeps each one's clicks for them, whoever sits there meanwhile", () => {
    new Outbox(1, "ann", localStorage).add(click("a"));
    const bobs = new Outbox(1, "bob", localStorage);
    expect(bobs.all()).toEqual([]);
    bobs.add(click("b"));
    bobs.remove("b");
    expect(new Outbox(1, "ann", localStorage).all()).toEqual([anns("a")]);
    expect(ids(new Outbox(1, "bob", localStorage))).toEqual([]);
  });

  it("gives what a page of before the upgrade kept, without a name, to the first who comes, and to nobody else", () => {
    localStorage.setItem("seed.outbox.1", JSON.stringify([click("a"), { ...click("b"), trainer: "bob" }]));
    const outbox = new Outbox(1, "ann", localStorage);
    expect(outbox.all()).toEqual([]); // until she is known to be a trainer
    outbox.adopt();
    expect(outbox.all()).toEqual([anns("a")]);
    const bobs = new Outbox(1, "bob", localStorage);
    bobs.adopt();
    expect(ids(bobs)).toEqual(["b"]);
    expect(new Outbox(1, "ann", localStorage).all()).toEqual([anns("a")]);
  });

  it.each([
    "not json",
    "{}",
    '[{"click_id": 3}]',
    '[{"click_id":"a","proposal_id":1,"value":2}]',
    '[{"click_id":"a","proposal_id":1,"value":1,"trainer":2}]',
  ])("ignores rubbish in the storage: %s", (rubbish) => {
    localStorage.setItem("seed.outbox.1", rubbish);
    expect(new Outbox(1, "ann", localStorage).all()).toEqual([]);
  });

  it("still holds this tab's clicks where the storage is full", () => {
    const full: Storage = {
      length: 0,
      clear: () => undefined,
      key: () => null,
      getItem: () => null,
      removeItem: () => undefined,
      setItem: () => {
        throw new DOMException("full", "QuotaExceededError");
      },
    };
    const outbox = new Outbox(1, "ann", full);
    outbox.add(click("a"));
    expect(outbox.all()).toEqual([anns("a")]);
    outbox.remove("a");
    expect(outbox.all()).toEqual([]);
  });
});

describe("click ids", () => {
  it("are unique and fit the service's pattern", () => {
    const ids = new Set(Array.from({ length: 1000 }, newId));
    expect(ids.size).toBe(1000);
    for (const id of ids) expect(id).toMatch(/^[A-Za-z0-9_.:-]{8,64}$/);
  });
});
