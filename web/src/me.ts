// Whose clicks this page sends: one place for all of it. With a login it is who signed in; without one whoever sits here
// says their name.
import type { components } from "./api";

const KEPT = "seed.trainer";
const NOBODY_SAID = "local";
/** As the service takes it: 1 to 64 characters, none of them a control character. */
// biome-ignore lint/suspicious/noControlCharactersInRegex: those are what a name may not hold
const NAME = /^[^\x00-\x1f\x7f]{1,64}$/;

export const isName = (name: string): boolean => NAME.test(name);

export let ME = kept();
/** Whether people sign in here: then nobody says another name. */
export let SIGNED_IN = false;

const PATIENCE_MS = 3000;

/** Asks the service who this is; before the page is drawn. */
export async function findOut(): Promise<void> {
  try {
    const answer = await fetch("/api/v1/me", { signal: AbortSignal.timeout(PATIENCE_MS) });
    const me = (await answer.json()) as Partial<components["schemas"]["Me"]>;
    if (!answer.ok || !me.login || !me.name) return;
    ME = me.name;
    SIGNED_IN = true;
  } catch {
    // A service that doesn't answer refuses what isn't this trainer's by itself.
  }
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
