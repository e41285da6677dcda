#!/bin/bash
# Two stations over a link with delay, jitter and loss: how far their copies are apart. $1 is the build folder; needs root.
set -euo pipefail
exec "$(dirname "$0")/station_faults.py" "$1" link_50 link_100 link_50_noise link_100_noise loss_30
