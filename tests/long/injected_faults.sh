#!/bin/bash
# Faults at every n-th system call; REACHLAB_FIRST and REACHLAB_SEEDED say how many of each kind (2000 and 500 take hours). $1 is the build folder.
set -euo pipefail
"$(dirname "${BASH_SOURCE[0]}")/injected_faults.py" "$1" --first "${REACHLAB_FIRST:-60}" --seeded "${REACHLAB_SEEDED:-15}"
