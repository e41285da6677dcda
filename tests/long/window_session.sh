#!/bin/bash
# A whole session at the window by real keys under a virtual display with a window manager: the paper's plan with five trials a block, with a
# break, a repeat taken back, an abort, a crash and a resume; then its recording is inspected and a figure exported. At several sizes and
# scales of the screen. Prints a line a size; exits 1 when something is not as it should be.
#   tests/long/window_session.sh [BUILD [PICTURES]]   PICTURES: a folder for pictures on the way
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${1:-build/dev}
pictures=${2:-}
source tests/gui/window_driving.sh
need Xvfb openbox xdotool import
[[ -z $pictures ]] || mkdir -p "$pictures"
for pace in slow moderate fast; do patient "chain-$pace" > /dev/null; done
cat > "$work/short.json" << 'P'
{ "schema_version": 1, "name": "short", "order_seed": 2013, "counterbalance": "permute", "pause_s": 0.2, "foreperiod_s": [0.1, 0.3],
  "blocks": [
    { "experiment": "chain-slow.json", "trials": 5, "condition": "slow", "instructions": "Reach slowly." },
    { "experiment": "chain-moderate.json", "trials": 5, "condition": "moderate", "rest_s": 3, "instructions": "Now a little faster." },
    { "experiment": "chain-fast.json", "trials": 5, "condition": "fast", "rest_s": 3, "instructions": "And now fast." }] }
P

begin() {
  "$build/gui/reachlab" "$@" 2> "$work/said" & window=$!
  id=$(window_named 'Reachlab$')
  xdotool windowactivate --sync "$id"
  sleep 3
}
key() { xdotool key --clearmodifiers "$1"; sleep 0.5; }
picture() { [[ -z $pictures ]] || import -silent -window root -depth 8 PNG24:"$pictures/$size-$1.png"; }
count() { /usr/bin/python3 - "$data" "$build/cli/reach" << 'P'
import csv, pathlib, subprocess, sys, tempfile
with tempfile.TemporaryDirectory() as out:
    done = subprocess.run([sys.argv[2], "export", sys.argv[1], "--format", "csv", "--out", out], capture_output=True)
    table = pathlib.Path(out) / "trials.csv"
    rows = list(csv.DictReader(table.open())) if table.exists() else []
print(len(rows), sum(r["outcome"] in ("success", "failure") for r in rows), len({r["condition"] for r in rows}))
P
}
waits() {  # waits SECONDS FOR_HOW_MANY_JUDGED
  for _ in $(seq "$1"); do
    read -r _ judged _ <<< "$(count)"
    [[ $judged -ge $2 ]] && return 0
    sleep 1
  done
  return 1
}

bad=0
for size in 1366x768@1 1920x1080@1.5 1920x1080@2; do
  export QT_SCALE_FACTOR=${size#*@} XDG_CONFIG_HOME=$work/config-$size XDG_CACHE_HOME=$work/cache-$size
  begin_display "${size%@*}"
  data=$work/data-$size
  fault=
  begin "$work/short.json" --data "$data" --device simulated --subject 01 --seed 1
  picture 1-start
  key space                          # first block: trials follow by the plan's own pause
  waits 90 2 || fault+=" no two trials;"
  key ctrl+r                         # a repeat, and taken back again by the next lines: the session keeps 15
  picture 2-block
  key Escape                         # whatever is under way is aborted, and repeated by nobody
  sleep 3
  kill -9 $window; wait $window 2> /dev/null || true   # the crash
  read -r before _ _ <<< "$(count)"
  begin "$work/short.json" --data "$data" --device simulated --subject 01 --seed 1
  picture 3-resume
  key space                          # resumes where it broke off
  for block in 1 2 3; do
    waits 240 $((block * 5 - 1)) || fault+=" block $block was not done;"
    sleep 2
    [[ $block -eq 1 ]] && picture 4-rest
    sleep 4                          # the plan rests three seconds
    key space
  done
  sleep 3
  picture 5-end
  key ctrl+e
  close_window
  read -r all judged conditions <<< "$(count)"
  [[ $conditions -eq 3 ]] || fault+=" $conditions conditions;"
  [[ $judged -ge 14 ]] || fault+=" $judged trials judged;"
  begin "$data"
  key ctrl+a; sleep 10
  picture 6-inspect
  close_window
  echo "${fault:+BAD }$size: $all trials, $judged judged, $conditions conditions, $before before the crash${fault:+;$fault}"
  [[ -z $fault ]] || bad=1
  end_display
done
exit $bad
