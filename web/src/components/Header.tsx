import type { ReactNode } from "react";
import { Link } from "../router";
import { Sprout } from "./icons";

/** The bar at the top; `back` leads to the experiments, `stop` keeps room for the emergency stop. */
export function Header(props: { back?: boolean; stop?: boolean; children?: ReactNode }) {
  return (
    <header className={props.stop ? "header with-stop" : "header"}>
      <Link to="/" className="brand" label="SEED, all experiments">
        <Sprout />
        <span>SEED</span>
      </Link>
      {props.back && (
        <Link to="/" className="crumb">
          Experiments
        </Link>
      )}
      {!props.stop && (
        <Link to="/studies" className="crumb">
          Studies
        </Link>
      )}
      <span className="spring" />
      {props.children}
    </header>
  );
}
