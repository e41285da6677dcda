#!/bin/bash
# Cost and scaling of studies, and the same bytes however one is divided. $1 is the build folder.
set -euo pipefail
exec "$(dirname "$0")/study_speed.py" "$1" --trials 1000,5000 --ways 2000 --rounds 2
