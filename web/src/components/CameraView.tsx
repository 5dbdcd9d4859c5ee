// One camera: the still picture a proposal is drawn on, and over it the live video while the robot moves.
import { useEffect, useEffectEvent, useLayoutEffect, useRef } from "react";
import { useLookedAt } from "../considering";
import type { FrameSink } from "../frames";
import { cameraName, skillName, t } from "../i18n";
import { useSettings } from "../settings";
import type { Press } from "../useJudging";
import { type Sought, useZoom } from "../useZoom";
import type { FrameHeader, View } from "../wire";
import type { Swipe } from "../zoom";
import { Minus, Plus, Whole } from "./icons";
import { FaintDrawing, OverlayDrawing, Workspace } from "./OverlayDrawing";

export interface CameraViewProps {
  side: "left" | "right";
  view: View;
  /** The decoded still of `view`, or undefined where it is on the canvas already and no longer kept. */
  picture: ImageBitmap | undefined;
  skill: string | null;
  proposalId: number;
  overlay: boolean;
  judged: boolean;
  /** The robot that is shown; pictures of another are none of it. */
  robot: number;
  live: number | null;
  /** Whether the robot moves; after it the last picture of the video stays until there is a new still. */
  moving: boolean;
  frames: FrameSink;
  onSwipe?: ((swipe: Swipe, press: Press) => void) | undefined;
}

function draw(canvas: HTMLCanvasElement | null, picture: ImageBitmap, width: number, height: number): void {
  if (!canvas) return;
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  canvas.getContext("2d")?.drawImage(picture, 0, 0, width, height);
}

/** Draws stills and live frames onto the two canvases that it returns. */
function useCanvases({ view, picture, live, frames, robot }: CameraViewProps) {
  const still = useRef<HTMLCanvasElement>(null);
  const video = useRef<HTMLCanvasElement>(null);
  const shownExecution = useRef<number | null>(null);

  // Layout effects run before the browser paints: picture and overlay appear in the same frame.
  useLayoutEffect(() => {
    if (picture) draw(still.current, picture, view.width, view.height);
  }, [picture, view.width, view.height]);

  // The last picture of an earlier motion must not pass for this one's.
  useLayoutEffect(() => {
    const canvas = video.current;
    if (canvas && live !== null && shownExecution.current !== live)
      canvas.getContext("2d")?.clearRect(0, 0, canvas.width, canvas.height);
  }, [live]);

  const onFrame = useEffectEvent((header: FrameHeader, frame: ImageBitmap) => {
    if (header.robot !== robot) return;
    shownExecution.current = header.execution_id ?? live;
    draw(video.current, frame, header.width, header.height);
  });
  useEffect(
    () => frames.attach(view.camera, (header, frame) => onFrame(header, frame)),
    [frames, view.camera],
  );
  return { still, video };
}

/** In words too: upwards isn't what the arrow key upwards says. */
const SAID = { left: "judge.bad", up: "judge.neutral", right: "judge.good" } as const;

/** Where it has to be looked at to be judged: at its place, and for a push where that ends. */
function soughtIn({ overlay, judged, proposalId, view }: CameraViewProps): Sought | null {
  if (!overlay || judged) return null;
  const { dot, line, arrow } = view.overlay;
  const points = [dot, arrow && line ? line[1] : null].filter((point) => point !== null);
  return { id: proposalId, points: points.map(([x, y]) => [x / view.width, y / view.height]) };
}

export function CameraView(props: CameraViewProps) {
  const { view, live, overlay } = props;
  const { still, video } = useCanvases(props);
  const frame = useRef<HTMLElement>(null);
  const { zoom, away, stroke, nearer, farther, whole } = useZoom(frame, soughtIn(props), props.onSwipe);
  const { ghost, workspace } = useSettings();
  const other = useLookedAt(props.proposalId, view.camera);
  const name = cameraName(view.camera);
  const zoomed = zoom.scale > 1;
  return (
    <figure
      className="view"
      data-testid={`view-${props.side}`}
      data-live={live !== null}
      data-zoomed={zoomed}
      data-stroke={stroke ?? undefined}
      data-said={stroke ? t(SAID[stroke]) : undefined}
      style={{ aspectRatio: `${view.width} / ${view.height}` }}
      ref={frame}
    >
      <div
        className="picture"
        style={{ transform: `translate(${100 * zoom.x}%, ${100 * zoom.y}%) scale(${zoom.scale})` }}
      >
        <canvas ref={still} role="img" aria-label={t("camera.still", { camera: name })} />
        <canvas ref={video} className="live" role="img" aria-label={t("camera.video", { camera: name })} />
        {workspace && (
          <svg className="overlay" viewBox={`0 0 ${view.width} ${view.height}`} aria-hidden="true">
            <Workspace corners={view.overlay.workspace} />
          </svg>
        )}
        {overlay && other && <FaintDrawing overlay={other} width={view.width} height={view.height} />}
        {overlay && (
          <OverlayDrawing
            overlay={view.overlay}
            width={view.width}
            height={view.height}
            judged={props.judged}
            ghost={ghost}
          />
        )}
      </div>
      {props.skill && <span className="chip skill">{skillName(props.skill)}</span>}
      <span className="chip camera">
        {props.moving && <span className="dot" />}
        {props.moving ? t("camera.live", { camera: name }) : name}
      </span>
      {overlay && !view.overlay.in_view && <span className="chip note">{t("camera.outside")}</span>}
      {overlay && away && (
        <span className="chip note" data-testid="zoomed-away">
          {t("camera.zoomedAway")}
        </span>
      )}
      <div className="zoom">
        {zoomed && (
          <>
            <button type="button" aria-label={t("camera.whole", { camera: name })} onClick={whole}>
              <Whole />
            </button>
            <button type="button" aria-label={t("camera.farther", { camera: name })} onClick={farther}>
              <Minus />
            </button>
          </>
        )}
        <button
          type="button"
          aria-label={t("camera.nearer", { camera: name })}
          title={t("camera.how")}
          onClick={nearer}
          data-testid={`nearer-${props.side}`}
        >
          <Plus />
        </button>
      </div>
    </figure>
  );
}
