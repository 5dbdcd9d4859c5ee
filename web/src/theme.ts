// Light or dark: as the device says, or as chosen in this browser; and the theme's colours for what isn't styled by CSS.
import { useSyncExternalStore } from "react";

export type Theme = "system" | "light" | "dark";
export const THEMES: Theme[] = ["system", "light", "dark"];

const KEPT = "seed.theme";
const listeners = new Set<() => void>();
const device = () => matchMedia("(prefers-color-scheme: light)");

export function theme(): Theme {
  const chosen = document.documentElement.dataset.theme;
  return chosen === "light" || chosen === "dark" ? chosen : "system";
}

export function chooseTheme(chosen: Theme): void {
  try {
    localStorage.setItem(KEPT, chosen);
  } catch {
    // Without storage the choice lasts as long as the page.
  }
  apply(chosen);
}

/** The theme chosen here before. */
export function startTheme(): void {
  try {
    apply(localStorage.getItem(KEPT));
  } catch {
    // As above: the device decides.
  }
}

function apply(chosen: string | null): void {
  if (chosen === "light" || chosen === "dark") document.documentElement.dataset.theme = chosen;
  else delete document.documentElement.dataset.theme;
  for (const listener of listeners) listener();
}

/** Calls `changed` whenever the colours change, by choice or with the device; returns how to stop that. */
export function onThemeChange(changed: () => void): () => void {
  const scheme = device();
  listeners.add(changed);
  scheme.addEventListener("change", changed);
  return () => {
    listeners.delete(changed);
    scheme.removeEventListener("change", changed);
  };
}

export function useTheme(): Theme {
  return useSyncExternalStore(onThemeChange, theme);
}

/** A theme variable as a colour that a canvas understands, for charts and pictures that are drawn by hand. */
export function themeColor(name: string): string {
  const probe = document.createElement("i");
  probe.style.color = `var(${name})`;
  document.documentElement.append(probe);
  const color = getComputedStyle(probe).color;
  probe.remove();
  return color;
}

/** The page's font, for the same. */
export function themeFont(): string {
  return getComputedStyle(document.documentElement).getPropertyValue("--font").trim();
}
