// The pictures of a practice proposal. The overlay comes only once its own picture is on the screen.

import { useLayoutEffect, useState } from "react";
import { at } from "../base";
import { cameraName, skillName, t } from "../i18n";
import type { Overlay, PracticeCard } from "../wire";
import { OverlayDrawing } from "./OverlayDrawing";

export interface PracticeViewsProps {
  card: PracticeCard;
  /** What would have been right, by camera, in the place of what was proposed. */
  overlays: Record<string, Overlay> | null;
  /** Its skill. */
  right: string | null;
  onDrawn: () => void;
}

export function PracticeViews({ card, overlays, right, onDrawn }: PracticeViewsProps) {
  const [loaded, setLoaded] = useState<readonly string[]>([]);
  const all = card.views.every(({ camera }) => loaded.includes(camera));
  // in the same frame: a press on what can be seen counts
  // biome-ignore lint/correctness/useExhaustiveDependencies: told once, when the last picture is there
  useLayoutEffect(() => {
    if (all) onDrawn();
  }, [all]);
  return (
    <div className="views" data-testid="views" data-ready={all}>
      {card.views.map((view) => (
        <figure
          key={view.camera}
          className="view"
          style={{ aspectRatio: `${view.width} / ${view.height}` }}
          data-right={overlays !== null}
        >
          <img
            src={at(view.url)}
            alt={t("camera.still", { camera: view.camera })}
            onLoad={() => setLoaded((known) => [...known, view.camera])}
          />
          {all && (
            <OverlayDrawing
              overlay={overlays?.[view.camera] ?? view.overlay}
              width={view.width}
              height={view.height}
              judged={false}
              ghost={true}
            />
          )}
          <span className="chip skill">
            {overlays && right
              ? t("practice.rightSkill", { skill: skillName(right) })
              : skillName(card.skill)}
          </span>
          <span className="chip camera">{cameraName(view.camera)}</span>
        </figure>
      ))}
    </div>
  );
}
