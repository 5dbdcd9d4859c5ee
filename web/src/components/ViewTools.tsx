// Over the views: what comes next in words, and what is drawn into them, each by a button and by a key.
import { type ReactNode, useEffect, useEffectEvent } from "react";
import { t, taskWords } from "../i18n";
import { change, type Settings, useSettings } from "../settings";
import { dialogOpen } from "./Dialog";
import { Gauge, Ghost, Orbit, Question, Room } from "./icons";
import { typing } from "./JudgeBar";

type Toggle = keyof Pick<Settings, "ghost" | "workspace" | "scene" | "estimate">;

const TOGGLES: { name: Toggle; key: string; icon: ReactNode }[] = [
  { name: "ghost", key: "G", icon: <Ghost /> },
  { name: "workspace", key: "W", icon: <Room /> },
  { name: "scene", key: "D", icon: <Orbit /> },
  { name: "estimate", key: "E", icon: <Gauge /> },
];

export function ViewTools({ subgoal, onTour }: { subgoal: string | null; onTour: () => void }) {
  const settings = useSettings();
  const press = useEffectEvent((event: KeyboardEvent) => {
    if (typing(event.target) || dialogOpen() || event.repeat) return;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const toggle = TOGGLES.find(({ key }) => key === event.key.toUpperCase());
    if (toggle) change({ [toggle.name]: !settings[toggle.name] });
    if (event.key === "?") onTour();
  });
  useEffect(() => {
    const onKey = (event: KeyboardEvent) => press(event);
    window.addEventListener("keydown", onKey);
    return () => window.removeEventListener("keydown", onKey);
  }, []);
  return (
    <div className="view-tools">
      <p className="next" data-testid="subgoal">
        {subgoal && (
          <>
            <span className="soft">{t("agent.next")}</span> <b>{taskWords(subgoal)}</b>
          </>
        )}
      </p>
      <div className="toggles" role="toolbar" aria-label={t("tools.label")}>
        {TOGGLES.map(({ name, key, icon }) => (
          <button
            key={name}
            type="button"
            className="tool"
            aria-pressed={settings[name]}
            aria-keyshortcuts={key}
            title={t(`tools.${name}What`)}
            data-testid={`tool-${name}`}
            onClick={() => change({ [name]: !settings[name] })}
          >
            {icon}
            <span className="word">{t(`tools.${name}`)}</span>
          </button>
        ))}
        <button
          type="button"
          className="tool"
          aria-label={t("tools.tour")}
          title={t("tools.tour")}
          aria-keyshortcuts="?"
          data-testid="tour"
          onClick={onTour}
        >
          <Question />
        </button>
      </div>
    </div>
  );
}
