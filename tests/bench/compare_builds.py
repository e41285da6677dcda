#!/usr/bin/env python3
"""Sets two builds of `reach` side by side: every shipped experiment of one hand by both, and the largest difference between their rows.

    tests/bench/compare_builds.py OLD/cli/reach NEW/cli/reach [--limit 1e-13]

A column's difference is its largest absolute one [SI]; beside it the same as a share of the column's largest number. Exit 1 where one
exceeds the limit both ways, and where the two builds differ in what they refuse.
"""
import argparse
import csv
import io
import subprocess
import sys

# A hand that follows the chord, and none: the masses are pushed off from the start.
HANDS = ("min-jerk", "none")
RATES = {0: "0.1,0.2,0.3", 1: "1", 2: "0.5,0.7"}  # by the number of a mass's parameters


def simulate(reach, experiment, hand):
    command = [reach, "simulate", experiment, "--hand", hand, "--every", "0.005"]
    if hand == "none":
        header = subprocess.run([reach, "simulate", experiment, "--hand", "hold", "--until", "0.01"], capture_output=True, text=True).stdout
        command += ["--rate", RATES[sum(f"mass1_{q}," in header for q in ("q", "q1", "q2"))]]
    done = subprocess.run(command, capture_output=True, text=True)
    return done.returncode, done.stdout


def kind_of(column):
    if column.startswith("hand_"):
        return "hand"
    if column.startswith("force_"):
        return "force"
    return "rate" if column.endswith("_per_s") else "place"


def differences(old, new):
    """{kind: (largest absolute difference, the same as a share of the column's largest number)}"""
    old, new = (list(csv.reader(io.StringIO(text))) for text in (old, new))
    if old[0] != new[0] or len(old) != len(new):
        raise SystemExit("the tables differ in shape")
    worst = {}
    for i, column in enumerate(old[0]):
        a, b = ([float(row[i]) for row in rows[1:]] for rows in (old, new))
        largest = max(map(abs, a))
        change = max(abs(x - y) for x, y in zip(a, b))
        before = worst.get(kind_of(column), (0.0, 0.0))
        worst[kind_of(column)] = (max(before[0], change), max(before[1], change / largest if largest > 0 else change))
    return worst


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("old")
    arguments.add_argument("new")
    arguments.add_argument("--limit", type=float, default=1e-13)
    given = arguments.parse_args()
    names = subprocess.run([given.new, "list", "experiments"], capture_output=True, text=True, check=True).stdout.split("\n")
    names = [line.split()[0] for line in names if line.strip()]
    kinds = ("hand", "place", "rate", "force")
    print("| experiment | hand | rows | " + " | ".join(f"{k}, its share" for k in kinds) + " |")
    print("|---" * (3 + len(kinds)) + "|")
    bad = []
    for name in names:
        for hand in HANDS:
            (old_code, old), (new_code, new) = (simulate(reach, name, hand) for reach in (given.old, given.new))
            if old_code != new_code:
                bad.append(f"{name} --hand {hand}: exit {old_code} before, {new_code} now")
                continue
            if old_code != 0:
                continue  # a closed way has no chord, and simulate moves one hand
            worst = differences(old, new)
            cells = " | ".join("{:.1e}, {:.1e}".format(*worst.get(k, (0, 0))) if worst.get(k, (0, 0))[0] else "0" for k in kinds)
            print(f"| {name} | {hand} | {new.count(chr(10)) - 2} | {cells} |", flush=True)
            bad += [f"{name} --hand {hand}: {k} differs by {a:.2e}" for k, (a, share) in worst.items() if min(a, share) > given.limit]
    print("\n".join(bad), file=sys.stderr)
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
