// Tells that the robot can't see what it has to, or that the scene isn't any more as on the picture that is judged.
import { t } from "../i18n";
import { said, sentence } from "../i18n/said";
import { type Telling, useTold } from "../telling";

export function SceneNotice({ telling, robot }: { telling: Telling; robot: number }) {
  const told = useTold(telling, robot);
  const scene = told?.scene;
  if (!told || !scene || scene === "clear") return null;
  return (
    <div className="banner calm scene-notice" role="status" data-testid="scene-notice" data-scene={scene}>
      <div>
        <b>{t(`sight.${scene}`)}</b> {sentence(said(told.scene_detail))} {t(`sight.${scene}What`)}
      </div>
    </div>
  );
}
