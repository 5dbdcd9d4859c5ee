import { act } from "react";
import { describe, expect, it, vi } from "vitest";
import { Confirm } from "../src/components/Dialog";
import { JudgeBar, type JudgeBarProps } from "../src/components/JudgeBar";
import { ModeSwitch } from "../src/components/ModeSwitch";
import { StopButton } from "../src/components/StopButton";
import type { Value } from "../src/wire";
import { byTestId, press, show } from "./render";

function bar(change: Partial<JudgeBarProps> = {}): {
  judged: Value[];
  props: JudgeBarProps;
  undone: () => number;
} {
  const judged: Value[] = [];
  const onUndo = vi.fn();
  return {
    judged,
    undone: () => onUndo.mock.calls.length,
    props: {
      ready: true,
      chosen: null,
      canUndo: true,
      onJudge: (value) => judged.push(value),
      onUndo,
      ...change,
    },
  };
}

describe("judging by keys", () => {
  it.each([
    ["1", 1],
    ["2", 0],
    ["3", -1],
    ["ArrowRight", 1],
    ["ArrowDown", 0],
    ["ArrowLeft", -1],
    ["4", "cant_tell"],
    ["ArrowUp", "cant_tell"],
  ])("%s is %s", async (key, value) => {
    const { judged, props } = bar();
    await show(<JudgeBar {...props} />);
    await press(key);
    expect(judged).toEqual([value]);
  });

  it("ignores a key that is held down", async () => {
    const { judged, props } = bar();
    await show(<JudgeBar {...props} />);
    await press("1");
    for (let time = 0; time < 5; time += 1) await press("1", { repeat: true });
    expect(judged).toEqual([1]);
  });

  it("ignores keys typed into a field, and keys behind a dialog", async () => {
    const { judged, props } = bar();
    const question = { title: "Sure?", text: "", yes: "Yes", testId: "yes", act: () => undefined };
    await show(
      <>
        <JudgeBar {...props} />
        <input data-testid="field" />
      </>,
    );
    await press("1", {}, byTestId("field"));
    await show(
      <>
        <JudgeBar {...props} />
        <Confirm question={question} onClose={() => undefined} />
      </>,
    );
    await press("1");
    expect(judged).toEqual([]);
  });

  it.each(["radio", "range", "number"])("leaves a control of its own kind its keys: %s", async (type) => {
    const { judged, props } = bar();
    await show(
      <>
        <JudgeBar {...props} />
        <input type={type} data-testid="field" />
      </>,
    );
    for (const key of ["ArrowRight", "ArrowUp", "1"]) await press(key, {}, byTestId("field"));
    expect(judged).toEqual([]);
  });

  it("judges also while the mode switch has the focus, which needs no arrows itself", async () => {
    const { judged, props } = bar();
    const onChange = vi.fn();
    await show(
      <>
        <JudgeBar {...props} />
        <ModeSwitch mode="execute_approved" onChange={onChange} />
      </>,
    );
    expect(document.querySelector("input")).toBeNull();
    expect(byTestId("mode-execute_approved").getAttribute("aria-pressed")).toBe("true");
    await press("ArrowLeft", {}, byTestId("mode-execute_approved"));
    expect(judged).toEqual([-1]);
    expect(onChange).not.toHaveBeenCalled();
    await act(async () => byTestId("mode-propose_only").click());
    await act(async () => byTestId("mode-execute_approved").click()); // pressed already: nothing to ask
    expect(onChange.mock.calls).toEqual([["propose_only"]]);
    expect(judged).toEqual([-1]);
  });

  it("leaves the browser's own shortcuts alone", async () => {
    const { judged, props } = bar();
    await show(<JudgeBar {...props} />);
    await press("1", { ctrlKey: true });
    await press("ArrowLeft", { altKey: true });
    expect(judged).toEqual([]);
  });

  it("undoes with U and Ctrl-Z, only while that is possible", async () => {
    const { undone, props } = bar();
    await show(<JudgeBar {...props} />);
    await press("u");
    await press("z", { ctrlKey: true });
    await press("z");
    expect(undone()).toBe(2);
    for (const held of ["ctrlKey", "metaKey", "altKey"]) {
      await press("u", { [held]: true }); // shows the page's source, among others
      await press("Z", { [held]: true, shiftKey: true }); // brings back what was undone
    }
    expect(undone()).toBe(2);
    await show(<JudgeBar {...props} canUndo={false} />);
    await press("u");
    expect(undone()).toBe(2);
  });

  it("shows each key on its button", async () => {
    await show(<JudgeBar {...bar().props} />);
    expect(byTestId("good").textContent).toBe("Good→1");
    expect(byTestId("neutral").textContent).toBe("Neutral↓2");
    expect(byTestId("bad").textContent).toBe("Bad←3");
  });
});

describe("emergency stop", () => {
  it("is two presses of Esc, also while a dialog is open", async () => {
    const onStop = vi.fn();
    const question = { title: "Sure?", text: "", yes: "Yes", testId: "yes", act: () => undefined };
    const onClose = vi.fn();
    await show(
      <>
        <StopButton stopping={false} onStop={onStop} />
        <Confirm question={question} onClose={onClose} />
      </>,
    );
    await press("Escape", {}, byTestId("yes"));
    expect(onStop).not.toHaveBeenCalled();
    expect(onClose).toHaveBeenCalledOnce();
    await press("Escape");
    expect(onStop).toHaveBeenCalledOnce();
  });

  it("isn't one press of Esc held down", async () => {
    const onStop = vi.fn();
    await show(<StopButton stopping={false} onStop={onStop} />);
    await press("Escape");
    await press("Escape", { repeat: true });
    expect(onStop).not.toHaveBeenCalled();
  });

  it("stays clickable above an open dialog, which makes the page behind it inert", async () => {
    const onStop = vi.fn();
    const question = { title: "Sure?", text: "", yes: "Yes", testId: "yes", act: () => undefined };
    await show(
      <>
        <StopButton stopping={false} onStop={onStop} />
        <Confirm question={question} onClose={() => undefined} />
      </>,
    );
    expect(document.getElementById("root")?.hasAttribute("inert")).toBe(true);
    expect(byTestId("halt").closest("[inert]")).toBeNull();
    await act(async () => byTestId("halt").click());
    expect(onStop).toHaveBeenCalledOnce();
  });
});
