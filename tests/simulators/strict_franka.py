"""franka-sim: a second simulated Franka, strict about commands that come late or not at all, as the real FCI is.

Runs in a virtual environment of its own (`scripts/simulators.sh`): `python -m tests.simulators.strict_franka`. Its
model is franky-sim's, so that nothing is cloned; its end-effector frame is that of joint 7, 107 mm short of the flange.
"""

from __future__ import annotations

import argparse
import os
import signal
import sys
import tempfile
import threading
from pathlib import Path


def main() -> None:
    """Entry point; ends on SIGTERM."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--host", default="127.0.0.1")
    parser.add_argument("--assets", type=Path, required=True, help="franky-sim's folder of that name")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        model = Path(folder) / "fr3.xml"
        text = (given.assets / "fr3.xml").read_text()
        model.write_text(text.replace('meshdir="assets"', f'meshdir="{given.assets / "meshes"}"'))
        os.environ["FR3_MJCF"] = str(model)
        from franka_sim.franka_sim_server import FrankaSimServer  # noqa: PLC0415  reads the environment

        server = FrankaSimServer(host=given.host, enforce_comm_constraints=True, gripper_object_width=0.04)
        signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
        threading.Thread(target=server.start, daemon=True).start()
        print("ready", flush=True)
        signal.pause()


if __name__ == "__main__":
    main()
