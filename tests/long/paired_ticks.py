#!/usr/bin/env python3
"""What a tick costs in some builds beside the first.

    tests/long/paired_ticks.py build/unhardened/cli/reach build/release/cli/reach

All run at once on one core, where the scheduler gives each some milliseconds in turn: whatever else slows the machine down slows all of them alike.
For each scene of `reach bench --tick`: what a tick costs in the first [ns], and the ratio of each other one, the median over the turns with its error.
A cost is the mean of the middle half of the ticks: a clock that counts in tens of nanoseconds does not resolve 2 % of a short tick by its median, and
the ticks in which the scheduler changed programs are not in that half.
"""
import argparse
import math
import os
import random
import statistics
import subprocess
import sys


def costs(out):
    lines = out[out.index("scene "):].splitlines()  # after the level of the program
    column = lines[0].split().index("middle")
    rows = [line.split() for line in lines[1:]]
    return {row[0]: float(row[column]) for row in rows if len(row) > column}


def command(reach, ticks, scene=None):
    return [reach, "bench", "--tick", "--ticks", str(ticks)] + (["--scene", scene] if scene else [])


def typical(reach, ticks):
    """Mean of the middle half of all ticks [ns] of each scene."""
    return costs(subprocess.run(command(reach, ticks), check=True, capture_output=True, text=True).stdout)


def side_by_side(programs, ticks, scene, chance):
    started = {i: subprocess.Popen(command(programs[i], ticks, scene), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
               for i in chance.sample(range(len(programs)), len(programs))}  # the first to start has the better of it, by half a percent
    told = {i: costs(process.communicate()[0])[scene] for i, process in started.items()}
    return [told[i] for i in range(len(programs))]


def median_and_error(ratios):
    low, middle, high = statistics.quantiles(ratios, n=4)
    return middle, 0.93 * (high - low) / math.sqrt(len(ratios))  # 1.25 standard errors of a mean; a quartile is 0.67 standard deviations off


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs="+", metavar="reach")
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--ticks", type=int, default=200000)
    parser.add_argument("--scene", nargs="*", default=[], help="only these")
    wishes = parser.parse_args()
    scenes = wishes.scene or list(typical(wishes.programs[0], 1000))
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    chance, turns = random.Random(1), {scene: [] for scene in scenes}
    for turn in range(wishes.rounds):
        for scene in scenes:
            turns[scene].append(side_by_side(wishes.programs, wishes.ticks, scene, chance))
        print(f"\rturn {turn + 1} of {wishes.rounds}", end="", file=sys.stderr)
    print(file=sys.stderr)
    print(f"{'scene':<8} {'ns a tick':>9}   ratios ({wishes.rounds} turns of {wishes.ticks} ticks)")
    medians = [[] for _ in wishes.programs[1:]]
    for scene, told in turns.items():
        line = f"{scene:<8} {statistics.median(first for first, *_ in told):>9.1f}"
        for i, of_all in enumerate(medians):
            middle, error = median_and_error([one[i + 1] / one[0] for one in told])
            of_all.append(middle)
            line += f"   {middle:.3f} ± {error:.3f}"
        print(line)
    for program, of_all in zip(wishes.programs[1:], medians):
        print(f"{program}: geometric mean over the scenes {statistics.geometric_mean(of_all):.3f}, largest {max(of_all):.3f}")


if __name__ == "__main__":
    main()
