// The third view: the scene drawn from the state, to be turned around, because one picture doesn't tell distances.
import { useEffect, useRef, useState } from "react";
import { t } from "../i18n";
import { decimal } from "../i18n/numbers";
import type { SceneDrawing } from "../scene";
import { useTheme } from "../theme";
import type { Proposal, SceneInfo } from "../wire";
import { TurnLeft, TurnRight, Whole } from "./icons";

const TURN = Math.PI / 8;

export interface SceneViewProps {
  scene: SceneInfo | null;
  proposal: Proposal | null;
  /** Whether what it proposes may be drawn. */
  overlay: boolean;
}

/** Where it would act, in words: for those who don't see the picture. */
function inWords({ parameters }: Proposal): string {
  return Object.entries(parameters)
    .map(([name, value]) => `${name} ${decimal(value)}`)
    .join(", ");
}

export function SceneView({ scene, proposal, overlay }: SceneViewProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const drawing = useRef<SceneDrawing | null>(null);
  const [ready, setReady] = useState(false);
  const [failed, setFailed] = useState(false);
  const theme = useTheme();
  // biome-ignore lint/correctness/useExhaustiveDependencies: another theme has other colours
  useEffect(() => {
    const element = canvas.current;
    if (!element || !scene) return;
    let gone = false;
    const resized = new ResizeObserver(() =>
      drawing.current?.size(element.clientWidth, element.clientHeight),
    );
    import("../scene").then(
      (module) => {
        if (gone) return;
        try {
          drawing.current = new module.SceneDrawing(element, scene);
        } catch (error) {
          console.error("This browser can't draw in 3-D", error);
          setFailed(true);
          return;
        }
        drawing.current.size(element.clientWidth, element.clientHeight);
        resized.observe(element);
        setReady(true);
      },
      () => gone || setFailed(true),
    );
    return () => {
      gone = true;
      resized.disconnect();
      drawing.current?.dispose();
      drawing.current = null;
      setReady(false);
    };
  }, [scene, theme]);
  useEffect(() => {
    if (ready && proposal) drawing.current?.show(proposal, overlay);
  }, [ready, proposal, overlay]);
  return (
    <section className="card scene" aria-label={t("scene.label")} data-testid="scene" data-ready={ready}>
      <canvas
        ref={canvas}
        role="img"
        aria-label={proposal ? t("scene.what", { where: inWords(proposal) }) : t("scene.label")}
        key={theme}
      />
      {failed && <p className="view-empty">{t("scene.failed")}</p>}
      <span className="chip camera">{t("scene.chip")}</span>
      <div className="zoom">
        <button type="button" aria-label={t("scene.left")} onClick={() => drawing.current?.turn(-TURN)}>
          <TurnLeft />
        </button>
        <button type="button" aria-label={t("scene.right")} onClick={() => drawing.current?.turn(TURN)}>
          <TurnRight />
        </button>
        <button type="button" aria-label={t("scene.above")} onClick={() => drawing.current?.turn(0, TURN)}>
          <span aria-hidden="true">↑</span>
        </button>
        <button type="button" aria-label={t("scene.below")} onClick={() => drawing.current?.turn(0, -TURN)}>
          <span aria-hidden="true">↓</span>
        </button>
        <button type="button" aria-label={t("scene.home")} onClick={() => drawing.current?.home()}>
          <Whole />
        </button>
      </div>
    </section>
  );
}
