import type { ReactNode } from "react";
import { t } from "../i18n";
import { LOGIN, may } from "../me";
import { Link } from "../router";
import { Sprout } from "./icons";
import { Preferences } from "./Preferences";

/** The bar at the top; `back` leads to the experiments, `stop` keeps room for the emergency stop, `experiment` leads on to its results. */
export function Header(props: { back?: boolean; stop?: boolean; experiment?: number; children?: ReactNode }) {
  return (
    <header className={props.stop ? "header with-stop" : "header"}>
      <Link to="/" className="brand" label={t("header.brand")}>
        <Sprout />
        <span>SEED</span>
      </Link>
      {props.back && (
        <Link to="/" className="crumb home">
          {t("header.experiments")}
        </Link>
      )}
      {props.experiment && (
        <Link to={`/experiments/${props.experiment}/results`} className="crumb" testId="to-results">
          {t("nav.results")}
        </Link>
      )}
      {!props.stop && (
        <Link to="/studies" className="crumb">
          {t("header.studies")}
        </Link>
      )}
      {!props.stop && LOGIN && may("operator") && (
        <Link to="/people" className="crumb" testId="to-people">
          {t("people.title")}
        </Link>
      )}
      <span className="spring" />
      {props.children}
      <Preferences />
    </header>
  );
}
