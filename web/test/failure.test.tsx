// An experiment that failed says so at the top of its page, with what to do, and with the button that does it.
import { act } from "react";
import { expect, it } from "vitest";
import { activity } from "../src/activity";
import { TrainerTitle } from "../src/components/TrainerTitle";
import type { Session } from "../src/session";
import { initial, reduce } from "../src/state";
import type { Verb } from "../src/wire";
import { experiment, snapshot } from "./messages";
import { byTestId, show } from "./render";

const WHY = "the robot's process died 4 times within a minute. look at the server's log, then resume";

it("shows failure, remedy and the way on", async () => {
  const asked: Verb[] = [];
  const session = { act: async (verb: Verb) => void asked.push(verb) } as unknown as Session;
  const failed = experiment({ lifecycle: "failed", phase: "idle", failure: WHY });
  await show(<TrainerTitle experiment={failed} session={session} onAsk={() => undefined} />);
  expect(byTestId("failed").getAttribute("role")).toBe("alert");
  expect(byTestId("failed").textContent).toContain(
    "The robot's process died 4 times within a minute. Look at the server's log, then resume.",
  );
  const buttons = [...document.querySelectorAll<HTMLElement>("button")];
  // The service allows no other verb of the page's here.
  expect(buttons.map((button) => button.dataset.testid)).toEqual(["resume"]);
  expect(byTestId("failed").contains(buttons[0] ?? null)).toBe(true);
  await act(async () => byTestId("resume").click());
  expect(asked).toEqual(["resume"]);
  const state = reduce(initial, { kind: "event", event: snapshot({ experiment: failed }) });
  expect(activity(state, true).tone).toBe("stopped");
});

it("takes the message away once it runs again", async () => {
  const session = {} as Session;
  await show(<TrainerTitle experiment={experiment()} session={session} onAsk={() => undefined} />);
  expect(document.querySelector("[data-testid=failed]")).toBeNull();
});
