#!/usr/bin/env python3
"""The memory that a run, its export and its analysis take, by the number of trials: short trials of a simulated hand in one run.

    tests/long/memory.py build/dev                             # 1,000 and 10,000 trials
    tests/long/memory.py build/release --trials 10000,100000   # 3 GB of disk, and hours

Exit 1 when a run or an export takes more than 1 kB a trial (its list of trials; rows go block by block), or an analysis more than 2 kB.
"""
import argparse
import pathlib
import sys
import tempfile
import time

from study_speed import finish, start

EXPERIMENT = """{ "schema_version": 1, "name": "short", "constraint": { "name": "line", "shape": { "length_m": 0.02 } },
  "object": { "kind": "point", "masses_kg": [0.3], "stiffness_n_per_m": [] }, "coupling": { "stiffness_n_per_m": 900, "damping_n_s_per_m": 20 },
  "task": { "start": [0], "target": [6.283185307179586], "duration_s": 0.15, "timeout_s": 1,
            "tolerance": { "position_m": 0.005, "velocity_m_per_s": 0.1, "time_s": 0.08 } } }"""
MOST = {"run": 1.0, "export csv": 1.0, "export bids": 1.0, "analyze": 2.0}  # [kB] a trial


def peak(command):
    """Largest memory of a program [kB], and how long it took [s]."""
    begin = time.monotonic()
    _, most = finish(start(*command))
    return most, time.monotonic() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--trials", default="1000,10000")
    parser.add_argument("--only", default=",".join(MOST))
    wishes = parser.parse_args()
    reach, sizes, told = wishes.build / "cli" / "reach", [int(n) for n in wishes.trials.split(",")], {}
    for count in sizes:
        with tempfile.TemporaryDirectory(prefix="reach-memory-") as work:
            work = pathlib.Path(work)
            (work / "short.json").write_text(EXPERIMENT)
            commands = {"run": [reach, "run", work / "short.json", "--device", "simulated", "--trials", str(count), "--seed", "1", "--fast", "--data",
                                work / "data"],
                        "export csv": [reach, "export", work / "data", "--format", "csv", "--out", work / "csv"],
                        "export bids": [reach, "export", work / "data", "--format", "bids", "--out", work / "bids"],
                        "analyze": [reach, "analyze", work / "data", "--out", work / "out", "--criterion", "min-hand-jerk"]}
            for name, command in commands.items():
                if name != "run" and name not in wishes.only.split(","):
                    continue
                told[name, count] = peak(command)
                print(f"{name:<12} {count:>7} trials: {told[name, count][0] / 1000:8.1f} MB {told[name, count][1]:9.1f} s", flush=True)
    failed = False
    for name, most in MOST.items():
        if name in wishes.only.split(",") and sizes[-1] > sizes[0]:
            slope = (told[name, sizes[-1]][0] - told[name, sizes[0]][0]) / (sizes[-1] - sizes[0])
            failed |= slope > most
            print(f"{name:<12} {slope:6.2f} kB a trial{'' if slope <= most else f': more than {most}'}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
