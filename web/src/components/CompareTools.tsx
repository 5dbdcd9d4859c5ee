// What is compared: the measure, what makes experiments one curve, and the paper's curves.

import { measureName } from "../charting";
import { type Compared, GROUPINGS, MEASURES, type PaperFigure } from "../comparing";
import { t } from "../i18n";
import type { Measure } from "../wire";

export interface CompareToolsProps {
  compared: Compared;
  figures: PaperFigure[];
  onChange: (next: Compared) => void;
}

export function CompareTools({ compared, figures, onChange }: CompareToolsProps) {
  const { by } = compared;
  return (
    <div className="list-tools compare-tools">
      <label>
        {t("compare.measure")}
        <select
          value={compared.measure}
          data-testid="measure"
          onChange={(event) => onChange({ ...compared, measure: event.target.value as Measure })}
        >
          {MEASURES.map((each) => (
            <option key={each} value={each}>
              {measureName(each)}
            </option>
          ))}
        </select>
      </label>
      <label>
        {t("compare.paperCurves")}
        <select
          value={figures.some(({ scenario }) => scenario === compared.paper) ? compared.paper : ""}
          disabled={figures.length === 0}
          data-testid="paper"
          onChange={(event) => onChange({ ...compared, paper: event.target.value })}
        >
          <option value="">
            {figures.length === 0 ? t("compare.paperHasNone") : t("compare.paperNone")}
          </option>
          {figures.map(({ scenario, title }) => (
            <option key={scenario} value={scenario}>
              {title}
            </option>
          ))}
        </select>
      </label>
      <fieldset className="chips">
        <legend>{t("compare.by")}</legend>
        {GROUPINGS.map((each) => (
          <button
            key={each}
            type="button"
            className="choice-chip"
            aria-pressed={by.includes(each)}
            data-testid={`by-${each}`}
            onClick={() =>
              onChange({
                ...compared,
                by: GROUPINGS.filter((one) => (one === each ? !by.includes(one) : by.includes(one))),
              })
            }
          >
            {t(`compare.by_${each}`)}
          </button>
        ))}
      </fieldset>
    </div>
  );
}
