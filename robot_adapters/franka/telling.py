"""What the arm, its cameras and the scene tell whoever keeps the robot safe: as it was seen last, nothing is asked."""

from __future__ import annotations

from robot_adapters.base import Telemetry
from robot_adapters.franka.arm import FrankaArm
from robot_adapters.franka.backend import WORDS
from robot_adapters.franka.limits import JointLimits
from robot_adapters.franka.scene_watch import SceneWatch


def tell(arm: FrankaArm, joint_limits: JointLimits, refusal: str | None, watch: SceneWatch) -> Telemetry:
    """The telemetry of now. refusal: why the cameras can't be relied on."""
    state, (scene, why) = arm.state, watch.told
    here, _ = arm.pose()
    x, y, z = (float(v) for v in here)
    fx, fy, fz = (float(v) for v in state.force)
    return Telemetry(
        joints=tuple(float(q) for q in state.joints),
        joint_limits=joint_limits,
        gripper=(x, y, z),
        opening=arm.gripper_width(),
        force=(fx, fy, fz),
        calibration="missing" if refusal else "measured",
        calibration_detail=refusal or "",
        scene=scene,
        scene_detail=why,
        mode=state.mode.value,
        words=WORDS[state.mode],
    )
