"""A process that moves an arm to and fro until something goes wrong, and tells what: it can be frozen.

`python -m tests.simulators.driver HOST BACKEND [DEOXYS_BIND]` says `moving`, then one JSON line with the fault, and
with the arm's mode after an operator has recovered it. With Deoxys, which takes any goal at any time, it is the
dead-man timer that ends the motion, as in the adapter.
"""

from __future__ import annotations

import json
import math
import sys

import numpy as np

from robot_adapters.franka import FrankaSettings, connecting
from robot_adapters.franka.arm import FrankaArm
from robot_adapters.franka.backend import ArmFault
from robot_adapters.franka.dead_man import DeadMan
from robot_adapters.franka.limits import Limits

FROZEN = 2.0
"""s of the dead-man timer with Deoxys: more than a busy machine takes."""
PATIENCE = 5.0
"""s: what a busy machine may need."""


def main() -> None:
    """Entry point; ends with the first fault."""
    host, backend, *bind = sys.argv[1:]
    given: dict[str, object] = {"host": host, "backend": backend, "realtime": False}
    settings = FrankaSettings.model_validate(given | ({"deoxys_bind": bind[0], "dead_man": FROZEN} if bind else {}))
    anywhere = Limits(np.array([-1.0, -1.0, 0.0]), np.array([1.0, 1.0, 1.2]), table=0.0)
    arm = FrankaArm(connecting.backend(settings), anywhere, silence=PATIENCE)
    dead_man = DeadMan(arm, settings.dead_man)
    if bind:
        arm.should_stop = dead_man.guarding(lambda: False)
    here, yaw = arm.pose()
    told: dict[str, str] = {}
    try:
        arm.begin()
        for i in range(10_000):
            arm.step(here + np.array([0.0, 0.08 * math.sin(i / 15), -0.05]), yaw, False)
            if i == 3:
                print("moving", flush=True)
            if arm.should_stop():
                told = {"mode": "stopped", "said": "by the dead-man timer"}
                break
    except ArmFault as fault:
        told = {"mode": fault.mode.value, "said": str(fault)}
    dead_man.close()
    arm.halt()
    arm.recover()
    print(json.dumps({**told, "after": arm.look().mode.value}), flush=True)
    arm.backend.close()


if __name__ == "__main__":
    main()
