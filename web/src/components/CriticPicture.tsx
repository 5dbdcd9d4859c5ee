// The table from above: what the critic expects, what was said, where things are, and what was proposed.
import { type PointerEvent, useMemo, useState } from "react";
import { ticks } from "../charting";
import { colorOf, frameOf, thingsIn, valueAt } from "../criticMap";
import { skillName, t } from "../i18n";
import { decimal, signed } from "../i18n/numbers";
import type { CriticMap, Proposal, SceneInfo } from "../wire";

export interface CriticPictureProps {
  map: CriticMap;
  proposal: Proposal;
  scene: SceneInfo | null;
  /** Labels of other situations too, faintly. */
  all: boolean;
}

const MARKS = { "1": "M-4 0 L-1 3.5 L4.5 -4", "0": "M-4 0 H4", "-1": "M-4 -4 L4 4 M4 -4 L-4 4" } as const;

export function CriticPicture({ map, proposal, scene, all }: CriticPictureProps) {
  const frame = useMemo(() => frameOf(map), [map]);
  const [at, setAt] = useState<{ x: number; y: number } | null>(null);
  const { px, py, cell } = frame;
  const flat = map.values.flat();
  const labels = map.labels.filter(({ alike }) => all || alike);
  const point = (event: PointerEvent<SVGSVGElement>) => {
    const box = event.currentTarget.getBoundingClientRect();
    const scale = frame.width / box.width;
    const left = (event.clientX - box.left) * scale;
    const top = (event.clientY - box.top) * scale;
    const x = (map.x[0] ?? 0) + ((left - px(map.x[0] ?? 0)) / cell[0]) * ((map.x[1] ?? 1) - (map.x[0] ?? 0));
    const y = (map.y[0] ?? 0) + ((py(map.y[0] ?? 0) - top) / cell[1]) * ((map.y[1] ?? 1) - (map.y[0] ?? 0));
    setAt({ x, y });
  };
  const value = at && valueAt(map, at.x, at.y);
  return (
    <figure className="critic-picture">
      <svg
        viewBox={`0 0 ${frame.width} ${frame.height}`}
        role="img"
        aria-label={t("critic.picture", {
          skill: skillName(map.skill),
          low: signed(Math.min(...flat)),
          high: signed(Math.max(...flat)),
        })}
        data-testid="critic-picture"
        data-source={map.source}
        onPointerMove={point}
        onPointerLeave={() => setAt(null)}
      >
        <Cells map={map} px={px} py={py} cell={cell} />
        <Axes map={map} px={px} py={py} height={frame.height} width={frame.width} />
        {map.keypoints.map(([x, y]) => (
          <path key={`${x} ${y}`} className="keypoint" d={`M${px(x)} ${py(y) - 9}l9 9l-9 9l-9 -9z`} />
        ))}
        {thingsIn(scene, proposal.state).map(({ name, x, y }) => (
          <g key={name} className="thing" transform={`translate(${px(x)} ${py(y)})`}>
            <circle r={4} />
            <text x={8} y={-6}>
              {name.replaceAll("_", " ")}
            </text>
          </g>
        ))}
        {labels.map((label) => (
          <g
            key={label.proposal_id}
            className="said"
            data-alike={label.alike}
            transform={`translate(${px(label.x)} ${py(label.y)})`}
          >
            <title>
              {t("critic.label", {
                number: label.number,
                label: signed(label.value, 0),
                predicted: signed(label.predicted_feedback),
              })}
            </title>
            <path d={MARKS[`${label.value}`]} />
          </g>
        ))}
        {proposal.skill === map.skill && proposal.parameters.x !== undefined && (
          <circle
            className="proposed"
            cx={px(proposal.parameters.x)}
            cy={py(proposal.parameters.y ?? 0)}
            r={8}
          />
        )}
      </svg>
      <figcaption>
        <Scale />
        <span className="number" data-testid="critic-read">
          {at && value !== null
            ? t("critic.at", { x: decimal(at.x, 3), y: decimal(at.y, 3), value: signed(value ?? 0) })
            : t("critic.point")}
        </span>
      </figcaption>
    </figure>
  );
}

type Places = Pick<ReturnType<typeof frameOf>, "px" | "py">;

function Cells({ map, px, py, cell }: { map: CriticMap; cell: [number, number] } & Places) {
  return (
    <g shapeRendering="crispEdges">
      {map.values.flatMap((row, j) =>
        row.map((value, i) => {
          const [x, y] = [map.x[i] ?? 0, map.y[j] ?? 0];
          return (
            <rect
              key={`${x} ${y}`}
              x={px(x) - cell[0] / 2}
              y={py(y) - cell[1] / 2}
              width={cell[0]}
              height={cell[1]}
              style={{ fill: colorOf(value) }}
            />
          );
        }),
      )}
    </g>
  );
}

function Axes({ map, px, py, width, height }: { map: CriticMap; width: number; height: number } & Places) {
  const [x0 = 0, x1 = 1] = [map.x[0], map.x.at(-1)];
  const [y0 = 0, y1 = 1] = [map.y[0], map.y.at(-1)];
  return (
    <g className="axis">
      {ticks(x0, x1, 6).map((x) => (
        <text key={x} x={px(x)} y={height - 24} textAnchor="middle">
          {decimal(x)}
        </text>
      ))}
      {ticks(y0, y1, 6).map((y) => (
        <text key={y} x={52} y={py(y) + 4} textAnchor="end">
          {decimal(y)}
        </text>
      ))}
      <text x={width / 2} y={height - 6} textAnchor="middle">
        {t("critic.axisX")}
      </text>
      <text x={11} y={height / 2} textAnchor="middle" transform={`rotate(-90 11 ${height / 2})`}>
        {t("critic.axisY")}
      </text>
    </g>
  );
}

function Scale() {
  const steps = [-1, -0.5, 0, 0.5, 1];
  return (
    <span className="scale" aria-hidden="true">
      {steps.map((step) => (
        <span key={step}>
          <i style={{ background: colorOf(step) }} />
          {signed(step, step % 1 ? 1 : 0)}
        </span>
      ))}
    </span>
  );
}
