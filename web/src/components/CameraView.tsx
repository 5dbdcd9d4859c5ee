// One camera: the still picture a proposal is drawn on, and over it the live video while the robot moves.

import { useEffect, useEffectEvent, useLayoutEffect, useRef } from "react";
import type { FrameSink } from "../frames";
import { skillName, t } from "../i18n";
import type { FrameHeader, View } from "../wire";
import { OverlayDrawing } from "./OverlayDrawing";

export interface CameraViewProps {
  side: "left" | "right";
  view: View;
  /** The decoded still of `view`, or undefined where it is on the canvas already and no longer kept. */
  picture: ImageBitmap | undefined;
  skill: string | null;
  overlay: boolean;
  judged: boolean;
  /** The robot that is shown; pictures of another are none of it. */
  robot: number;
  live: number | null;
  /** Whether the robot moves; after it the last picture of the video stays until there is a new still. */
  moving: boolean;
  frames: FrameSink;
}

function draw(canvas: HTMLCanvasElement | null, picture: ImageBitmap, width: number, height: number): void {
  if (!canvas) return;
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  canvas.getContext("2d")?.drawImage(picture, 0, 0, width, height);
}

export function CameraView(props: CameraViewProps) {
  const { view, picture, live, frames } = props;
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
    if (header.robot !== props.robot) return;
    shownExecution.current = header.execution_id ?? live;
    draw(video.current, frame, header.width, header.height);
  });
  useEffect(
    () => frames.attach(view.camera, (header, frame) => onFrame(header, frame)),
    [frames, view.camera],
  );

  const name = view.camera.replaceAll("_", " ");
  return (
    <figure
      className="view"
      data-testid={`view-${props.side}`}
      data-live={live !== null}
      style={{ aspectRatio: `${view.width} / ${view.height}` }}
    >
      <canvas ref={still} role="img" aria-label={t("camera.still", { camera: name })} />
      <canvas ref={video} className="live" role="img" aria-label={t("camera.video", { camera: name })} />
      {props.overlay && (
        <OverlayDrawing
          overlay={view.overlay}
          width={view.width}
          height={view.height}
          judged={props.judged}
        />
      )}
      {props.skill && <span className="chip skill">{skillName(props.skill)}</span>}
      <span className="chip camera">
        {props.moving && <span className="dot" />}
        {props.moving ? t("camera.live", { camera: name }) : name}
      </span>
      {props.overlay && !view.overlay.in_view && <span className="chip note">{t("camera.outside")}</span>}
    </figure>
  );
}
