#!/usr/bin/python3
"""Writes the table of docs/adaptation.md: bias and coverage of the two-state fit, and how often the series tells one state from two.

    tests/bench/write_adaptation_recovery.py REACH [--series N]      REACH: the program; N series of each row [default: 200]

Series are simulated by the equations of the model, here and without the program, with published parameters and white noise. `reach adaptation`
fits each of them.
"""
import argparse
import json
import re
import statistics
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from random import Random

PAGE = Path(__file__).resolve().parents[2] / "docs/adaptation.md"
NAMES = ("a_f", "b_f", "a_s", "b_s")
SETS = {"Smith 2006": (0.59, 0.21, 0.992, 0.02), "Joiner 2008": (0.85, 0.11, 0.998, 0.021)}
# Perturbation (None: channel) and whether the response is measured.
DESIGNS = {"savings": [(1, True)] * 300 + [(-1, True)] * 20 + [(None, True)] * 100,
           "curl-adaptation": [(None, True) if n % 8 == 5 else (1 if 40 <= n < 200 else 0, False) for n in range(280)]}
NOISE = 0.1


def responses(truth, design):
    a_f, b_f, a_s, b_s = truth
    fast = slow = 0.0
    for perturbation, _ in design:
        yield fast + slow
        error = 0 if perturbation is None else perturbation - fast - slow
        fast, slow = a_f * fast + b_f * error, a_s * slow + b_s * error


def fit(reach, truth, design, seed):
    random = Random(seed)
    rows = [f"{'' if p is None else p},{x + random.gauss(0, NOISE) if seen else ''}" for (p, seen), x in zip(design, responses(truth, design))]
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
        file.write("\n".join(["perturbation,response", *rows, ""]))
        file.flush()
        return json.loads(subprocess.run([reach, "adaptation", file.name, "--json", "--resamples", "200"], check=True, stdout=subprocess.PIPE).stdout)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("reach", type=Path)
    parser.add_argument("--series", type=int, default=200)
    given = parser.parse_args()
    numbers = ["| series | parameters | number | truth | bias | SD | 95 % interval covers |", "|---|---|---|---|---|---|---|"]
    states = ["| series | parameters | two states | cannot tell | one state |", "|---|---|---|---|---|"]
    with ThreadPoolExecutor(2) as pool:
        for design in DESIGNS:
            for source, truth in SETS.items():
                fits = list(pool.map(lambda seed: fit(given.reach.resolve(), truth, DESIGNS[design], seed), range(given.series)))
                for name, true in zip(NAMES, truth):
                    found = [f["two_state"][name] for f in fits]
                    covers = sum(low <= true <= high for low, high in (f["two_state"]["interval_95"][name] for f in fits))
                    bias = f"{statistics.mean(found) - true:+.4f}".replace("-", "−")
                    spread, share = statistics.stdev(found), 100 * covers / len(fits)
                    numbers.append(f"| {design} | {source} | `{name}` | {true} | {bias} | {spread:.4f} | {share:.1f} % |")
                told = [f["states"] for f in fits]
                shares = " | ".join(f"{100 * told.count(count) / len(told):.0f} %" for count in ("two", "undecided", "one"))
                states.append(f"| {design} | {source} | {shares} |")
                print(*numbers[-4:], states[-1], sep="\n", flush=True)
    text = PAGE.read_text(encoding="utf-8")
    table = "\n".join([*numbers, "", *states])
    text, count = re.subn(r"(<!-- written by \S+ -->\n)(?:\|.*\n|\n(?=\|))+", lambda m: m[1] + table + "\n", text)
    assert count == 1, f"{PAGE}: no place for the table"
    PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
