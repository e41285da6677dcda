#!/usr/bin/env python3
"""Do programs compiled for different levels of processor compute the same bits, and what does a lower level cost?

    tests/long/levels.py [--emulate CPU] [--price NATIVE] PROGRAM PROGRAM...

Each PROGRAM is a `reach` (or NAME=reach). Every shipped experiment and the formulas below are recorded by the first and recomputed by each of the
others (`reach replay --check`), once as they are and once with the C library told that the processor has neither AVX2 nor FMA; the exported
motion of a run by each, with a simulated hand of the same seed, is compared too. --emulate replays one experiment of each kind by the last program
under qemu-x86_64 -cpu CPU (Nehalem: level v2). --price prints the ns of a tick of each level beside a native build, in turns. Exit 1 where a
bit differs.
"""
import argparse
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from paired_ticks import typical

OLD_C_LIBRARY = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F,-AVX512VL"}
TASK = {"start": [0.3], "target": [0.9], "duration_s": 1.2, "tolerance": {"position_m": 0.02, "velocity_m_per_s": 0.1, "time_s": 0.6}}
# Every function of the language that is not on a shipped curve.
FORMULAS = {
    "functions": ["phi/5", "0.05*exp(-phi) + 0.02*tan(phi/2) + 0.01*log(2 + phi) + 0.01*phi^1.7", "0.02*tanh(phi) + 0.01*sinh(phi/2) + 0.01*cosh(phi)"],
    "arcs": ["phi/5", "0.05*asin(phi/3) + 0.03*acos(phi/4)", "0.05*atan(phi) + 0.02*atan2(phi, 2)"],
}
EMULATED = ("chain-moderate", "sphere", "functions")


def run(command, env=None, **more):
    return subprocess.run(command, capture_output=True, text=True, env={**os.environ, **(env or {})}, **more)


def must(command, env=None):
    done = run(command, env)
    if done.returncode != 0:
        sys.exit(f"levels: {' '.join(map(str, command))} ended with {done.returncode}:\n{done.stdout[-500:]}{done.stderr[-500:]}")
    return done.stdout


def experiments(reach, folder):
    for line in must([reach, "list", "experiments"]).splitlines():
        if line.strip():
            yield line.split()[0], line.split()[0]
    for name, curve in FORMULAS.items():
        file = folder / f"{name}.json"
        file.write_text(json.dumps({"schema_version": 1, "constraint": {"curve": curve}, "task": TASK,
                                    "object": {"kind": "chain", "masses_kg": [0.6, 0.6], "stiffness_n_per_m": [600]},
                                    "coupling": {"stiffness_n_per_m": 600, "damping_n_s_per_m": 5}}))
        yield name, str(file)


def record(command, experiment, folder, env=None):
    shutil.rmtree(folder, ignore_errors=True)
    partner = ["--device", "partner:follower"] if experiment.endswith("two-hands") else []
    must([*command, "run", experiment, "--device", "simulated", *partner, "--trials", "2", "--seed", "1", "--fast", "--data", str(folder)], env)
    return next(folder.rglob("*_log.reach")), next(folder.rglob("*_motion.tsv")).read_text()


def price(programs, native, rounds):
    turns = {name: [] for name in programs}
    for _ in range(rounds):
        for name, reach in {**programs, "native": native}.items():
            turns.setdefault(name, []).append(typical(reach, 30000))
    print(f"\nTypical tick [ns] and its ratio to native, {rounds} turns\n" + f"{'scene':<10}{'native':>9}" + "".join(f"{n:>20}" for n in programs))
    for scene in turns["native"][0]:
        base = [t[scene] for t in turns["native"]]
        line = f"{scene:<10}{statistics.median(base):>9.0f}"
        for name in programs:
            own = [t[scene] for t in turns[name]]
            line += f"{statistics.median(own):>12.0f} {statistics.median(o / b for o, b in zip(own, base)):>6.2f}x"
        print(line)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs="+")
    parser.add_argument("--emulate", metavar="CPU")
    parser.add_argument("--price", metavar="NATIVE")
    parser.add_argument("--rounds", type=int, default=7)
    wishes = parser.parse_args()
    programs = dict(p.split("=", 1) if "=" in p else (p, p) for p in wishes.programs)
    first, *others = programs
    differing = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        columns = [first + ", old C library"] + [n for o in others for n in (o, o + ", old C library")]
        print(f"recorded by {first}; '=' the same bits\n{'experiment':<20}" + "".join(f"{c:>28}" for c in columns) + (f"{wishes.emulate:>12}" if wishes.emulate else ""))
        for experiment, file in experiments(programs[first], folder):
            log, motion = record([programs[first]], file, folder / "first")
            line = f"{experiment:<20}"
            for column in columns:
                reach, env = programs[column.split(",")[0]], OLD_C_LIBRARY if "old" in column else None
                same = run([reach, "replay", log, "--check"], env).returncode == 0
                again = record([reach], file, folder / "again", env)[1] == motion
                differing += not (same and again)
                line += f"{'=' if same and again else 'other states' if not same else 'other hand':>28}"
            if wishes.emulate and experiment in EMULATED:
                same = run(["qemu-x86_64", "-cpu", wishes.emulate, programs[others[-1] if others else first], "replay", log, "--check"]).returncode == 0
                differing += not same
                line += f"{'=' if same else 'other':>12}"
            print(line, flush=True)
    print("levels: " + ("every bit is the same" if differing == 0 else f"{differing} recordings differ"))
    if wishes.price:
        price(programs, wishes.price, wishes.rounds)
    sys.exit(differing > 0)


if __name__ == "__main__":
    main()
