#!/bin/bash
# A whole session at the window by real keys under a virtual display with a window manager: the paper's plan with five trials a block, with a
# break, a repeat taken back, an abort, a crash and a resume; then its recording is inspected and a figure exported. At several sizes and
# scales of the screen. Prints a line a size; exits 1 when something is not as it should be.
#   tests/long/window_session.sh [BUILD [PICTURES]]   PICTURES: a folder for pictures on the way
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${1:-build/dev}
pictures=${2:-}
for tool in Xvfb openbox xdotool import; do
  command -v "$tool" > /dev/null || { echo "window_session: $tool is missing; packaging/packages-test.txt names its package" >&2; exit 2; }
done
[[ -z $pictures ]] || mkdir -p "$pictures"
work=$(mktemp -d)
export QT_QPA_PLATFORM=xcb LIBGL_ALWAYS_SOFTWARE=1 XDG_RUNTIME_DIR=$work
unset DISPLAY
trap 'kill $(jobs -p) 2> /dev/null || true; wait 2> /dev/null || true; rm -rf "$work"' EXIT
for pace in slow moderate fast; do  # trials that count however busy this machine is
  sed 's/"schema_version": 1,/"schema_version": 1, "timing": { "max_missed_ticks": 10000000, "max_gap_s": 7200 },/' "resources/experiments/chain-$pace.json" > "$work/chain-$pace.json"
done
cat > "$work/short.json" << 'P'
{ "schema_version": 1, "name": "short", "order_seed": 2013, "counterbalance": "permute", "pause_s": 0.2, "foreperiod_s": [0.1, 0.3],
  "blocks": [
    { "experiment": "chain-slow.json", "trials": 5, "condition": "slow", "instructions": "Reach slowly." },
    { "experiment": "chain-moderate.json", "trials": 5, "condition": "moderate", "rest_s": 3, "instructions": "Now a little faster." },
    { "experiment": "chain-fast.json", "trials": 5, "condition": "fast", "rest_s": 3, "instructions": "And now fast." }] }
P

named() {
  local found
  for _ in $(seq 300); do
    found=$(xdotool search --onlyvisible --name "$1" 2> /dev/null | tail -1) && [[ -n $found ]] && { echo "$found"; return; }
    sleep 0.2
  done
  echo "window_session: no window named $1" >&2
  return 1
}
begin() {
  "$build/gui/reachlab" "$@" 2> "$work/said" & window=$!
  id=$(named 'Reachlab$')
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
  rm -f "$work/display"
  Xvfb -displayfd 3 -screen 0 "${size%@*}x24" -noreset 3> "$work/display" 2> /dev/null & server=$!
  until [[ -s $work/display ]]; do sleep 0.1; done
  export DISPLAY=:$(< "$work/display")
  openbox 2> /dev/null & manager=$!
  sleep 0.5
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
  kill $window; wait $window 2> /dev/null || true
  read -r all judged conditions <<< "$(count)"
  [[ $conditions -eq 3 ]] || fault+=" $conditions conditions;"
  [[ $judged -ge 14 ]] || fault+=" $judged trials judged;"
  begin "$data"
  key ctrl+a; sleep 10
  picture 6-inspect
  kill $window; wait $window 2> /dev/null || true
  echo "${fault:+BAD }$size: $all trials, $judged judged, $conditions conditions, $before before the crash${fault:+;$fault}"
  [[ -z $fault ]] || bad=1
  kill $manager $server 2> /dev/null || true
  wait $manager $server 2> /dev/null || true
done
exit $bad
