#!/bin/bash
# What can happen to two stations and to the line between them, live. $1 is the build folder; needs root.
set -euo pipefail
exec "$(dirname "$0")/station_faults.py" "$1"
