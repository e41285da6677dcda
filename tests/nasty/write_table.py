#!/usr/bin/env python3
"""Writes docs/benchmarks/nasty-formulas.md: what the program does with each formula of tests/nasty/nasty_formulas.tsv.

    python3 tests/nasty/write_table.py build/dev/cli/reach > docs/benchmarks/nasty-formulas.md"""
import csv
import pathlib
import re
import sys
import tempfile

from let_go import let_go

HEAD = """# Nasty formulas

<!-- not run: writes this page; `NastyFormulas` of test_cli holds the program to the same table -->

    python3 tests/nasty/nasty_formulas.py > tests/nasty/nasty_formulas.tsv
    python3 tests/nasty/write_table.py build/dev/cli/reach > docs/benchmarks/nasty-formulas.md

A mass of 1 kg is let go on each formula, without a hand. *Right*: where it is at the end differs by this much from an independent solution
(mpmath, 40 digits, or double precision in the second hundred; the formula written as smooth pieces by hand, the motion as arc length over speed;
closed forms for what swings to and fro, and on surfaces).
*Stopped* and *refused*: the sentence with which the program says so; where the stop's place is known, it is right to 2e-6 m.
[Constraints](../constraints.md) says what a mass does at each kind of place.

| | formula | at, rate | s | | |
|---|---|---|---|---|---|"""


def cell(text):
    return text.replace("|", "\\|").replace("\n", " ")


def main():
    rows = list(csv.DictReader(open(pathlib.Path(__file__).with_name("nasty_formulas.tsv")), delimiter="\t", quoting=csv.QUOTE_NONE))
    print(HEAD)
    counts = {}
    with tempfile.TemporaryDirectory() as folder:
        for row in rows:
            code, said, last = let_go(sys.argv[1], folder, row["kind"], [row[k] for k in "xyz"], float(row["gravity_y"]), row["at"], row["rate"],
                                      row["seconds"])
            said = re.sub(r"FILE(:\d+)*: ", "", said)
            said = re.sub(r"\n +\d* \|[^\n]*", "", said).replace("error: ", "").replace("\nhelp: ", "; ")  # without the line and its caret
            if code != 0:
                verdict, words = "refused", said
            elif said:
                verdict, words = "stopped", said
            else:
                verdict = "right"
                away = sum((float(last[f"mass1_{a}_m"]) - float(row[f"{a}_m"])) ** 2 for a in "xyz") ** 0.5
                words = f"{away:.0e} m"
                if not away <= 1e-9 * max(1, abs(float(row["x_m"]))):
                    sys.exit(f"{row['name']}: off by {away} m")
            if verdict != row["verdict"]:
                sys.exit(f"{row['name']}: {verdict} ({words}) where the table has {row['verdict']}")
            counts[verdict] = counts.get(verdict, 0) + 1
            print(f"| {cell(row['name'])} | `{cell(', '.join(row[k] for k in 'xyz'))}` | {row['at']}; {row['rate']} | {row['seconds']} "
                  f"| {verdict} | {cell(words)} |")
    print("\n" + ", ".join(f"{n} {verdict}" for verdict, n in sorted(counts.items())) + "; none silently wrong.")


main()
