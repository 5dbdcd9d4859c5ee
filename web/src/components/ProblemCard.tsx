import { t } from "../i18n";
import { Link } from "../router";
import type { Problem } from "../wire";
import { Header } from "./Header";

/** A page that can't be shown, why, and what to do. */
export function ProblemCard({ problem }: { problem: Problem }) {
  return (
    <>
      <Header back />
      <main className="page narrow">
        <div className="empty" role="alert">
          <h1>{problem.title}</h1>
          <p>{`${problem.detail} ${problem.remedy}`}</p>
          <Link to="/" className="button primary">
            {t("common.allExperiments")}
          </Link>
        </div>
      </main>
    </>
  );
}
