// Which of several robots is shown: the one that is to be judged next, or one that someone keeps an eye on.
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

const WORDS = { moving: "moves", waiting: "its proposal waits", busy: "busy" };

export function RobotPicker({ robots, judged, chosen, shown, onChoose }: RobotPickerProps) {
  const waiting = queueOf(robots, judged).length;
  return (
    <div className="robots">
      <fieldset className="segments" aria-label="Which robot is shown" data-testid="robots">
        <button type="button" aria-pressed={chosen === null} onClick={() => onChoose(null)}>
          In turn
        </button>
        {robots.map((robot, index) => (
          <button
            key={index}
            type="button"
            aria-pressed={chosen === index}
            aria-label={`Robot ${index + 1}`}
            title={`Robot ${index + 1}: ${WORDS[doing(robot, judged)]}`}
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
        <b>{`Robot ${shown + 1} of ${robots.length}`}</b>
        <span className="soft">{waiting === 1 ? "1 proposal waits" : `${waiting} proposals wait`}</span>
      </p>
    </div>
  );
}
