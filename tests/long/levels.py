#!/usr/bin/env python3
"""Do programs compiled for different levels of processor compute the same bits?

    tests/long/levels.py [--emulate CPU] PROGRAM PROGRAM...

Each PROGRAM is a `reach` (or NAME=reach). Every shipped experiment and the formulas below are recorded by the first and recomputed by each of the
others (`reach replay --check`), once as they are and once with the C library told that the processor has neither AVX2 nor FMA; the exported
motion of a run by each, with a simulated hand of the same seed, is compared too. --emulate replays one experiment of each kind by the last program
under qemu-x86_64 -cpu CPU (Nehalem: level v2). paired_ticks.py tells what a lower level costs. Exit 1 where a bit differs.
"""
import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

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
    words = lambda device: [*command, "run", experiment, "--device", device, *partner, "--trials", "2", "--seed", "1", "--fast", "--data", str(folder)]
    if run(words("simulated"), env).returncode != 0:  # a hand that plays its plan cannot be pushed aside
        must(words("simulated:kind=impedance"), env)
    return next(folder.rglob("*_log.reach")), next(folder.rglob("*_motion.tsv")).read_text()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs="+")
    parser.add_argument("--emulate", metavar="CPU")
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
    sys.exit(differing > 0)


if __name__ == "__main__":
    main()
