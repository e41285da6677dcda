#!/bin/bash
# Every command of the manual that the default suite leaves out for its time; R over the exports too. $1 is the build folder.
set -euo pipefail
"$(dirname "$0")/../manual/commands.py" "$1/cli/reach" --long
