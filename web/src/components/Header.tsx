import type { ReactNode } from "react";
import { Link } from "../router";
import { Sprout } from "./icons";

/** The bar at the top; `stop` keeps room for the emergency stop. */
export function Header(props: { crumb?: string; stop?: boolean; children?: ReactNode }) {
  return (
    <header className={props.stop ? "header with-stop" : "header"}>
      <Link to="/" className="brand" label="SEED, all experiments">
        <Sprout />
        <span>SEED</span>
      </Link>
      {props.crumb && <span className="crumb">{props.crumb}</span>}
      <span className="spring" />
      {props.children}
    </header>
  );
}
