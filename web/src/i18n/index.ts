// Every word of the page in the reader's language. A language is one file in locales/; English fills what it lacks.
import { createInstance } from "i18next";
import { useSyncExternalStore } from "react";
import en from "./locales/en.json";

const KEPT = "seed.language";
export const FALLBACK = "en";

declare module "i18next" {
  interface CustomTypeOptions {
    resources: { translation: typeof en };
  }
}

type Words = typeof en;
type Loader = () => Promise<{ default: Words }>;

/** A language is fetched when it is chosen; English is always here. */
const LOADERS = import.meta.glob<{ default: Words }>(["./locales/*.json", "!./locales/en.json"]) as Record<
  string,
  Loader
>;

/** The languages there are, as BCP 47 tags. */
export const LANGUAGES = [FALLBACK, ...Object.keys(LOADERS).map(tagOf)].sort();

const library = createInstance();
void library.init({
  lng: FALLBACK,
  fallbackLng: FALLBACK,
  initAsync: false,
  resources: { [FALLBACK]: { translation: en } },
  interpolation: { escapeValue: false }, // React escapes
  showSupportNotice: false,
});

/** The words for a key. Components that call it are drawn anew with the whole page when the language changes. */
export const t = library.t;

/** Whether there are words for a key that is made while the page runs. */
export const known = (key: string): boolean => library.exists(key);

/** A skill in words; those of a foreign task are called what it calls them. */
export function skillName(skill: string): string {
  return library.exists(`skill.${skill}`) ? library.t(`skill.${skill as "pick"}`) : skill;
}

/** A camera as people call it; one of a foreign task or robot is called what it is called there. */
export function cameraName(camera: string): string {
  return library.exists(`camera.name_${camera}`)
    ? library.t(`camera.name_${camera as "left"}`)
    : camera.replaceAll("_", " ");
}

/** What a task says, in the reader's language where it is one of ours; a foreign task speaks for itself. */
export function taskWords(text: string): string {
  const key = text
    .toLowerCase()
    .replace(/[^a-z]+/g, "_")
    .replace(/^_/, "")
    .slice(0, 60)
    .replace(/_$/, "");
  return library.exists(`task.${key}`) ? library.t(`task.${key as "pick_up_the_red_block"}`) : text;
}

export function language(): string {
  return library.language;
}

/** The language in use; whoever asks is drawn again when it changes. */
export function useLanguage(): string {
  return useSyncExternalStore(
    (changed) => {
      library.on("languageChanged", changed);
      return () => library.off("languageChanged", changed);
    },
    () => library.language,
  );
}

/** Remembers the choice in this browser. */
export async function chooseLanguage(tag: string): Promise<void> {
  try {
    localStorage.setItem(KEPT, tag);
  } catch {
    // Without storage the choice lasts as long as the page.
  }
  await use(tag);
}

/** The language chosen here before; else the first of the browser's that there is. */
export async function startLanguage(): Promise<void> {
  let kept: string | null = null;
  try {
    kept = localStorage.getItem(KEPT);
  } catch {
    // As above.
  }
  await use(matching([...(kept ? [kept] : []), ...navigator.languages]));
}

/** The first of `wanted` that there is, in itself or as a language without its region. */
export function matching(wanted: readonly string[]): string {
  for (const tag of wanted) {
    const found =
      LANGUAGES.find((each) => each === tag) ?? LANGUAGES.find((each) => each === tag.split("-")[0]);
    if (found) return found;
  }
  return FALLBACK;
}

/** What a language calls itself. */
export function nameOf(tag: string): string {
  return new Intl.DisplayNames([tag], { type: "language" }).of(tag) ?? tag;
}

async function use(tag: string): Promise<void> {
  const load = LOADERS[`./locales/${tag}.json`];
  if (load && !library.hasResourceBundle(tag, "translation")) {
    try {
      library.addResourceBundle(tag, "translation", (await load()).default);
    } catch (error) {
      console.error(`The words for ${tag} can't be loaded`, error);
      return;
    }
  }
  await library.changeLanguage(tag);
  document.documentElement.lang = tag;
}

function tagOf(path: string): string {
  return path.slice("./locales/".length, -".json".length);
}
