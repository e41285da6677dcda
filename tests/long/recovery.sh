#!/bin/bash
# Does the analysis name what a simulated subject planned by, and nothing otherwise? See recovery.py. $1 is the build folder, then seeds.
set -euo pipefail
exec "$(dirname "${BASH_SOURCE[0]}")/recovery.py" "$@"
