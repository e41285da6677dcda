#!/bin/sh
# Eight hours of trials in the window, on the virtual clock. Memory may grow by 20 MB after the first hour, and by 10 kB per trial of a run
# of 500 trials or more.
#   tests/long/window_memory.sh [BUILD [HOURS [TRIALS_PER_RUN]]]
exec "$(dirname "$0")/../gui/under_xvfb" "${1:-build/dev}/tests/gui/day_memory" "${2:-8}" "${3:-200}"
