#!/usr/bin/env python3
"""Stations of one object on one machine, encrypted, each a process with its endpoint:
  eight_stations.py BUILD [STATIONS] [SECONDS]
Two or three send at 1 kHz, more at 250 Hz. They must meet, carry out one trial, and every log must replay to the bit; rate, misses and share of a processor are reported, not judged: eight
stations want more than two processors. Exits 1 otherwise."""
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from station_setup import add_station, chain_of

reach = Path(sys.argv[1], "cli/reach").resolve()
count = int(sys.argv[2]) if len(sys.argv) > 2 else 8
seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 2
work = tempfile.mkdtemp(prefix="eight-stations-")
os.chdir(work)
for i in range(1, count + 1):
    add_station(reach, Path("s1"), Path(f"s{i}"), f"s{i}")
Path("many.json").write_text(json.dumps(chain_of(count, seconds)))
begun, started = time.monotonic(), []
for i in range(1, count + 1):
    words = [reach, "station", "many.json", "--number", str(i), "--device", "simulated:noise=0", "--seed", str(i), "--wait", "60", "--rate", "1000" if count < 4 else "250", "--peers", f"s{i}",
             "--interface", "lo", "--peer", "127.0.0.1", "--domain", "77", "--data", f"data{i}"] + (["--conductor"] if i == 1 else [])
    started.append(subprocess.Popen(words, stdout=open(f"{i}.out", "w"), stderr=open(f"{i}.err", "w")))
wrong = 0
codes = {}
for process in started:
    _, status, usage = os.wait4(process.pid, 0)
    codes[process.pid] = (os.waitstatus_to_exitcode(status), usage.ru_utime + usage.ru_stime, time.monotonic() - begun)
for i, process in enumerate(started, 1):
    code, used, lived = codes[process.pid]
    out, err = Path(f"{i}.out").read_text(), Path(f"{i}.err").read_text()
    met = len(re.findall(r"^station \d+ \(.*round trip", err, re.M))
    trial = next(iter(re.findall(r"^trial=.*", out, re.M)), "no trial")
    logs = list(Path(f"data{i}/sourcedata").glob("*_log.reach"))
    replay = subprocess.run([reach, "replay", logs[0], "--check"], capture_output=True, text=True) if logs else None
    loop = subprocess.run(["grep", "-aoh", r"loop: [0-9.]* ticks/s\|missed [0-9]*, longest gap [0-9.]* ms", *logs], capture_output=True, text=True).stdout
    good = code == 0 and met == count - 1 and trial != "no trial" and replay is not None and replay.returncode == 0
    wrong += not good
    print(f"station {i}: exit {code}, met {met}, {trial}; {', '.join(loop.split(chr(10))).strip(', ')}; {100 * used / lived:.0f} % of a processor, with its endpoint; "
          f"replay {'identical' if replay and replay.returncode == 0 else 'WRONG'}{'' if good else '  WRONG: ' + err.strip()[-200:]}")
print(f"{wrong} wrong")
sys.exit(1 if wrong else 0)
