#!/bin/bash
# Both programs of the release build are hardened, and what that costs a tick: the same sources without it, run beside them on one core.
# $1 is the build folder of development; REACHLAB_ROUNDS says how many turns. Only the flags are judged, the price is told.
set -euo pipefail
root=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
cd "$root"
hardened=build/release plain=build/unhardened
cmake --preset release -DREACHLAB_HARDENING=ON > /dev/null
cmake --build "$hardened" --target reach reachlab reachlab-bench > /dev/null
tests/house/hardening.py "$hardened/cli/reach" "$hardened/gui/reachlab"
cmake --preset release -B "$plain" -DREACHLAB_HARDENING=OFF -DREACHLAB_GUI=OFF -DBUILD_TESTING=OFF > /dev/null
cmake --build "$plain" --target reach reachlab-bench > /dev/null
tests/house/hardening.py "$plain/cli/reach" > /dev/null && { echo "hardening: the check passes a program without any"; exit 1; }
tests/long/paired_ticks.py "$plain/cli/reach" "$hardened/cli/reach" --rounds "${REACHLAB_ROUNDS:-15}"
