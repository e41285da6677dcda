#!/bin/bash
# Does `reach analyze` name the criterion that a simulated subject planned by? 30 trials of five experiments and seven truths with each seed.
# $1 is the build folder, then seeds (default 1001 … 1010). Prints a line a set and the sums; fails when any set is decided for a wrong
# criterion, or fewer than 45 % of the sets with ten successes or more are named.
set -uo pipefail
reach=$(realpath "$1")/cli/reach
shift
seeds=("$@")
[ ${#seeds[@]} -gt 0 ] || seeds=(1001 1002 1003 1004 1005 1006 1007 1008 1009 1010)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export reach work
one() {
  experiment=$1 device=$2 truth=$3 seed=$4
  data=$work/$experiment-$truth-$seed-$RANDOM
  # A massless hand that jumps may never come to rest: at most a minute and 60 MB a set, the rest of the trials is lost.
  (ulimit -f 60000; timeout 60 "$reach" run "$experiment" --device "$device" --trials 30 --seed "$seed" --fast --data "$data" > /dev/null 2>&1)
  "$reach" analyze "$data" --json 2> /dev/null | python3 -c '
import json, sys
experiment, device, truth, seed = sys.argv[1:]
try:
    j = json.load(sys.stdin)
except ValueError:
    print("SET", experiment, device, seed, "0", "nothing", "-")
    sys.exit()
c = j["conclusion"]
n = j["conditions"][0]["success"]
named = [c["criterion"]] + c["equivalent"] if c["decided"] else []
verdict = "right" if truth in named else "WRONG" if named else "undecided"
print("SET", experiment, device, seed, n, verdict, c["reason"] or named[0])
' "$experiment" "$device" "$truth" "$seed"
  rm -rf "$data"
}
export -f one
for seed in "${seeds[@]}"; do
  for experiment in chain-slow chain-moderate chain-fast dingwell parallel; do
    for truth in min-hand-jerk min-torque-change min-crackle min-hand-crackle min-hand-force,hand-mass=1 min-hand-force-change,hand-mass=0 \
                 min-hand-force-change,hand-mass=1; do
      echo "$experiment simulated:criterion=$truth ${truth%%,*} $seed"
    done
  done
done | xargs -P "$(nproc)" -L 1 bash -c 'one "$@"' _ | tee "$work/sets"
awk '/^SET/ { n++; v[$6]++; if ($5 >= 10) { enough++; if ($6 == "right") right++ } }
  END { printf "%d sets: %d right, %d wrong, %d undecided; %d with ten successes, %.0f %% of them named\n", n, v["right"], v["WRONG"], n - v["right"] - v["WRONG"], enough, 100 * right / enough
        exit v["WRONG"] > 0 || right < 0.45 * enough }' "$work/sets"
