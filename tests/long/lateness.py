#!/usr/bin/env python3
"""How late the ticks of 1 kHz are, in the window and without it, with and without real-time priority.

lateness.py BUILD [--seconds 20] [--experiment chain-slow] [--json]

A simulated hand does one trial after another in real time; in the window, under a virtual display, everything is drawn by the processor. The right to
real-time priority is taken away with setpriv. What is printed is each loop's own line in its recording. Ends with 1 when one is missing."""
import argparse
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

LINE = re.compile(rb"loop: ([\d.]+) ticks/s over ([\d.]+) s \((.*?)\); lateness p50 ([\d.]+) us, p99 ([\d.]+) us, max ([\d.]+) us; late (\d+), missed (\d+)")


def without_priority(command):
    return ["setpriv", "--bounding-set=-sys_nice", "--inh-caps=-sys_nice", "prlimit", "--rtprio=0", *command]


def loop_line(data):
    for log in Path(data).glob("sourcedata/*.reach"):
        if found := LINE.search(log.read_bytes()):
            rate, seconds, mode, p50, p99, most, late, missed = (part.decode() for part in found.groups())
            return {"mode": mode, "ticks_per_s": float(rate), "seconds": float(seconds), "p50_us": float(p50), "p99_us": float(p99),
                    "max_us": float(most), "late": int(late), "missed": int(missed)}
    return None


def headless(build, experiment, seconds, data, prefix):
    run = subprocess.Popen(prefix([str(build / "cli/reach"), "run", experiment, "--device", "simulated:noise=0", "--trials", "1000", "--seed", "1", "--data", data]),
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(seconds)
    run.send_signal(signal.SIGINT)
    run.wait(60)


def in_the_window(build, experiment, seconds, data, prefix):
    with tempfile.TemporaryDirectory() as home:
        environment = dict(os.environ, QT_QPA_PLATFORM="xcb", LIBGL_ALWAYS_SOFTWARE="1", XDG_RUNTIME_DIR=home, XDG_CONFIG_HOME=home)
        read, write = os.pipe()
        server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1600x1000x24", "-noreset"], pass_fds=[write],
                                  stderr=subprocess.DEVNULL)
        os.close(write)
        manager = None
        try:
            environment["DISPLAY"] = ":" + os.read(read, 16).decode().strip()
            manager = subprocess.Popen(["openbox"], env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            window = subprocess.Popen(prefix([str(build / "gui/reachlab"), experiment, "--device", "simulated:noise=0", "--trials", "1000", "--seed", "1",
                                              "--data", data]), env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            key = lambda: subprocess.run(["xdotool", "search", "--onlyvisible", "--name", "Reachlab$", "windowactivate", "--sync", "key", "space"],
                                         env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            begun = time.monotonic()
            while not list(Path(data).glob("sourcedata/*.reach")) and time.monotonic() - begun < 120:
                key()
                time.sleep(1)
            end = time.monotonic() + seconds
            while time.monotonic() < end:  # the next trial, as soon as there is one to begin
                time.sleep(2)
                key()
            window.terminate()
            window.wait(60)
        finally:
            for process in (manager, server):
                if process:
                    process.terminate()
                    process.wait()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path)
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--experiment", default="chain-slow")
    parser.add_argument("--json", action="store_true")
    asked = parser.parse_args()
    if missing := [tool for tool in ("Xvfb", "openbox", "xdotool", "setpriv", "prlimit") if not shutil.which(tool)]:
        sys.exit(f"lateness.py: {', '.join(missing)} missing; packaging/packages-all.txt names the packages")
    rows = []
    for where, measure in (("headless", headless), ("window", in_the_window)):
        for right, prefix in (("with", list), ("without", without_priority)):
            with tempfile.TemporaryDirectory() as data:
                measure(asked.build.resolve(), asked.experiment, asked.seconds, data, prefix)
                rows.append({"where": where, "priority": right, **(loop_line(data) or {})})
    if asked.json:
        print(json.dumps(rows, indent=2))
    else:
        print(f"load {os.getloadavg()[0]:.1f} on {os.cpu_count()} processors")
        print("| where | real-time priority | ticks/s | p50 us | p99 us | max us | late | missed | the loop says |\n|---|---|---|---|---|---|---|---|---|")
        for row in rows:
            values = [f"{row[key]:g}" if key in row else "-" for key in ("ticks_per_s", "p50_us", "p99_us", "max_us", "late", "missed")]
            print(f"| {row['where']} | {row['priority']} | {' | '.join(values)} | {row.get('mode', 'nothing')} |")
    sys.exit(any("p99_us" not in row for row in rows))


main()
