// A proposal drawn over one picture, in that picture's own pixels. Every mark has a dark and a light halo, so that it
// can be told from any background.

import type { ReactNode } from "react";
import { t } from "../i18n";
import type { Overlay } from "../wire";

type Point = [number, number];

/** The same shape three times, widest first. */
function Haloed(props: {
  title: string;
  testId: string;
  color: string;
  width: number;
  shape: (p: StrokeProps) => ReactNode;
}) {
  const { shape, width, color } = props;
  return (
    <g data-testid={props.testId}>
      <title>{props.title}</title>
      {shape({ className: "mark", stroke: "var(--overlay-dark)", strokeWidth: width + 4 })}
      {shape({ className: "mark", stroke: "var(--overlay-light)", strokeWidth: width + 2 })}
      {shape({ className: "mark", stroke: color, strokeWidth: width })}
    </g>
  );
}

interface StrokeProps {
  className: string;
  stroke: string;
  strokeWidth: number;
}

function arrowPath([from, to]: [Point, Point]): string {
  const angle = Math.atan2(to[1] - from[1], to[0] - from[0]);
  const barb = (turn: number) =>
    `${to[0] - 16 * Math.cos(angle + turn)} ${to[1] - 16 * Math.sin(angle + turn)}`;
  return `M${from[0]} ${from[1]}L${to[0]} ${to[1]}M${barb(0.5)}L${to[0]} ${to[1]}L${barb(-0.5)}`;
}

const straightPath = ([from, to]: [Point, Point]) => `M${from[0]} ${from[1]}L${to[0]} ${to[1]}`;

export function OverlayDrawing(props: { overlay: Overlay; width: number; height: number; judged: boolean }) {
  const { overlay } = props;
  const line = overlay.line as [Point, Point] | null | undefined;
  const bar = overlay.bar as [Point, Point] | null | undefined;
  return (
    <svg
      className="overlay"
      data-judged={props.judged}
      viewBox={`0 0 ${props.width} ${props.height}`}
      role="img"
      aria-label={t("overlay.label")}
    >
      {overlay.ring && (
        <Haloed
          title={t("overlay.ring")}
          testId="ring"
          color="var(--overlay-dot)"
          width={2}
          shape={(p) => <ellipse {...p} cx={overlay.ring?.[0]} cy={overlay.ring?.[1]} rx={11} ry={6} />}
        />
      )}
      {line && (
        <Haloed
          title={overlay.arrow ? t("overlay.push") : t("overlay.height")}
          testId="line"
          color="var(--overlay-dot)"
          width={2.5}
          shape={(p) => <path {...p} d={overlay.arrow ? arrowPath(line) : straightPath(line)} />}
        />
      )}
      {bar && (
        <Haloed
          title={t("overlay.bar")}
          testId="bar"
          color="var(--overlay-bar)"
          width={4}
          shape={(p) => <path {...p} d={straightPath(bar)} />}
        />
      )}
      {overlay.dot && (
        <g data-testid="dot">
          <title>{t("overlay.dot")}</title>
          <circle cx={overlay.dot[0]} cy={overlay.dot[1]} r={9} fill="var(--overlay-dark)" />
          <circle cx={overlay.dot[0]} cy={overlay.dot[1]} r={7.8} fill="var(--overlay-light)" />
          <circle cx={overlay.dot[0]} cy={overlay.dot[1]} r={6} fill="var(--overlay-dot)" />
        </g>
      )}
    </svg>
  );
}
