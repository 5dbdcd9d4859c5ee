import { t } from "../i18n";
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
          <b>{t("halt.unconfirmed")}</b> {t("halt.unconfirmedWhat")}
        </div>
      </div>
    );
  if (!halted) return null;
  const ask = () =>
    onAsk({
      title: t("halt.ask"),
      text: t("halt.asked"),
      yes: t("halt.rearm"),
      danger: true,
      testId: "rearm-confirm",
      act: onRearm,
    });
  return (
    <div className="banner" role="alert" data-testid="halted">
      <div>
        <b>{t("halt.stopped")}</b> {t("halt.nothingMoves")}
      </div>
      <button type="button" className="button danger" data-testid="rearm" onClick={ask}>
        {t("halt.rearmAsk")}
      </button>
    </div>
  );
}
