// Which of several robots is shown: the one that is to be judged next, or one that someone keeps an eye on.
import { t } from "../i18n";
import { type Judged, queueOf, type RobotState, waits } from "../robots";

export interface RobotPickerProps {
  robots: RobotState[];
  judged: Judged;
  chosen: number | null;
  shown: number;
  onChoose: (robot: number | null) => void;
}

function doing(robot: RobotState, judged: Judged): "moving" | "waiting" | "busy" {
  if (robot.execution) return "moving";
  return waits(robot, judged) ? "waiting" : "busy";
}

export function RobotPicker({ robots, judged, chosen, shown, onChoose }: RobotPickerProps) {
  const waiting = queueOf(robots, judged).length;
  return (
    <div className="robots">
      <fieldset className="segments" aria-label={t("robots.label")} data-testid="robots">
        <button type="button" aria-pressed={chosen === null} onClick={() => onChoose(null)}>
          {t("robots.inTurn")}
        </button>
        {robots.map((robot, index) => (
          <button
            key={index}
            type="button"
            aria-pressed={chosen === index}
            aria-label={t("robots.one", { number: index + 1 })}
            title={t("robots.state", { number: index + 1, doing: t(`robots.${doing(robot, judged)}`) })}
            data-testid={`robot-${index + 1}`}
            data-doing={doing(robot, judged)}
            onClick={() => onChoose(index)}
          >
            <span className="dot" />
            {index + 1}
          </button>
        ))}
      </fieldset>
      <p data-testid="queue">
        <b>{t("robots.oneOf", { number: shown + 1, count: robots.length })}</b>
        <span className="soft">{t("robots.wait", { count: waiting })}</span>
      </p>
    </div>
  );
}
