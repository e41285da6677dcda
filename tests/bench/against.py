#!/usr/bin/env python3
"""Prices of the methods that `auto` takes, before and after a change: two builds (preset release, target reachlab-bench) run in turns.

  tests/bench/against.py BEFORE AFTER [SCENE …]     BEFORE, AFTER: build folders; prints one table

Each round runs one and then the other, so that what else the machine does strikes both. A price is the least of all rounds; its noise is how far
the rounds' own medians lie apart, as a part of it, in the middle half of the rounds. A scene is dearer where the ratio is above 1 by more than that.
"""
import statistics
import sys
from pathlib import Path

from write_levels import bench_rows

ROUNDS = 9


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    prices = [{}, {}]
    for turn in range(ROUNDS):
        for k in (0, 1) if turn % 2 == 0 else (1, 0):
            for row in bench_rows(Path(sys.argv[1 + k]), ["auto"], sys.argv[3:], "--quick"):
                prices[k].setdefault(row["scene"], []).append(row["ns_per_ms"])
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
