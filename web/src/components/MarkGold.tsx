// An operator knows the answer to a past proposal: it is shown again, hidden among the others, to measure trainers.

import * as http from "../http";
import { t } from "../i18n";

export function MarkGold(props: { proposalId: number; notify: (text: string) => void }) {
  const mark = (answer: -1 | 1) =>
    void http.markGold(props.proposalId, answer).then(
      () => props.notify(t("quality.marked")),
      (error: unknown) => {
        const { detail, remedy } = http.problemOf(error);
        props.notify(`${detail} ${remedy}`);
      },
    );
  return (
    <fieldset className="relabel" aria-label={t("quality.mark")}>
      <legend className="soft">{t("quality.markWhat")}</legend>
      <button type="button" className="button" data-testid="mark-bad" onClick={() => mark(-1)}>
        {t("quality.knownBad")}
      </button>
      <button type="button" className="button" data-testid="mark-good" onClick={() => mark(1)}>
        {t("quality.knownGood")}
      </button>
    </fieldset>
  );
}
