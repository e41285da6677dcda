#!/bin/bash
# How often printed intervals hold the truth: 4000 simulated studies a design, every design, then the least and the largest of each interval as a
# table. $1 is the build folder.
set -euo pipefail
out=$(REACHLAB_STUDIES=4000 "$1/tests/test_analysis" --gtest_filter='Coverage.*') || { echo "$out"; exit 1; }
echo "$out"
printf '\n| interval | designs | held the truth, %% |\n|---|---|---|\n'
grep '^|' <<< "$out" | awk -F ' *[|] *' '{ n[$2]++; if (n[$2] == 1 || $4 < low[$2]) low[$2] = $4; if ($4 > high[$2]) high[$2] = $4 }
  END { for (i in n) printf "| %s | %d | %s … %s |\n", i, n[i], low[i], high[i] }' | sort
