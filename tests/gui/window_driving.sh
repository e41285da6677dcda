# What scripts begin with that drive the window by real events under an X server of their own. Sourced in the repository's root, under
# set -euo pipefail. Makes the folder $work, which goes when the script ends, with all that it has started.
script=$(basename "$0" .sh)

# need TOOL…: the script ends where one is missing.
need() {
  local tool
  for tool; do
    command -v "$tool" > /dev/null || { echo "$script: $tool is missing; packaging/packages-{test,all}.txt name its package" >&2; exit 2; }
  done
}

work=$(mktemp -d)
trap 'kill $(jobs -p) 2> /dev/null || true; wait 2> /dev/null || true; rm -rf "$work"' EXIT
export QT_QPA_PLATFORM=xcb LIBGL_ALWAYS_SOFTWARE=1 XDG_RUNTIME_DIR=$work
unset DISPLAY

# begin_server COMMAND…: an X server, once it has said its number. Without -noreset it would reset when a program's last window closes.
begin_server() {
  rm -f "$work/display"
  "$@" -displayfd 3 -noreset 3> "$work/display" > "$work/server" 2>&1 & server=$!
  until [[ -s $work/display ]]; do
    kill -0 $server 2> /dev/null ||
      { echo "$script: no X server: $(grep -m1 '(EE) [[:alnum:]]' "$work/server" || tail -1 "$work/server")" >&2; exit 2; }
    sleep 0.1
  done
  export DISPLAY=:$(< "$work/display")
}
begin_manager() { openbox > /dev/null 2>&1 & manager=$!; sleep 1; }
# begin_display WIDTHxHEIGHT, end_display: one that nobody sees, with a window manager.
begin_display() { begin_server Xvfb -screen 0 "$1x24"; begin_manager; }
end_display() { kill $manager $server 2> /dev/null || true; wait $manager $server 2> /dev/null || true; }

# window_named PATTERN: its number, once it is there. Windows that vanish while xdotool looks at them make it fail: it is asked again.
window_named() {
  local found
  for _ in $(seq 300); do
    found=$(xdotool search --onlyvisible --name "$1" 2> /dev/null | tail -1) && [[ -n $found ]] && { echo "$found"; return; }
    sleep 0.2
  done
  echo "$script: no window named $1" >&2
  return 1
}
# Of the program $window.
close_window() { kill $window; wait $window 2> /dev/null || true; }

# patient EXPERIMENT [KEYS]: a shipped experiment, with further keys, whose trials count however busy this machine is; prints where it is.
patient() {
  local file=$work/${1##*/}.json
  sed "s/\"schema_version\": 1,/\"schema_version\": 1, ${2:-}\"timing\": { \"max_missed_ticks\": 10000000, \"max_gap_s\": 7200 },/" \
    "resources/experiments/$1.json" > "$file"
  echo "$file"
}
