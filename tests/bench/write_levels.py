#!/usr/bin/env python3
"""Writes docs/benchmarks/processor-levels.md: all scenes on x86-64-v2, -v3 and -v4 beside odeint and CVODE, and the servo cycle of each level.

    tests/bench/write_levels.py                   builds build/level-v2 … build/level-v4 and measures them in turns
    tests/bench/write_levels.py --built FOLDER …  measures built folders (configured with REACHLAB_LEVEL and REACHLAB_BENCH_PEERS)

Each turn runs the program of every level once, in another order. A number is the median over the turns. The libraries of a level are compiled for the
level as well, except CVODE's own code, which is Debian's. Every number of the page comes from the programs. The text around them is in
processor-levels.md.in beside this file. `--same-bits FILE` includes the output of tests/long/levels.sh.
"""
import argparse
import json
import os
import random
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from write_speed_and_error import is_peer, processor, write_page

ROOT = Path(__file__).resolve().parents[2]
ERROR = 1e-6  # of the state, that the libraries owe
WANTED = 2
LEVELS = ("v2", "v3", "v4")
METHODS = ["auto", "rk4", "exact", "abm", "adaptive", "odeint-rk4", "odeint-dopri5", "odeint-fehlberg78", "cvode-adams", "cvode-bdf"]


def build(level):
    folder = ROOT / "build" / f"level-{level}"
    subprocess.run(["cmake", "--preset", "release", "-B", folder, "-DREACHLAB_GUI=OFF", "-DBUILD_TESTING=OFF", f"-DREACHLAB_LEVEL=x86-64-{level}",
                    "-DREACHLAB_BENCH_PEERS=ON"], cwd=ROOT, check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "reachlab-bench"], check=True)
    return folder


def run(folder, *words):
    print("+", folder.name, *words, file=sys.stderr, flush=True)
    return subprocess.run([folder / "cli" / "reachlab-bench", *words], check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout


def level_of(folder):
    cache = (folder / "CMakeCache.txt").read_text()
    return re.search(r"REACHLAB_LEVEL:\w+=x86-64-(v\d)", cache)[1]


def bench_rows(folder, methods, scenes, *words):
    """The rows of a bench of these methods on these scenes; none: all."""
    chosen = [word for option, names in (("--method", methods), ("--scene", scenes)) for name in names for word in (option, name)]
    with tempfile.TemporaryDirectory() as place:
        file = Path(place) / "rows.json"
        run(folder, *chosen, *words, "--json", str(file))
        return json.loads(file.read_text())


def measure(folders, turns, scenes):
    """rows[level][(scene, method, step, tolerance)] = the last row with its times of all turns; the same for the percentiles of cycles."""
    rows, ticks = {level: {} for level in folders}, {level: {} for level in folders}
    chance = random.Random(1)
    only = [word for scene in scenes for word in ("--scene", scene)]
    for _ in range(turns):
        for level in chance.sample(list(folders), len(folders)):
            for row in bench_rows(folders[level], METHODS, scenes):
                kept = rows[level].setdefault((row["scene"], row["method"], row["step_s"], row["tolerance"]), {**row, "times": []})
                if row["ns_per_ms"]:
                    kept["times"].append(row["ns_per_ms"])
            out = run(folders[level], "--tick", *only)
            header, *lines = out[out.index("scene "):].splitlines()
            names = header.split()
            for line in lines:
                values = dict(zip(names, line.split()))
                ticks[level].setdefault(values["scene"], []).append(values)
    return rows, ticks


def price(row):
    return statistics.median(row["times"])


def own_and_peer(rows, scene):
    own = next(r for (s, m, *_), r in rows.items() if s == scene and m == "auto")
    fit = [r for (s, m, *_), r in rows.items() if s == scene and is_peer(m) and r["times"] and r["state_error"] is not None and r["state_error"] <= ERROR]
    return own, min(fit, key=price)


def setting(row):
    return f"{row['method'].removeprefix('odeint-')}, " + (f"tol {row['tolerance']:.0e}" if row["tolerance"] else f"{row['step_s'] * 1e3:g} ms")


def speed_table(rows):
    levels = list(rows)
    lines = ["| scene | error, ours |" + "".join(f" {v}: ours | library at 1e-6 | ratio |" for v in levels), "|---|---|" + "---|---|---|" * len(levels)]
    short = {level: [] for level in levels}
    for scene in dict.fromkeys(key[0] for key in rows[levels[0]]):
        cells = ""
        for level in levels:
            own, peer = own_and_peer(rows[level], scene)
            ratio = price(peer) / price(own)
            if ratio < WANTED:
                short[level].append(f"{scene} ({ratio:.2f})")
            cells += f" {price(own):.0f} | {price(peer):.0f} ({setting(peer)}), {peer['state_error']:.0e} | {ratio:.2f} |"
        lines.append(f"| {scene} | {own['state_error']:.0e} |{cells}")
    below = "".join(f"- Level {level}: {', '.join(names) or 'no scene'}.\n" for level, names in short.items())
    return "\n".join(lines), below.rstrip()


def work_table(rows):
    """Right-hand sides of a reach, ours and the library's, and ns for one."""
    level = "v3" if "v3" in rows else list(rows)[-1]
    lines = ["| scene | ours: right-hand sides per ms | ns for one | library: right-hand sides per ms | ns for one |", "|---|---|---|---|---|"]
    for scene in dict.fromkeys(key[0] for key in rows[level]):
        own, peer = own_and_peer(rows[level], scene)
        if not own["rhs_evaluations"]:
            continue
        cells = ""
        for row in (own, peer):
            each = row["rhs_evaluations"] / (row["steps"] if row is own else own["steps"])
            cells += f" {each:.2f} | {price(row) / each:.0f} |"
        lines.append(f"| {scene} |{cells}")
    return "\n".join(lines)


def bits_table(rows):
    """Whether our methods have the same bits at all levels."""
    keys = [key for key in rows[list(rows)[0]] if not is_peer(key[1])]
    other = [key for key in keys if len({of_level[key]["bits"] for of_level in rows.values()}) > 1]
    told = f"{len(keys)} rows of {len({key[0] for key in keys})} scenes: "
    return told + ("every bit is the same" if not other else "other bits in " + ", ".join(f"{scene} {method}" for scene, method, *_ in other))


def tick_table(ticks):
    lines = ["| scene |" + "".join(f" {v}: p50 | p99 | p99.9 |" for v in ticks), "|---|" + "---|---|---|" * len(ticks)]
    allocations = 0
    for scene in ticks[list(ticks)[0]]:
        cells = ""
        for of_level in ticks.values():
            told = of_level[scene]
            cells += "".join(f" {statistics.median(float(t[name]) for t in told):.0f} |" for name in ("p50", "p99", "p99.9"))
            allocations += sum(int(t["allocations"]) for t in told)
        lines.append(f"| {scene} |{cells}")
    return "\n".join(lines), str(allocations)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--built", nargs="+", type=Path, metavar="FOLDER")
    parser.add_argument("--turns", type=int, default=5)
    parser.add_argument("--scene", nargs="*", default=[])
    parser.add_argument("--note", default="", help="a sentence of the page on how the folders were built")
    parser.add_argument("--same-bits", type=Path, metavar="FILE")
    wishes = parser.parse_args()
    built = [folder.resolve() for folder in wishes.built or map(build, LEVELS)]
    folders = dict(sorted((level_of(folder), folder) for folder in built))
    before = os.getloadavg()[1]
    rows, ticks = measure(folders, wishes.turns, wishes.scene)
    speed, below = speed_table(rows)
    tick, allocations = tick_table(ticks)
    load = f"{before:.1f} to {os.getloadavg()[1]:.1f}"
    bits = "Its output:\n\n```\n" + wishes.same_bits.read_text().rstrip() + "\n```" if wishes.same_bits else "It was not part of this run."
    write_page("processor-levels", {
        "PROCESSOR": processor(), "TURNS": str(wishes.turns), "NOTE": wishes.note and " " + wishes.note, "LOAD": load, "LEVELS": ", ".join(folders),
        "SPEED": speed, "BELOW": below, "WORK": work_table(rows), "TICK": tick, "ALLOCATIONS": allocations, "ROWS": bits_table(rows), "BITS": bits})


if __name__ == "__main__":
    main()
