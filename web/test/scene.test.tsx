// What the robot can't see, or what was moved since the picture, is told in the reader's language until it is over.
import { act } from "react";
import { afterEach, expect, it } from "vitest";
import { SceneNotice } from "../src/components/SceneNotice";
import { chooseLanguage } from "../src/i18n";
import { Telling } from "../src/telling";
import type { Telemetry } from "../src/wire";
import { byTestId, show } from "./render";

afterEach(() => chooseLanguage("en"));

const told = (by: Partial<Telemetry>): Telemetry => ({
  joints: [],
  joint_limits: [],
  gripper: null,
  opening: null,
  force: null,
  calibration: "measured",
  calibration_detail: "",
  scene: "clear",
  scene_detail: "",
  mode: "idle",
  words: "",
  ...by,
});

it("names what is hidden, and goes once it is seen", async () => {
  const telling = new Telling();
  await show(<SceneNotice telling={telling} robot={0} />);
  expect(document.querySelector("[data-testid=scene-notice]")).toBeNull();
  const detail = "not everything is in sight: block_b: not seen for 4 s";
  await act(async () => telling.tell(0, told({ scene: "unclear", scene_detail: detail })));
  expect(byTestId("scene-notice").getAttribute("role")).toBe("status");
  expect(byTestId("scene-notice").textContent).toContain(
    "Not everything is in sight: block_b: not seen for 4 s.",
  );
  await act(async () => telling.tell(0, told({})));
  expect(document.querySelector("[data-testid=scene-notice]")).toBeNull();
});

it("says it in German, what is filled in too", async () => {
  await chooseLanguage("de");
  const telling = new Telling();
  telling.tell(
    0,
    told({ scene: "unclear", scene_detail: "not everything is in sight: block_b: not seen for 4 s" }),
  );
  await show(<SceneNotice telling={telling} robot={0} />);
  expect(byTestId("scene-notice").textContent).toContain(
    "Nicht alles ist zu sehen: block_b: seit 4 s nicht gesehen.",
  );
  const moved = "block_b was moved by 30 mm since the picture was taken";
  await act(async () => telling.tell(0, told({ scene: "changed", scene_detail: moved })));
  expect(byTestId("scene-notice").textContent).toContain("Block_b wurde seit dem Bild um 30 mm bewegt.");
});
