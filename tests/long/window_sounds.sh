#!/bin/bash
# Proves that go, success and failure are heard: the window runs under a virtual display with a PulseAudio null sink, and what the sink was
# given is looked at. Prints a line a cue; exits 1 when one is not heard, or is heard where it should not be.
#   tests/long/window_sounds.sh [BUILD]
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${1:-build/dev}
source tests/gui/window_driving.sh
need Xvfb openbox xdotool pulseaudio parec /usr/bin/python3
export XDG_CONFIG_HOME=$work XDG_CACHE_HOME=$work PULSE_SERVER=unix:$work/pulse.sock
begin_display 1366x768
pulseaudio -n --exit-idle-time=-1 -L "module-native-protocol-unix socket=$work/pulse.sock auth-anonymous=1" \
  -L "module-null-sink sink_name=t rate=44100" 2> /dev/null &
until [[ -S $work/pulse.sock ]]; do sleep 0.1; done

# listen NAME VOLUME EXPERIMENT NOISE SECONDS [TRIALS]: trials of a simulated hand in the window, and what was heard meanwhile.
listen() {
  mkdir -p "$work/reachlab"
  printf '[sound]\nvolume=%s\n' "$2" > "$work/reachlab/reachlab.conf"
  "$build/gui/reachlab" "$3" --device "simulated:noise=$4" --trials "${6:-1}" --data "$work/data-$1" --seed 1 2> /dev/null & window=$!
  id=$(window_named 'Reachlab$')
  xdotool windowactivate --sync "$id"
  sleep 4
  # With little latency: what a null sink rendered ahead, as silence, its monitor does not take back when a sound begins.
  parec --latency-msec=10 -d t.monitor --format=s16le --rate=44100 --channels=1 > "$work/$1.raw" & ear=$!
  until [[ -s $work/$1.raw ]]; do sleep 0.2; done  # it listens
  for _ in $(seq "${6:-1}"); do
    xdotool key --clearmodifiers space
    sleep "$5"
  done
  kill $ear $window
  wait $ear $window 2> /dev/null || true
}
easy=$(patient dingwell)
# No noisy hand comes to rest within a tenth of a micrometre.
/usr/bin/python3 - "$easy" "$work/hard.json" <<'P'
import json, re, sys
text = open(sys.argv[1]).read()
hard = json.loads(re.sub(r"^\s*//.*$", "", text, flags=re.M))
hard["task"]["tolerance"] = {"position_m": 1e-7, "velocity_m_per_s": 1e-7, "time_s": hard["task"]["tolerance"]["time_s"]}
json.dump(hard, open(sys.argv[2], "w"))
P
listen success 0.8 "$easy" 0 15
listen failure 0.8 "$work/hard.json" 1 20 3  # fails only when its time is up; a busy machine swallows one short tone or another
listen silent 0 "$easy" 0 15
/usr/bin/python3 - "$work" <<'P'
import sys
import wave
import numpy as np


def cue(name):
    with wave.open(f"resources/sounds/{name}.wav") as file:
        assert (file.getframerate(), file.getnchannels()) == (44100, 1)
        return np.frombuffer(file.readframes(file.getnframes()), "<i2").astype(float) / 32768


def likeness(sound, wanted):
    """Largest correlation of what was heard with the cue's own file, 1 where it is the file; 0 in silence."""
    size = len(wanted) + len(sound)
    found = np.abs(np.fft.irfft(np.fft.rfft(sound, size) * np.conj(np.fft.rfft(wanted, size)), size)[:len(sound) - len(wanted)])
    power = np.cumsum(np.insert(sound ** 2, 0, 0))
    heard = np.sqrt(np.maximum(power[len(wanted):] - power[:-len(wanted)], 0))[:len(found)]
    loud = heard > 1e-3 * np.sqrt(len(wanted))
    return (found[loud] / heard[loud]).max() / np.linalg.norm(wanted) if loud.any() else 0.0


bad = 0
for name, expected in [("success", {"go", "success"}), ("failure", {"go", "failure"}), ("silent", set())]:
    sound = np.fromfile(f"{sys.argv[1]}/{name}.raw", dtype="<i2").astype(float) / 32768
    for which in ("go", "success", "failure"):
        like = likeness(sound, cue(which))  # 0.80: its first tenth of a second was swallowed
        fine = (like > 0.6) == (which in expected)
        bad += not fine
        print(f"{'fine' if fine else 'BAD '}  {name}: {which} correlates by {like:.2f} with the sound's file")
sys.exit(bad > 0)
P
