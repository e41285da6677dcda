#!/bin/bash
# Eight encrypted stations on one machine carry out one trial. $1 is the build folder.
set -euo pipefail
exec "$(dirname "$0")/eight_stations.py" "$1"
