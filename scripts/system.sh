#!/usr/bin/env bash
# Installs the Debian packages that pip can't bring, where they are missing: scripts/system.sh run|test PYTHON
#   run   a C compiler with headers (evdev, which robosuite pulls in, has no wheel), software OpenGL, venv
#   test  Chromium, libusb for RealSense recordings, and nginx with openssl to stand in front, on top of those
# Asks apt only if something is missing; without the right to install, it says what to type.
set -euo pipefail

purpose=${1:?run or test}
python=${2:-python3}
missing=()

library() { # is a shared library known to the loader?
    { ldconfig -p 2>/dev/null || /sbin/ldconfig -p; } | grep -q -F "$1"
}

"$python" -c 'import ensurepip' 2>/dev/null || missing+=(python3-venv)
"$python" -c 'import os, sys, sysconfig; sys.exit(not os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h")))' ||
    missing+=(python3-dev)
command -v cc >/dev/null || missing+=(gcc libc6-dev)
[ -e /usr/include/linux/input.h ] || missing+=(linux-libc-dev)
library libEGL.so.1 || missing+=(libegl1)
library libEGL_mesa.so.0 || missing+=(libegl-mesa0)
library libOSMesa.so.8 || missing+=(libosmesa6)
library libGL.so.1 || missing+=(libgl1)
if [ "$purpose" = test ]; then
    command -v chromium >/dev/null || missing+=(chromium)
    PATH="$PATH:/usr/sbin" command -v nginx >/dev/null || missing+=(nginx-light)
    command -v openssl >/dev/null || missing+=(openssl)
    library libusb-1.0.so.0 || missing+=(libusb-1.0-0)
fi

[ ${#missing[@]} -eq 0 ] && exit 0

echo "==> Installing system packages: ${missing[*]}"
if [ "$(id -u)" = 0 ]; then
    as_root=()
elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
    as_root=(sudo -n)
else
    as_root=(no)
fi
if ! command -v apt-get >/dev/null || [ "${as_root[*]:-}" = no ]; then
    echo "These are missing, and can't be installed from here. Please run:" >&2
    echo "    sudo apt-get update && sudo apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
fi
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -q
"${as_root[@]}" apt-get install -y -q --no-install-recommends "${missing[@]}"
