// What went wrong on a page that goes on, and what to do; above what it is about.

import type { ReactNode } from "react";
import { t } from "../i18n";
import type { Problem } from "../wire";

export function ProblemBanner(props: {
  problem: Problem;
  testId?: string;
  onRetry?: () => void;
  children?: ReactNode;
}) {
  return (
    <div className="banner" role="alert" data-testid={props.testId}>
      <div>
        <b>{props.problem.detail}</b> {props.problem.remedy}
        {props.children}
      </div>
      {props.onRetry && (
        <button type="button" className="button" onClick={props.onRetry}>
          {t("common.retry")}
        </button>
      )}
    </div>
  );
}
