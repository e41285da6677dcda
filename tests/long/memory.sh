#!/bin/bash
# What memory grows with the number of trials; REACHLAB_TRIALS says how many (10,000 and 100,000 take hours). $1 is the build folder.
set -euo pipefail
"$(dirname "${BASH_SOURCE[0]}")/memory.py" "$1" --trials "${REACHLAB_TRIALS:-500,3000}"
