#!/usr/bin/env python3
"""What a tick costs in one build beside another: both measure in turns, so that whatever else the machine does meets both alike.

    tests/long/paired_ticks.py build/unhardened/cli/reach build/release/cli/reach

For each scene of `reach bench --tick`: the median tick in both [ns], and the ratio of each turn's medians: median over the turns, with the quartiles.
"""
import argparse
import random
import statistics
import subprocess


def medians(program, ticks):
    out = subprocess.run([program, "bench", "--tick", "--ticks", str(ticks)], check=True, capture_output=True, text=True).stdout
    rows = [line.split() for line in out.splitlines()[1:]]
    return {row[0]: float(row[2]) for row in rows if len(row) > 3}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before")
    parser.add_argument("after")
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--ticks", type=int, default=50000)
    wishes = parser.parse_args()
    chance, turns = random.Random(1), []
    for _ in range(wishes.rounds):
        order = [wishes.before, wishes.after]
        chance.shuffle(order)  # neither is always the one that finds the processor warm
        told = {program: medians(program, wishes.ticks) for program in order}
        turns.append((told[wishes.before], told[wishes.after]))
    print(f"{'scene':<8} {'before':>9} {'after':>9} {'ratio':>7}   quartiles   (ns a tick, {wishes.rounds} turns of {wishes.ticks} ticks)")
    for scene in turns[0][0]:
        pairs = [(b[scene], a[scene]) for b, a in turns if scene in b and scene in a]
        ratios = [a / b for b, a in pairs]
        low, _, high = statistics.quantiles(ratios, n=4)
        print(f"{scene:<8} {statistics.median(b for b, _ in pairs):>9.0f} {statistics.median(a for _, a in pairs):>9.0f} "
              f"{statistics.median(ratios):>7.3f}   {low:.3f} to {high:.3f}")


if __name__ == "__main__":
    main()
