#!/bin/bash
# How late the ticks of 1 kHz are in the window and without it, with and without real-time priority: a table. $1 is the build folder.
set -euo pipefail
"$(dirname "${BASH_SOURCE[0]}")/lateness.py" "$1"
