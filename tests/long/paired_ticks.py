#!/usr/bin/env python3
"""What a tick costs in one build beside another: both measure in turns, scene by scene, so that whatever else the machine does meets both alike.

    tests/long/paired_ticks.py build/unhardened/cli/reach build/release/cli/reach

For each scene of `reach bench --tick`: the tick's typical cost in both [ns] (the mean of the middle half of all ticks, since a clock that counts
in tens of nanoseconds does not resolve 2 % of a short one by its median), and the ratio of each turn: median over the turns, with the quartiles and
the error of that median.
"""
import argparse
import math
import random
import statistics
import subprocess


def typical(reach, ticks, scenes=()):
    """Mean of the middle half of all ticks [ns] of each scene, as `reach bench --tick` tells it."""
    command = [reach, "bench", "--tick", "--ticks", str(ticks)]
    for scene in scenes:
        command += ["--scene", scene]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    column = lines[0].split().index("middle")
    rows = [line.split() for line in lines[1:]]
    return {row[0]: float(row[column]) for row in rows if len(row) > column}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before")
    parser.add_argument("after")
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--ticks", type=int, default=50000)
    parser.add_argument("--scene", nargs="*", default=[], help="only these")
    wishes = parser.parse_args()
    programs = [wishes.before, wishes.after]
    scenes = wishes.scene or list(typical(wishes.before, 1000))
    chance, turns = random.Random(1), {scene: [] for scene in scenes}
    for _ in range(wishes.rounds):
        for scene in scenes:
            order = chance.sample(programs, 2)  # neither is always the one that finds the processor warm
            told = {program: typical(program, wishes.ticks, [scene])[scene] for program in order}
            turns[scene].append((told[wishes.before], told[wishes.after]))
    print(f"{'scene':<8} {'before':>9} {'after':>9} {'ratio':>7} {'error':>7}   quartiles   (ns a tick, {wishes.rounds} turns of {wishes.ticks} ticks)")
    medians = []
    for scene, pairs in turns.items():
        ratios = [after / before for before, after in pairs]
        low, middle, high = statistics.quantiles(ratios, n=4)
        medians.append(middle)
        error = 0.93 * (high - low) / math.sqrt(len(ratios))  # 1.25 standard errors of a mean, of spread IQR/1.35
        print(f"{scene:<8} {statistics.median(b for b, _ in pairs):>9.1f} {statistics.median(a for _, a in pairs):>9.1f} "
              f"{middle:>7.3f} {error:>7.3f}   {low:.3f} to {high:.3f}")
    print(f"geometric mean over the scenes {statistics.geometric_mean(medians):.3f}, largest {max(medians):.3f}")


if __name__ == "__main__":
    main()
