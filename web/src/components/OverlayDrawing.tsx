// A proposal drawn over one picture, in that picture's own pixels. Every mark has a dark and a light halo, so that it
// can be told from any background, and a shape of its own, so that it needs no colour to be told from the others.
import { type ReactNode, useState } from "react";
import { t } from "../i18n";
import type { Overlay } from "../wire";

type Point = [number, number];

interface StrokeProps {
  className: string;
  stroke: string;
  strokeWidth: number;
}

interface Explained {
  text: string;
  at: Point;
}

interface MarkProps {
  title: string;
  testId: string;
  at: Point;
  explain: (what: Explained | null) => void;
  children: ReactNode;
}

/** A part that says what it is when it is pointed at or has the focus. */
function Mark({ title, testId, at, explain, children }: MarkProps) {
  const show = () => explain({ text: title, at });
  const hide = () => explain(null);
  return (
    // biome-ignore lint/a11y/noInteractiveElementToNoninteractiveRole: it has the focus only to say what it is
    <g
      data-testid={testId}
      className="part"
      role="img"
      aria-label={title}
      tabIndex={0}
      onPointerEnter={show}
      onPointerLeave={hide}
      onFocus={show}
      onBlur={hide}
    >
      {children}
    </g>
  );
}

/** The same shape three times, widest first. */
function Haloed({
  color,
  width,
  shape,
}: {
  color: string;
  width: number;
  shape: (p: StrokeProps) => ReactNode;
}) {
  return (
    <>
      {shape({ className: "mark reach-for", stroke: "transparent", strokeWidth: width + 12 })}
      {shape({ className: "mark", stroke: "var(--overlay-dark)", strokeWidth: width + 4 })}
      {shape({ className: "mark", stroke: "var(--overlay-light)", strokeWidth: width + 2 })}
      {shape({ className: "mark", stroke: color, strokeWidth: width })}
    </>
  );
}

function arrowPath([from, to]: [Point, Point]): string {
  const angle = Math.atan2(to[1] - from[1], to[0] - from[0]);
  const barb = (turn: number) =>
    `${to[0] - 16 * Math.cos(angle + turn)} ${to[1] - 16 * Math.sin(angle + turn)}`;
  return `M${from[0]} ${from[1]}L${to[0]} ${to[1]}M${barb(0.5)}L${to[0]} ${to[1]}L${barb(-0.5)}`;
}

const straightPath = ([from, to]: [Point, Point]) => `M${from[0]} ${from[1]}L${to[0]} ${to[1]}`;
const polygon = (points: Point[]) => points.map((point) => point.join(",")).join(" ");
const middle = ([from, to]: [Point, Point]): Point => [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2];

/** The box in which skills may act: its floor filled, its edges drawn. */
export function Workspace({ corners }: { corners: Point[] }) {
  if (corners.length !== 8) return null;
  const low = corners.slice(0, 4);
  const high = corners.slice(4);
  return (
    <g className="workspace" data-testid="workspace">
      <polygon className="floor" points={polygon(low)} />
      <polygon points={polygon(high)} />
      {low.map((corner, index) => {
        const above = high[index] ?? corner;
        return <path key={polygon([corner, above])} d={straightPath([corner, above])} />;
      })}
    </g>
  );
}

/** Another choice of the agent: dashed and hollow, so that nobody takes it for what is to be judged. */
export function FaintDrawing({
  overlay,
  width,
  height,
}: {
  overlay: Overlay;
  width: number;
  height: number;
}) {
  const { dot, line, bar, arrow } = overlay;
  const path = line && (arrow ? arrowPath(line) : straightPath(line));
  return (
    <svg
      className="overlay faint"
      viewBox={`0 0 ${width} ${height}`}
      aria-hidden="true"
      data-testid="considered-overlay"
    >
      {[path, bar && straightPath(bar)].map((d) => d && <path key={d} d={d} className="under" />)}
      {[path, bar && straightPath(bar)].map((d) => d && <path key={d} d={d} />)}
      {dot && <circle cx={dot[0]} cy={dot[1]} r={7} className="under" />}
      {dot && <circle cx={dot[0]} cy={dot[1]} r={7} />}
    </svg>
  );
}

export interface OverlayDrawingProps {
  overlay: Overlay;
  width: number;
  height: number;
  judged: boolean;
  ghost: boolean;
}

export function OverlayDrawing({ overlay, width, height, judged, ghost }: OverlayDrawingProps) {
  const [told, setTold] = useState<Explained | null>(null);
  const { dot, ring, line, bar } = overlay;
  return (
    <>
      {/* biome-ignore lint/a11y/useSemanticElements: a fieldset can't be drawn */}
      <svg
        className="overlay"
        data-judged={judged}
        viewBox={`0 0 ${width} ${height}`}
        role="group"
        aria-label={t("overlay.label")}
      >
        {ghost && overlay.ghost.length > 0 && (
          <g className="ghost" data-testid="ghost">
            <title>{t("overlay.ghost")}</title>
            {overlay.ghost.map((outline) => (
              <polygon key={polygon(outline)} points={polygon(outline)} />
            ))}
          </g>
        )}
        {ring && (
          <Mark title={t("overlay.ring")} testId="ring" at={ring} explain={setTold}>
            <Haloed
              color="var(--overlay-dot)"
              width={2}
              shape={(p) => <ellipse {...p} cx={ring[0]} cy={ring[1]} rx={11} ry={6} />}
            />
          </Mark>
        )}
        {line && (
          <Mark
            title={overlay.arrow ? t("overlay.push") : t("overlay.height")}
            testId="line"
            at={middle(line)}
            explain={setTold}
          >
            <Haloed
              color="var(--overlay-dot)"
              width={2.5}
              shape={(p) => <path {...p} d={overlay.arrow ? arrowPath(line) : straightPath(line)} />}
            />
          </Mark>
        )}
        {bar && (
          <Mark title={t("overlay.bar")} testId="bar" at={bar[1]} explain={setTold}>
            <Haloed
              color="var(--overlay-bar)"
              width={4}
              shape={(p) => <path {...p} d={straightPath(bar)} />}
            />
          </Mark>
        )}
        {dot && (
          <Mark title={t("overlay.dot")} testId="dot" at={dot} explain={setTold}>
            <circle cx={dot[0]} cy={dot[1]} r={9} fill="var(--overlay-dark)" />
            <circle cx={dot[0]} cy={dot[1]} r={7.8} fill="var(--overlay-light)" />
            <circle cx={dot[0]} cy={dot[1]} r={6} fill="var(--overlay-dot)" />
          </Mark>
        )}
      </svg>
      {told && (
        <span
          className="explained"
          style={{ left: `${(100 * told.at[0]) / width}%`, top: `${(100 * told.at[1]) / height}%` }}
          data-low={told.at[1] > height * 0.8}
          data-testid="explained"
        >
          {told.text}
        </span>
      )}
    </>
  );
}
