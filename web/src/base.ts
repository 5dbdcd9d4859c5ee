// Where the page lives: at the root of its host, or under a path that a proxy publishes it at. The service says so in <base>.

/** The path without its last slash: empty at the root. */
export const BASE = new URL(document.querySelector("base")?.href ?? location.origin).pathname.replace(
  /\/$/,
  "",
);

/** An address of the service, e.g. of a picture, as the browser has to ask for it. */
export const at = (path: string): string => BASE + path;
