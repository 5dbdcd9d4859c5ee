import { beforeEach, describe, expect, it } from "vitest";
import { newId } from "../src/ids";
import { Outbox } from "../src/outbox";

const click = (id: string) => ({ click_id: id, proposal_id: 7, value: -1 as const });

describe("outbox", () => {
  beforeEach(() => localStorage.clear());

  it("keeps clicks across a reload until they are acknowledged", () => {
    const before = new Outbox(1, localStorage);
    before.add(click("a"));
    before.add(click("b"));
    const reloaded = new Outbox(1, localStorage);
    expect(reloaded.all().map((each) => each.click_id)).toEqual(["a", "b"]);
    reloaded.remove("a");
    expect(new Outbox(1, localStorage).all()).toEqual([click("b")]);
  });

  it("keeps experiments apart", () => {
    new Outbox(1, localStorage).add(click("a"));
    expect(new Outbox(2, localStorage).all()).toEqual([]);
  });

  it.each(["not json", "{}", '[{"click_id": 3}]', '[{"click_id":"a","proposal_id":1,"value":2}]'])(
    "ignores rubbish in the storage: %s",
    (rubbish) => {
      localStorage.setItem("seed.outbox.1", rubbish);
      expect(new Outbox(1, localStorage).all()).toEqual([]);
    },
  );

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
    const outbox = new Outbox(1, full);
    outbox.add(click("a"));
    expect(outbox.all()).toEqual([click("a")]);
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
