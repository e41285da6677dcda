#!/usr/bin/env python3
"""Writes docs/benchmarks/prices.md: what hardening, SLEEF's functions and equal bits cost a simulated millisecond.

    tests/bench/write_prices.py BUILD [--turns N]      BUILD: a release tree with the target reachlab_bench (REACHLAB_LEVEL says its level)

The files that a millisecond on a line or curve runs through are compiled again for each variant, with the commands of the tree and other flags. Everything
else is linked from the tree. The programs take turns in random order. A cell is the median over the turns of the ratio to the program as shipped.
"""
import argparse
import os
import random
import re
import shlex
import shutil
import statistics
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/long"))
from paired_ticks import median_and_error  # noqa: E402
from write_speed_and_error import processor, write_page  # noqa: E402

HOT = ["sim/dynamics/exact/oscillator_core.cpp", "sim/dynamics/hand/hand_segment.cpp", "sim/dynamics/object/forces.cpp", "sim/dynamics/object/plant.cpp",
       "constraints/curve_batch.cpp", "generated_catalogue.cpp"]
DRIVER = ROOT / "tests/bench/price_scenes.cpp"
SCENES = ["S1", "S1b50", "S1b500", "S2a", "S5", "S5h", "S6", "S7b", "S7c", "S8"]
C_LIBRARY = """#pragma once
#include <cmath>
namespace reachlab::elementary {
""" + "".join(f"inline double {f}(double x) noexcept {{ return std::{f}(x); }}\n"
              for f in ("sin", "cos", "exp", "log", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh")) + \
    "".join(f"inline double {f}(double x, double y) noexcept {{ return std::{f}(x, y); }}\n" for f in ("pow", "atan2")) + "}\n"


def without_hardening(flags, _):
    return [f for f in flags if not re.match(r"-fstack-protector|-[DU]_FORTIFY|-fcf-protection|-fno-plt", f)]


def strong_canaries(flags, _):
    return [f for f in flags if f not in ("-fstack-protector", "-fno-plt")]


def c_library(flags, folder):
    return [flags[0], f"-I{folder}", *flags[1:]]


def free_bits(flags, folder):
    return [*c_library(flags, folder), "-ffp-contract=fast", "-ftree-slp-vectorize"]


VARIANTS = {"as shipped": lambda flags, _: flags, "without hardening": without_hardening, "strong canaries": strong_canaries,
            "C library": c_library, "free bits": free_bits}


def commands(build):
    """{source: words of its compile command without launcher, output and source}"""
    found = {}
    for line in subprocess.run(["ninja", "-C", build, "-t", "commands", "reachlab_bench"], check=True, stdout=subprocess.PIPE, text=True).stdout.splitlines():
        for part in line.split("&&"):
            if " -c " in part:
                words = shlex.split(part)
                source = words[words.index("-c") + 1]
                start = next(i for i, word in enumerate(words) if re.search(r"(\+\+|clang)(-\d+)?$", word))
                flags = words[start:words.index("-o")]
                found[source] = [f for f in flags if f not in ("-MD", "-MT", "-MF") and not f.endswith((".d", ".o"))]
    return found


def make(name, build, found, folder):
    own = folder / name.replace(" ", "-")
    (own / "base/math").mkdir(parents=True)
    (own / "base/math/elementary.h").write_text(C_LIBRARY)
    change, objects = VARIANTS[name], []
    for wanted in HOT:
        source, flags = next((s, f) for s, f in found.items() if s.endswith("/" + wanted) or s == wanted)
        objects.append(own / (wanted.replace("/", "-") + ".o"))
        subprocess.run([*change(flags, own), "-c", source, "-o", objects[-1]], cwd=build, check=True)
    archives = sorted(str(a) for a in build.rglob("libreachlab_*.a"))
    flags = next(f for s, f in found.items() if s.endswith("dynamics/curve_plants.cpp"))
    now = [] if name == "without hardening" else ["-Wl,-z,relro,-z,now"]
    program = own / "program"
    subprocess.run([*change(flags, own), DRIVER, *objects, "-Wl,--start-group", *archives, "-Wl,--end-group", *now, "-lfmt", "-lcairo", "-lsleef", "-o", program],
                   cwd=build, check=True)
    return program


def table(turns):
    names = [name for name in turns[0] if name != "as shipped"]
    lines = ["| scene | as shipped, ns |" + "".join(f" {name} |" for name in names), "|---|---|" + "---|" * len(names)]
    medians = {name: [] for name in names}
    for scene in SCENES:
        shipped = [turn["as shipped"][scene] for turn in turns]
        line = f"| {scene} | {statistics.median(shipped):.1f} |"
        for name in names:
            middle, error = median_and_error([turn[name][scene] / turn["as shipped"][scene] for turn in turns])
            medians[name].append(middle)
            line += f" {middle:.3f} ± {error:.3f} |"
        lines.append(line)
    lines.append("| geometric mean | |" + "".join(f" {statistics.geometric_mean(medians[name]):.3f} |" for name in names))
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path)
    parser.add_argument("--turns", type=int, default=25)
    parser.add_argument("--repeats", type=int, default=40, help="reaches of a scene in one turn, of which the fastest counts")
    wishes = parser.parse_args()
    build = wishes.build.resolve()
    level = re.search(r"REACHLAB_LEVEL:\w+=(\S*)", (build / "CMakeCache.txt").read_text())[1] or "the build's own level"
    found, chance, turns = commands(build), random.Random(1), []
    with tempfile.TemporaryDirectory() as name:
        with ThreadPoolExecutor(2) as pool:
            programs = dict(zip(VARIANTS, pool.map(lambda variant: make(variant, build, found, Path(name)), VARIANTS)))
        programs["a copy"] = shutil.copy(programs["as shipped"], Path(name) / "copy")
        before = os.getloadavg()[1]
        for turn in range(wishes.turns):
            turns.append({})
            for variant in chance.sample(list(programs), len(programs)):
                out = subprocess.run([programs[variant], str(wishes.repeats)], check=True, stdout=subprocess.PIPE, text=True).stdout
                turns[-1][variant] = {scene: float(ns) for scene, ns in map(str.split, out.splitlines())}
            print(f"\rturn {turn + 1} of {wishes.turns}", end="", file=sys.stderr)
    write_page("prices", {"PROCESSOR": processor(), "LEVEL": level, "TURNS": str(wishes.turns), "LOAD": f"{before:.1f} to {os.getloadavg()[1]:.1f}",
                          "TABLE": table(turns)})


if __name__ == "__main__":
    main()
