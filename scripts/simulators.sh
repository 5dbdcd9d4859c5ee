#!/usr/bin/env bash
# Makes the virtual environments of the simulated robots that tests talk to: scripts/simulators.sh [PYTHON]
# Each needs versions of its own of numpy and MuJoCo, so none fits into the project's environment. Only tests use them.
set -euo pipefail
cd "$(dirname "$0")/.."

python=${1:-python3}
if [ "$(uname -s)-$(uname -m)" != Linux-x86_64 ]; then
    echo "no simulated Franka for this machine: its tests are skipped"
    exit 0
fi

environment() { # name, then what to install
    local folder=.simulators/$1 wanted="${*:2}"
    if [ "$(cat "$folder/.installed" 2>/dev/null)" = "$wanted" ]; then
        return
    fi
    echo "==> Installing the simulator $1"
    rm -rf "$folder"
    "$python" -m venv "$folder"
    "$folder/bin/pip" --disable-pip-version-check install --quiet "${@:2}"
    printf '%s' "$wanted" >"$folder/.installed"
}

# Both at once: each spends half of its time waiting for downloads and for its one core.
# the arm's interface with the hand, in MuJoCo; pin's newer and older majors have other names for what it uses
environment franky-sim franky-sim==1.0.4 mujoco==4.0.0 numpy==2.4.6 pin==4.1.0 &
first=$!
# the same interface, strict about late and lost commands
environment franka-sim franka-sim==1.1.7 mujoco==3.2.7 numpy==1.26.4 &
second=$!
wait "$first"
wait "$second"
