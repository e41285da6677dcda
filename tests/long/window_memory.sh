#!/bin/sh
# Eight hours of trials in the window, on the virtual clock: memory may grow by 20 MB after the first hour.
#   tests/long/window_memory.sh [BUILD [HOURS]]
exec "$(dirname "$0")/../gui/under_xvfb" "${1:-build/dev}/tests/gui/day_memory" "${2:-8}"
