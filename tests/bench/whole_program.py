#!/usr/bin/env python3
"""Sets two builds side by side in what a user waits for: pictures, first window, analysis, studies. Prints a table for docs/benchmarks/drawing-speed.md.

    tests/bench/whole_program.py OLD NEW [--rounds 5] [--trials 1200] [--study 20000]

OLD and NEW are folders that were built with window and tests. The two take turns, in another order in each round. A cell is the median of
the rounds, and a ratio the median of the ratios within a round. The recordings are made by OLD, so that both read the same.
"""
import argparse
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "long"))
from study_speed import finish, start  # noqa: E402

SCENES = ["chain-moderate", "chain-on-ellipse", "parallel", "torus", "moebius-strip", "helicoid"]  # cheap, usual and dear ones
UNDER = pathlib.Path(__file__).resolve().parents[1] / "gui" / "under_xvfb"


def pictures(build):
    """Processor time of a picture of each scene [ms], and the time until the first picture [s]."""
    text = subprocess.run([UNDER, "taskset", "-c", "1", build / "tests/gui/frame_bench", *SCENES], check=True, capture_output=True, text=True).stdout
    found = {f"picture of {name} [ms]": 1e3 / float(rate) for name, rate in re.findall(r"^\| (\S+) \| \d+ \| (\d+) \|$", text, re.M)}
    found["first picture [s]"] = float(re.search(r"First picture after (\S+) s", text)[1])
    return found


def measure(build, dataset, study, folder, turn):
    reach = build / "cli/reach"
    found = pictures(build)
    found["analysis [s of processor]"] = finish(start(reach, "analyze", dataset, "--out", folder / f"{turn}-out"))[0]
    found["study [s of processor]"] = finish(start(reach, "study", study, "--out", folder / f"{turn}-study", "--jobs", 1))[0]
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", type=pathlib.Path)
    parser.add_argument("new", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--trials", type=int, default=1200)
    parser.add_argument("--study", type=int, default=20000)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        dataset, study = folder / "data", folder / "study.json"
        for subject in range(1, 13):
            subprocess.run([arguments.old / "cli/reach", "run", "chain-moderate", "--device", "simulated", "--fast", "--trials", str(arguments.trials // 12),
                            "--subject", f"{subject:02}", "--seed", str(subject), "--data", dataset], check=True, capture_output=True)
        study.write_text(json.dumps({"schema_version": 1, "name": "speed", "seed": 1, "experiment": "chain-moderate", "subject": {"kind": "plan"},
                                     "subjects": max(1, arguments.study // 100), "trials": min(100, arguments.study)}))
        rows = {"old": [], "new": []}
        for turn in range(arguments.rounds):
            for name in ("old", "new") if turn % 2 == 0 else ("new", "old"):
                rows[name].append(measure(getattr(arguments, name), dataset, study, folder, f"{name}{turn}"))
                print(f"round {turn + 1} of {arguments.rounds}: {name}", file=sys.stderr, flush=True)
        print("| | before | now | now / before |\n|---|---|---|---|")
        for what in rows["old"][0]:
            old, new = ([row[what] for row in rows[name]] for name in ("old", "new"))
            ratio = statistics.median(b / a for a, b in zip(old, new))
            print(f"| {what} | {statistics.median(old):.3g} | {statistics.median(new):.3g} | {ratio:.2f} |")


if __name__ == "__main__":
    main()
