#!/bin/bash
# Two windows on one machine move the five masses from both ends, under a virtual display with a window manager: at first two simulated
# people, until two trials have succeeded; a third window observes for a trial. Then the conductor's hand is the mouse, moved by real events
# along the way of the simulated person's, and the other's a simulated partner, until a trial has succeeded. Both logs are computed again,
# and made into one. Last the partner's window is closed, and the conductor's arms nothing and says why. Prints what came of it; exits 1
# when something is not as it should be.
#   tests/long/station_windows.sh [BUILD [PICTURES]]   PICTURES: a folder for pictures on the way
set -euo pipefail
cd "$(dirname "$0")/../.."
build=$(realpath "${1:-build/dev}")
pictures=${2:-}
source tests/gui/window_driving.sh
need Xvfb openbox xdotool import
[[ -z $pictures ]] || mkdir -p "$pictures"
patient two-hands/chain-two-hands > /dev/null
begin_display 2400x1060

# window_at NUMBER ARGUMENTS…: becomes a window whose dataset and settings have this number.
window_at() {
  cd "$work"
  XDG_CONFIG_HOME=$work/config$1 exec "$build/gui/reachlab" chain-two-hands.json --insecure --interface lo --peer 127.0.0.1 \
    --domain $(($$ % 230)) --data "data$1" "${@:2}"
}
# begin NUMBER X ARGUMENTS…: one station's window, in its half of the screen.
begin() {
  local number=$1 x=$2 known=" $(xdotool search --onlyvisible --name 'Reachlab$' 2> /dev/null | tr '\n' ' ')" found
  shift 2
  window_at "$number" --station "$number" --name "station$number" --seed 1 "$@" 2> "$work/said$number" &
  window=$!
  for _ in $(seq 300); do
    for found in $(xdotool search --onlyvisible --name 'Reachlab$' 2> /dev/null); do
      [[ $known == *" $found "* ]] && continue
      id=$found
      xdotool windowactivate --sync "$id"
      sleep 1
      xdotool key --clearmodifiers alt+2  # the layout in which one runs
      sleep 1
      xdotool windowsize --sync "$id" 1194 960 windowmove --sync "$id" "$x" 24
      sleep 1
      xdotool mousemove --window "$id" 700 330 click 1  # Space begins a trial only in the scene
      return
    done
    kill -0 $window || { cat "$work/said$number" >&2; exit 1; }
    sleep 0.2
  done
  echo "station_windows: no window of station $number" >&2
  exit 1
}
picture() { [[ -z $pictures ]] || import -silent -window root -depth 8 PNG24:"$pictures/$1.png"; }
# outcomes STATION WORDS: how many of its trials ended so, by its own log.
outcomes() { "$build/cli/reach" show "$work"/data"$1"/sourcedata/*_log.reach 2> /dev/null | grep -cE "^ +[0-9]+ +$2" || true; }
all='(success|failure|aborted|interrupted)'
fault=
check() { "${@:2}" || { echo "BAD: $1"; fault=1; }; }

ended() { for _ in $(seq 150); do [[ $(outcomes 1 "$all") -ge $1 && $(outcomes 2 "$all") -ge $1 ]] && return 0; sleep 0.2; done; return 1; }
told() { for number in 1 2; do echo "$1, station $number: $(outcomes $number success) of $(outcomes $number "$all") trials succeeded"; done; }
key() { xdotool windowactivate --sync "$conductor" key "$1"; }
# Ends the run, and computes each copy again from its own log.
close_run() {
  key ctrl+e
  sleep 1
  xdotool key Tab space  # trials are left: *End the run*, which is not the usual choice
  sleep 3
  for number in 1 2; do
    "$build/cli/reach" replay "$work"/data$number/sourcedata/*_log.reach --check > "$work/replayed$number" || check "station $number's log replays" false
    echo "$1, station $number: $(tail -1 "$work/replayed$number")"
  done
  "$build/cli/reach" merge "$work"/data[12]/sourcedata/*_log.reach --data "$work/together-$1" > "$work/merged" 2>&1 ||
    { cat "$work/merged"; check "the logs are one run" false; }
}

begin 1 0 --conductor --device simulated --trials 20; conductor=$id first=$window
begin 2 1202 --device partner:follower; partner=$window
sleep 6
picture 1-both-there
tries=0
until [[ $(outcomes 1 success) -ge 2 || $tries -ge 8 ]]; do
  tries=$((tries + 1))
  sleep 2
  key space
  check "trial $tries ends at both stations" ended $tries
  picture "2-simulated-$tries"
done
told simulated
check "two trials succeed" test "$(outcomes 1 success)" -ge 2

# A third window observes: it sees them move, and nothing of it is recorded.
before=$(outcomes 1 "$all")
window_at 3 --observe 2> "$work/said3" & observer=$!
seen=
for _ in $(seq 100); do seen=$(xdotool search --onlyvisible --name 'observing' 2> /dev/null | head -1 || true); [[ -n $seen ]] && break; sleep 0.2; done
check "a third window observes" test -n "$seen"
sleep 5
key space
sleep 2.2
[[ -z $pictures || -z $seen ]] || import -silent -window "$seen" -depth 8 PNG24:"$pictures/2-looking-on.png"
check "a trial that is looked at ends at both stations" ended $((before + 1))
sleep 1
[[ -z $pictures || -z $seen ]] || import -silent -window "$seen" -depth 8 PNG24:"$pictures/2-looked-on.png"
kill $observer; wait $observer 2> /dev/null || true
check "an observer records nothing" test ! -e "$work/data3"
close_run simulated
/usr/bin/python3 tests/long/mouse_reach.py way "$work/data1" "$work/way"
picture 3-run-ended
kill $first $partner; wait $first $partner 2> /dev/null || true
rm -r "$work"/data[12]

begin 1 0 --conductor --device mouse --trials 20; conductor=$id
begin 2 1202 --device partner:follower; partner=$window
sleep 6
# Where the masses and the yellow target are in the conductor's scene: the hand moves by as much as the pointer.
import -silent -window "$conductor" -depth 8 "$work/scene.ppm"
read -r start target row <<< "$(/usr/bin/python3 - "$work/scene.ppm" << 'P'
import sys
data = open(sys.argv[1], "rb").read()
width, height = (int(n) for n in data.split(maxsplit=4)[1:3])
pixels = data[-3 * width * height:]
def columns(is_it, rows):
    return sorted((x, y) for y in rows for x in range(int(0.34 * width), width) if is_it(*pixels[3 * (y * width + x):3 * (y * width + x) + 3]))
yellow = columns(lambda r, g, b: r > 190 and g > 150 and b < 130 and r - b > 90 and r - g < 70, range(int(0.12 * height), int(0.62 * height)))
target, row = yellow[len(yellow) // 2]
masses = columns(lambda r, g, b: b > 130 and b - r > 70 or r > 150 and r - b > 90 and r - g > 60, range(row - 25, row + 25))
masses = [x for x, _ in masses if x < target - 60]
print(masses[len(masses) // 2], target, row)
P
)"
echo "masses at $start, target at $target, row $row of the conductor's window"

reach() { /usr/bin/python3 tests/long/mouse_reach.py "$@"; }
xdotool windowactivate --sync "$conductor" mousemove --window "$conductor" "$start" "$row" mousedown 1
tries=0
until [[ $(outcomes 1 success) -ge 1 || $tries -ge 5 ]]; do
  tries=$((tries + 1))
  sleep 1
  xdotool key --window "$conductor" space
  check "trial $tries begins" reach go "$work/data1" $tries
  (for shot in a b c; do sleep 0.4; picture "4-mouse-$tries-$shot"; done) &
  shots=$!
  reach drag "$work/way" "$start" "$target"
  check "trial $tries ends at both stations" ended $tries
  wait $shots
  picture "5-after-$tries"
  reach back "$start" "$target"
done
xdotool mouseup 1
check "a trial with the mouse succeeds" test "$(outcomes 1 success)" -ge 1
told mouse

# The partner's window is closed: the conductor's says who is missing, and arms nothing.
kill $partner; wait $partner 2> /dev/null || true
sleep 4
before=$(outcomes 1 "$all")
key space
sleep 4
picture 6-alone
check "nothing is armed without the partner" test "$(outcomes 1 "$all")" -eq "$before"
close_run mouse
exit ${fault:-0}
