// Whose clicks this page sends: one place for all of it. Without a login whoever sits here says their name.

const KEPT = "seed.trainer";
const NOBODY_SAID = "local";
/** As the service takes it: 1 to 64 characters, none of them a control character. */
// biome-ignore lint/suspicious/noControlCharactersInRegex: those are what a name may not hold
const NAME = /^[^\x00-\x1f\x7f]{1,64}$/;

export const isName = (name: string): boolean => NAME.test(name);

export const ME = kept();

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
