#!/usr/bin/env python3
"""Prices of the methods that `auto` takes, before and after a change: two builds (preset release, target reachlab_bench) run in turns.

  tests/bench/against.py BEFORE AFTER [SCENE …]     BEFORE, AFTER: build folders; prints one table

Each round runs one and then the other, so that what else the machine does strikes both. A price is the least of all rounds; its noise is how far
the rounds' own least lie apart, as a part of it, in the middle half of the rounds. A scene is dearer where the ratio is above 1 by more than that.
"""
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROUNDS, REPEATS = 9, 60
LIBRARIES = ["bench/libreachlab_bench.a", "sim/dynamics/libreachlab_dynamics.a", "sim/experiment/libreachlab_experiment.a",
             "constraints/libreachlab_constraints.a", "analysis/figure/libreachlab_figure.a", "base/libreachlab_base.a"]


def build(folder, program):
    source = re.search(r"CMAKE_HOME_DIRECTORY:INTERNAL=(.*)", (folder / "CMakeCache.txt").read_text()).group(1)
    libraries = [str(folder / library) for library in LIBRARIES if (folder / library).exists()]
    own = str(Path(__file__).with_suffix(".cpp"))
    subprocess.run(["g++", "-std=c++20", "-O3", "-DNDEBUG", "-march=native", "-I" + source, own, "-Wl,--start-group", *libraries,
                    "-Wl,--end-group", "-lfmt", "-lcairo", "-lsleef", "-o", program], check=True)
    return program


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    prices = [{}, {}]
    with tempfile.TemporaryDirectory() as tmp:
        programs = [build(Path(folder).resolve(), f"{tmp}/{k}") for k, folder in enumerate(sys.argv[1:3])]
        for turn in range(ROUNDS):
            for k in (0, 1) if turn % 2 == 0 else (1, 0):
                told = subprocess.run([programs[k], str(REPEATS), *sys.argv[3:]], capture_output=True, text=True, check=True).stdout
                for line in told.splitlines():
                    scene, price = line.split()
                    prices[k].setdefault(scene, []).append(float(price))
    print("| scene | before, ns a ms | after, ns a ms | after / before | noise |")
    print("|---|---|---|---|---|")
    for scene, before in prices[0].items():
        after = prices[1].get(scene)
        if not after:
            continue
        spread = [q[2] / q[0] - 1 for q in (statistics.quantiles(before), statistics.quantiles(after))]
        print(f"| {scene} | {min(before):.4g} | {min(after):.4g} | {min(after) / min(before):.2f} | {max(spread):.2f} |")


if __name__ == "__main__":
    main()
