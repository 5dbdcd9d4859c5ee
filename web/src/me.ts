// Whose clicks this page sends: one place for all of it. With a login the service says who it is; without one whoever
// sits here says their name.

import { at } from "./base";
import type { Me, Role } from "./wire";

const KEPT = "seed.trainer";
const NOBODY_SAID = "local";
/** As the service takes it: 1 to 64 characters, none of them a control character. */
// biome-ignore lint/suspicious/noControlCharactersInRegex: those are what a name may not hold
const NAME = /^[^\x00-\x1f\x7f]{1,64}$/;
const PATIENCE_MS = 3000;
const ROLES: readonly Role[] = ["viewer", "trainer", "operator", "owner"];

export const isName = (name: string): boolean => NAME.test(name);

export let ME = kept();
/** Null: somebody has to sign in first. Without a login whoever sits here may do everything. */
export let ROLE: Role | null = "owner";
export let LOGIN = false;

/** Whether the one who sits here may do what this role may. */
export const may = (role: Role): boolean => ROLE !== null && ROLES.indexOf(ROLE) >= ROLES.indexOf(role);

/** Ask the service who sits here, before anything is drawn. */
export async function findOut(): Promise<void> {
  try {
    const response = await fetch(at("/api/v1/me"), { signal: AbortSignal.timeout(PATIENCE_MS) });
    if (!response.ok) return; // the page says that the service doesn't answer when it asks for more
    const me = (await response.json()) as Me;
    LOGIN = me.login;
    if (!LOGIN) return;
    ROLE = me.role ?? null;
    ME = me.name ?? NOBODY_SAID;
  } catch {
    // As above.
  }
}

/** Whoever sat here is not let in any more: the page begins anew and asks who is there. */
export function signedOut(): void {
  if (LOGIN && ROLE !== null) location.reload();
}

/** From now on; the page begins anew, since everything it knows is about the one before. */
export function rename(name: string): void {
  try {
    localStorage.setItem(KEPT, name);
    location.reload();
  } catch {
    // Without storage there is nothing that could remember it.
  }
}

function kept(): string {
  try {
    const name = localStorage.getItem(KEPT);
    return name !== null && isName(name) ? name : NOBODY_SAID;
  } catch {
    return NOBODY_SAID;
  }
}
