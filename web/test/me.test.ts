// Who this page's trainer is: who signed in, or, where nobody does, the name that was said here.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";

const answering = (body: unknown) =>
  vi.stubGlobal(
    "fetch",
    vi.fn(async () => Response.json(body)),
  );

describe("who sits here", () => {
  beforeEach(() => {
    vi.resetModules();
    localStorage.setItem("seed.trainer", "ann");
  });
  afterEach(() => {
    vi.unstubAllGlobals();
    localStorage.clear();
  });

  it("is who signed in, whatever name was said here before", async () => {
    answering({ login: true, name: "bob", role: "trainer" });
    const me = await import("../src/me");
    await me.findOut();
    expect([me.ME, me.ROLE, me.LOGIN]).toEqual(["bob", "trainer", true]);
    const { asked } = await import("../src/together");
    const { experiment, proposal } = await import("./messages");
    const rule = experiment({ aggregation: "majority" });
    expect(asked(proposal(1, { electorate: ["bob"] }), rule, [])).toBe(true);
    expect(asked(proposal(1, { electorate: ["ann"] }), rule, [])).toBe(false);
  });

  it("is the name that was said, where nobody signs in or the service doesn't answer", async () => {
    answering({ login: false, name: "local", role: "owner" });
    const me = await import("../src/me");
    await me.findOut();
    expect([me.ME, me.LOGIN]).toEqual(["ann", false]);
    vi.stubGlobal(
      "fetch",
      vi.fn(async () => Promise.reject(new TypeError())),
    );
    await me.findOut();
    expect(me.ME).toBe("ann");
  });

  it("begins anew once somebody else has signed in, in another tab, and also once it hears of a login", async () => {
    const reload = vi.spyOn(location, "reload").mockImplementation(() => undefined);
    answering({ login: true, name: "ann", role: "trainer" });
    const me = await import("../src/me");
    await me.findOut();
    expect(await me.stillMe()).toBe(true);
    vi.stubGlobal(
      "fetch",
      vi.fn(async () => Promise.reject(new TypeError())),
    );
    await expect(me.stillMe()).rejects.toThrow();
    expect(reload).not.toHaveBeenCalled();
    answering({ login: true, name: "bob", role: "trainer" });
    expect(await me.stillMe()).toBe(false);
    expect(reload).toHaveBeenCalledOnce();

    vi.resetModules();
    const unanswered = await import("../src/me");
    expect(await unanswered.stillMe()).toBe(false);
    expect(reload).toHaveBeenCalledTimes(2);
    answering({ login: false, name: "local", role: "owner" });
    expect(await unanswered.stillMe()).toBe(true);
  });
});
