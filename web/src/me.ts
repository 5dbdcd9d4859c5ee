// Whose clicks this page sends: one place for all of it. With a login the service says who it is; without one whoever
// sits here says their name.

import { at } from "./base";
import type { Me, Role } from "./wire";

const KEPT = "seed.trainer";
const NOBODY_SAID = "local";
/** As the service takes it: 1 to 64 characters, none of them a control character. */
// biome-ignore lint/suspicious/noControlCharactersInRegex: those are what a name may not hold
const NAME = /^[^\x00-\x1f\x7f]{1,64}$/;
/** How names begin that the service writes itself, and takes from nobody: `server/names.py`. */
const THE_SERVICES = /^\s*(teacher:|somebody-|critic|evaluation|trainers)/i;
const PATIENCE_MS = 3000;
const ROLES: readonly Role[] = ["viewer", "trainer", "operator", "owner"];

export const isName = (name: string): boolean => NAME.test(name) && !THE_SERVICES.test(name);

export let ME = kept();
/** Null: somebody has to sign in first. Without a login whoever sits here may do everything. */
export let ROLE: Role | null = "owner";
export let LOGIN = false;

/** Whether the one who sits here may do what this role may. */
export const may = (role: Role): boolean => ROLE !== null && ROLES.indexOf(ROLE) >= ROLES.indexOf(role);

/** Whether the service has said who sits here. */
let told = false;

async function ask(): Promise<Me> {
  const response = await fetch(at("/api/v1/me"), { signal: AbortSignal.timeout(PATIENCE_MS) });
  if (!response.ok) throw new Error(`GET /api/v1/me: ${response.status}`);
  return (await response.json()) as Me;
}

/** Ask the service who sits here, before anything is drawn. */
export async function findOut(): Promise<void> {
  try {
    const me = await ask();
    told = true;
    LOGIN = me.login;
    if (!LOGIN) return;
    ROLE = me.role ?? null;
    ME = me.name ?? NOBODY_SAID;
  } catch {
    // The page says that the service doesn't answer when it asks for more.
  }
}

/** Whether who sits here is still who this page takes them for: they may have signed in or out in another tab. Where
 * they aren't, the page begins anew. Rejects where the service doesn't say. */
export async function stillMe(): Promise<boolean> {
  if (told && !LOGIN) return true; // only this page knows, and it begins anew with another name
  const me = await ask();
  const same = me.login ? LOGIN && (me.name ?? NOBODY_SAID) === ME && (me.role ?? null) === ROLE : !LOGIN;
  if (same) told = true;
  else location.reload();
  return same;
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
