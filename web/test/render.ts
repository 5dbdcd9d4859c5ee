// Puts an element on the page and lets React settle.
import { act, type ReactNode } from "react";
import { createRoot, type Root } from "react-dom/client";
import { afterEach } from "vitest";

Object.assign(globalThis, { IS_REACT_ACT_ENVIRONMENT: true });

let root: Root | null = null;

export async function show(element: ReactNode): Promise<void> {
  if (!root) {
    const box = document.createElement("div");
    box.id = "root";
    document.body.append(box);
    root = createRoot(box);
  }
  await act(async () => root?.render(element));
}

export async function press(
  key: string,
  more: KeyboardEventInit = {},
  target: EventTarget = window,
): Promise<void> {
  await act(async () => {
    target.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true, ...more }));
  });
}

export function byTestId(id: string): HTMLElement {
  const found = document.querySelector<HTMLElement>(`[data-testid="${id}"]`);
  if (!found) throw new Error(`nothing on the page has the test id ${id}`);
  return found;
}

afterEach(async () => {
  await act(async () => root?.unmount());
  root = null;
  document.body.replaceChildren();
});
