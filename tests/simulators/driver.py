"""A process that moves an arm to and fro until something goes wrong, and tells what: it can be frozen.

`python -m tests.simulators.driver HOST BACKEND` says `moving`, then one JSON line with the fault, and with the arm's
mode after an operator has recovered it.
"""

from __future__ import annotations

import json
import math
import sys

import numpy as np

from robot_adapters.franka import FrankaSettings, connecting
from robot_adapters.franka.arm import FrankaArm
from robot_adapters.franka.backend import ArmFault
from robot_adapters.franka.limits import Limits

PATIENCE = 5.0
"""s: what a busy machine may need."""


def main() -> None:
    """Entry point; ends with the first fault."""
    host, backend = sys.argv[1:3]
    settings = FrankaSettings.model_validate({"host": host, "backend": backend, "realtime": False})
    anywhere = Limits(np.array([-1.0, -1.0, 0.0]), np.array([1.0, 1.0, 1.2]), table=0.0)
    arm = FrankaArm(connecting.backend(settings), anywhere, silence=PATIENCE)
    here, yaw = arm.pose()
    told: dict[str, str] = {}
    try:
        arm.begin()
        for i in range(10_000):
            arm.step(here + np.array([0.0, 0.08 * math.sin(i / 15), -0.05]), yaw, False)
            if i == 3:
                print("moving", flush=True)
    except ArmFault as fault:
        told = {"mode": fault.mode.value, "said": str(fault)}
    arm.halt()
    arm.recover()
    print(json.dumps({**told, "after": arm.look().mode.value}), flush=True)
    arm.backend.close()


if __name__ == "__main__":
    main()
