// What a robot tells of itself: joints within their limits, the gripper, the force at the hand, its cameras.
import { t } from "../i18n";
import { decimal } from "../i18n/numbers";
import { type Telling, useTold } from "../telling";
import type { Telemetry } from "../wire";

/** N that fill the bar: twice what stops a careful push. */
const STRONG = 40;

const degrees = (radians: number) => `${decimal((radians * 180) / Math.PI, 0)}°`;

function Joint({ at, number, limits }: { at: number; number: number; limits: [number, number] | undefined }) {
  const [low, high] = limits ?? [-Math.PI, Math.PI];
  const share = Math.min(1, Math.max(0, (at - low) / (high - low)));
  const near = Math.min(share, 1 - share) < 0.05;
  return (
    <div className="bar-row" data-near={near} title={near ? t("operator.nearLimit") : undefined}>
      <span className="soft">{t("operator.joint", { number })}</span>
      <div className="track" aria-hidden="true">
        <i className="here" style={{ left: `${100 * share}%` }} />
      </div>
      <b>{degrees(at)}</b>
    </div>
  );
}

function Force({ force }: { force: [number, number, number] }) {
  const strength = Math.hypot(...force);
  return (
    <div className="bar-row">
      <span className="soft">{t("operator.force")}</span>
      <div className="track" aria-hidden="true">
        <i
          data-tone={strength > STRONG / 2 ? "bad" : undefined}
          style={{ left: 0, width: `${Math.min(100, (100 * strength) / STRONG)}%` }}
        />
      </div>
      <b data-testid="force">{`${decimal(strength, 1)} N`}</b>
    </div>
  );
}

function Calibration({ told }: { told: Telemetry }) {
  if (!told.calibration) return null;
  return (
    <p className={told.calibration === "missing" ? "warning-text" : "hint"} data-testid="camera-calibration">
      {t(`operator.calibration_${told.calibration}`)} {told.calibration_detail}
    </p>
  );
}

export function ReadOuts({ telling, robot }: { telling: Telling; robot: number }) {
  const told = useTold(telling, robot);
  if (!told) return <p className="soft">{t("operator.silent")}</p>;
  return (
    <div className="read-outs" data-testid="read-outs">
      {told.joints.map((at, index) => (
        <Joint key={index} at={at} number={index + 1} limits={told.joint_limits[index]} />
      ))}
      {told.force && <Force force={told.force} />}
      {told.gripper && (
        <p className="number" data-testid="gripper-at">
          {t("operator.gripper", {
            x: decimal(told.gripper[0]),
            y: decimal(told.gripper[1]),
            z: decimal(told.gripper[2]),
          })}
          {told.opening !== null && ` ${t("operator.opening", { width: decimal(100 * told.opening, 1) })}`}
        </p>
      )}
      <Calibration told={told} />
    </div>
  );
}
