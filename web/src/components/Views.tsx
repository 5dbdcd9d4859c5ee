// The two camera views of a proposal. Nothing is drawn before all its pictures are decoded; then all of it at once.

import { useEffect, useLayoutEffect, useRef, useSyncExternalStore } from "react";
import type { FrameSink } from "../frames";
import { t } from "../i18n";
import type { ImageStore } from "../images";
import type { Press } from "../useJudging";
import type { Proposal } from "../wire";
import type { Swipe } from "../zoom";
import { CameraView } from "./CameraView";

/** The proposal whose pictures are on the screen: `proposal` once they are decoded, until then the one before.
 * Those of `next` are fetched too. */
export function useDrawn(
  images: ImageStore,
  proposal: Proposal | null,
  next: Proposal | null = null,
): { drawn: Proposal | null; failed: boolean } {
  const version = useSyncExternalStore(images.subscribe, images.snapshot);
  const before = useRef<Proposal | null>(null);
  // biome-ignore lint/correctness/useExhaustiveDependencies: a new version may mean that a failed picture is due again
  useEffect(() => {
    for (const view of [...(next?.views ?? []), ...(proposal?.views ?? [])]) images.want(view);
  }, [images, proposal, next, version]);
  const ready = proposal?.views.every((view) => images.get(view.image)) ?? false;
  const drawn = ready ? proposal : before.current;
  useLayoutEffect(() => {
    before.current = drawn;
  });
  return { drawn, failed: proposal?.views.some((view) => images.failed(view.image)) ?? false };
}

export interface ViewsProps {
  images: ImageStore;
  frames: FrameSink;
  drawn: Proposal | null;
  failed: boolean;
  overlay: boolean;
  /** Whether a press counts now. */
  accepting: boolean;
  robot: number;
  live: number | null;
  moving: boolean;
  skill: string | null;
  empty: string;
  onSwipe?: (swipe: Swipe, press: Press) => void;
}

export function Views(props: ViewsProps) {
  const { drawn, overlay, live, failed } = props;
  const open = overlay && drawn !== null && !drawn.closed_at;
  if (!drawn)
    return (
      <div className="views" data-testid="views">
        {(["left", "right"] as const).map((side) => (
          <figure key={side} className="view" data-testid={`view-${side}`} style={{ aspectRatio: "4 / 3" }}>
            <div className="view-empty">
              {failed ? t("camera.noPicture") : side === "left" ? props.empty : ""}
            </div>
          </figure>
        ))}
      </div>
    );
  return (
    <div
      className="views"
      data-testid="views"
      data-proposal-id={open ? drawn.id : undefined}
      data-ready={open && props.accepting ? true : undefined}
    >
      {drawn.views.map((view, index) => (
        <CameraView
          key={view.camera}
          side={index === 0 ? "left" : "right"}
          view={view}
          picture={props.images.get(view.image)}
          skill={props.skill}
          proposalId={drawn.id}
          overlay={overlay}
          judged={Boolean(drawn.closed_at)}
          robot={props.robot}
          live={live}
          moving={props.moving}
          frames={props.frames}
          onSwipe={props.onSwipe}
        />
      ))}
      {failed && (
        <p role="alert" className="error">
          {t("camera.noNewPicture")}
        </p>
      )}
    </div>
  );
}
