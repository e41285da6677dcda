#!/bin/bash
# The subject's screen on a second monitor, by RandR: an X server with the dummy driver and two outputs. At three scales: the window keeps to
# the first monitor, the subject's screen fills the one that is chosen by name, which is remembered at the next start, and comes back when its
# monitor is switched off. Prints a line a scale; exits 1 when something is not as it should be.
#   tests/long/window_monitors.sh [BUILD [PICTURES]]   PICTURES: a folder for pictures on the way
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${1:-build/dev}
pictures=${2:-}
source tests/gui/window_driving.sh
need Xorg xrandr openbox xdotool xwininfo import
[[ -z $pictures ]] || mkdir -p "$pictures"
cat > "$work/xorg.conf" << 'C'
Section "Device"
  Identifier "card"
  Driver "dummy"
  VideoRam 256000
EndSection
Section "Monitor"
  Identifier "monitor"
  HorizSync 5-1000
  VertRefresh 5-200
EndSection
Section "Screen"
  Identifier "screen"
  Device "card"
  Monitor "monitor"
  DefaultDepth 24
  SubSection "Display"
    Virtual 3840 2160
  EndSubSection
EndSection
C
begin_server Xorg -config "$work/xorg.conf" -logfile "$work/xorg.log" -novtswitch -sharevts -nolisten tcp
xrandr --addmode DUMMY1 1280x1024
both() {  # the second call has the server look at what is connected now
  xrandr --output DUMMY0 --mode 1920x1080 --pos 0x0 --output DUMMY1 --mode 1280x1024 --pos 1920x0
  xrandr > /dev/null
}
both
begin_manager

begin() {
  "$build/gui/reachlab" dingwell --device simulated --data "$work/data" --seed 1 2> /dev/null & window=$!
  main=$(window_named 'Reachlab$')
  xdotool windowactivate --sync "$main"
  sleep 3
}
place() { xwininfo -id "$1" | sed -n 's/.*Absolute upper-left [XY]: *\|^  Width: \|^  Height: //p' | paste -sd' '; }
picture() { [[ -z $pictures ]] || import -silent -window root -depth 8 PNG24:"$pictures/$scale-$1.png"; }
choose() {  # the monitor by its place in the menu, from 0; the keys go to the window that has them
  xdotool windowactivate --sync "$main"
  xdotool key --clearmodifiers alt+v; sleep 0.5
  xdotool key o; sleep 0.5
  for _ in $(seq "$1"); do xdotool key Down; sleep 0.05; done
  picture "menu$1"
  xdotool key Return; sleep 2
}
is() {  # is WHAT WINDOW PLACE
  local found
  for _ in $(seq 20); do
    found=$(place "$2")
    [[ $found == "$3" ]] && return
    sleep 0.2
  done
  fault+=" $1 at $found, not $3;"
}

first="0 0 1920 1080" second="1920 0 1280 1024" bad=0
for scale in 1 1.5 2; do
  export QT_SCALE_FACTOR=$scale XDG_CONFIG_HOME=$work/config-$scale XDG_CACHE_HOME=$work/cache-$scale
  fault=
  begin
  read -r x y w h <<< "$(place "$main")"
  [[ $x -ge 0 && $((x + w)) -le 1920 && $((y + h)) -le 1080 ]] || fault+=" the window stands at $x $y $w $h;"
  xdotool key F11; sleep 2
  subject=$(window_named subject)
  is "the subject's screen, unasked," "$subject" "$second"
  picture unasked
  choose 0
  is "the subject's screen, sent to the first monitor," "$(window_named subject)" "$first"
  close_window
  begin
  xdotool key F11; sleep 2
  is "the subject's screen, at the next start," "$(window_named subject)" "$first"
  choose 1
  is "the subject's screen, sent to the second monitor," "$(window_named subject)" "$second"
  picture chosen
  xrandr --output DUMMY1 --off; sleep 3
  kill -0 $window 2> /dev/null || fault+=" it fell when the monitor was switched off;"
  is "the subject's screen, its monitor switched off," "$(window_named subject)" "$first"
  picture off
  close_window
  both; sleep 1
  echo "${fault:+BAD }scale $scale: window $w x $h at $x, $y${fault:+;$fault}"
  [[ -z $fault ]] || bad=1
done
exit $bad
