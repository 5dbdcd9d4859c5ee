#!/usr/bin/env bash
# Installs the project editable, with pinned versions, into a virtual environment: scripts/install.sh VENV [EXTRA]
# The web page isn't built here: `make` does that by itself, so that its progress can be seen.
set -euo pipefail

venv=${1:?path of the virtual environment}
extra=${2:+[$2]}
pip="$venv/bin/pip --disable-pip-version-check"

SEED_SKIP_WEB=1 $pip install --constraint constraints.txt --editable ".$extra"

# robosuite asks for opencv-python, whose GUI build writes into the same cv2 folder as the headless one that works on
# a server. Keep one: the headless.
if [ -n "$($pip list --format=freeze 2>/dev/null | grep -E '^opencv-python==')" ]; then
    $pip uninstall --yes opencv-python
    $pip install --constraint constraints.txt --no-deps --force-reinstall opencv-python-headless
fi
if [ "$extra" = "[dev]" ]; then
    # biome, TypeScript and vitest need Node.js beyond the build of the page.
    node=$("$venv/bin/python" scripts/node.py --requirement)
    [ -z "$node" ] || $pip install "$node"
fi
