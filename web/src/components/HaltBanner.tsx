import type { TrainerState } from "../state";
import type { Question } from "./Dialog";

export interface HaltBannerProps {
  state: TrainerState;
  onAsk: (question: Question) => void;
  onRearm: () => void;
}

/** Says that everything is stopped, or, worse, that the stop isn't confirmed. */
export function HaltBanner({ state, onAsk, onRearm }: HaltBannerProps) {
  const halted = state.experiment?.halted ?? false;
  if (state.stopping === "unreachable" && !halted)
    return (
      <div className="banner" role="alert" data-testid="stop-unconfirmed">
        <div>
          <b>The stop isn’t confirmed.</b> The service doesn’t answer; this page keeps asking. If the robot
          moves, use its own emergency stop.
        </div>
      </div>
    );
  if (!halted) return null;
  const ask = () =>
    onAsk({
      title: "Re-arm the robot?",
      text: "Look at the robot first: nobody within its reach, nothing jammed. Re-arming moves nothing by itself, but approved skills can run again.",
      yes: "Re-arm",
      danger: true,
      testId: "rearm-confirm",
      act: onRearm,
    });
  return (
    <div className="banner" role="alert" data-testid="halted">
      <div>
        <b>Emergency stop.</b> Nothing moves until you re-arm.
      </div>
      <button type="button" className="button danger" data-testid="rearm" onClick={ask}>
        Re-arm…
      </button>
    </div>
  );
}
