#!/bin/bash
# Proves that go, success and failure are heard: the window runs under a virtual display with a PulseAudio null sink, and what the sink was
# given is looked at. Prints a line a cue; exits 1 when one is not heard, or is heard where it should not be.
#   tests/long/window_sounds.sh [BUILD]
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${1:-build/dev}
for tool in Xvfb openbox xdotool pulseaudio parec /usr/bin/python3; do
  command -v "$tool" > /dev/null || { echo "window_sounds: $tool is missing; packaging/packages-all.txt names its package" >&2; exit 2; }
done
work=$(mktemp -d)
export XDG_RUNTIME_DIR=$work XDG_CONFIG_HOME=$work XDG_CACHE_HOME=$work QT_QPA_PLATFORM=xcb LIBGL_ALWAYS_SOFTWARE=1
export PULSE_SERVER=unix:$work/pulse.sock
unset DISPLAY
Xvfb -displayfd 3 -screen 0 1366x768x24 -noreset 3> "$work/display" 2> /dev/null &
trap 'kill $(jobs -p) 2> /dev/null || true; wait 2> /dev/null || true; rm -rf "$work"' EXIT
until [[ -s $work/display ]]; do sleep 0.1; done
export DISPLAY=:$(< "$work/display")
openbox > /dev/null 2>&1 &
pulseaudio -n --exit-idle-time=-1 -L "module-native-protocol-unix socket=$work/pulse.sock auth-anonymous=1" \
  -L "module-null-sink sink_name=t rate=44100" 2> /dev/null &
until [[ -S $work/pulse.sock ]]; do sleep 0.1; done

# listen NAME VOLUME EXPERIMENT NOISE SECONDS [TRIALS]: trials of a simulated hand in the window, and what was heard meanwhile.
listen() {
  mkdir -p "$work/reachlab"
  printf '[sound]\nvolume=%s\n' "$2" > "$work/reachlab/reachlab.conf"
  "$build/gui/reachlab" "$3" --device "simulated:noise=$4" --trials "${6:-1}" --data "$work/data-$1" --seed 1 2> /dev/null & window=$!
  id=
  until [[ -n $id ]]; do sleep 0.3; id=$(xdotool search --onlyvisible --name 'Reachlab$' 2> /dev/null | tail -1 || true); done
  xdotool windowactivate --sync "$id"
  sleep 4
  parec -d t.monitor --format=s16le --rate=44100 --channels=1 > "$work/$1.raw" & ear=$!
  until [[ -s $work/$1.raw ]]; do sleep 0.2; done  # it listens
  for _ in $(seq "${6:-1}"); do
    xdotool key --clearmodifiers space
    sleep "$5"
  done
  kill $ear $window
  wait $ear $window 2> /dev/null || true
}
sed 's/"schema_version": 1,/"schema_version": 1, "timing": { "max_missed_ticks": 10000000, "max_gap_s": 7200 },/' resources/experiments/dingwell.json > "$work/easy.json"
# No noisy hand comes to rest within a tenth of a micrometre.
/usr/bin/python3 - "$work" <<'P'
import json, re, sys
text = open(sys.argv[1] + "/easy.json").read()
hard = json.loads(re.sub(r"^\s*//.*$", "", text, flags=re.M))
hard["task"]["tolerance"] = {"position_m": 1e-7, "velocity_m_per_s": 1e-7, "time_s": hard["task"]["tolerance"]["time_s"]}
json.dump(hard, open(sys.argv[1] + "/hard.json", "w"))
P
listen success 0.8 "$work/easy.json" 0 15
listen failure 0.8 "$work/hard.json" 1 20 3  # fails only when its time is up; a busy machine swallows one short tone or another
listen silent 0 "$work/easy.json" 0 15
/usr/bin/python3 - "$work" <<'P'
import sys
import numpy as np

RATE, bad = 44100, 0


def loudest(name, frequency):
    """Largest share of a window's power that lies within 30 Hz of the frequency, where anything is heard."""
    sound = np.fromfile(f"{sys.argv[1]}/{name}.raw", dtype="<i2").astype(float) / 32768
    size, best = 2048, 0.0  # half of the go signal, a tenth of a second
    for at in range(0, len(sound) - size, size // 4):
        piece = sound[at:at + size]
        if np.sqrt(np.mean(piece ** 2)) < 1e-3:
            continue
        power = np.abs(np.fft.rfft(piece * np.hanning(size))) ** 2
        hertz = np.fft.rfftfreq(size, 1 / RATE)
        best = max(best, power[np.abs(hertz - frequency) < 30].sum() / power.sum())
    return best


for name, cue, frequency, heard in [("success", "go", 1000.0, True), ("success", "success", 659.25, True), ("success", "failure", 246.94, False),
                                    ("failure", "go", 1000.0, True), ("failure", "failure", 246.94, True),
                                    ("failure", "success", 659.25, False), ("silent", "go", 1000.0, False)]:
    share = loudest(name, frequency)
    fine = (share > 0.5) == heard
    bad += not fine
    print(f"{'fine' if fine else 'BAD '}  {name}: {cue} at {frequency:g} Hz has {100 * share:.0f} % of the power of its loudest moment")
sys.exit(bad > 0)
P
