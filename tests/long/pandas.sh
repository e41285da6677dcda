#!/bin/bash
# pandas opens trials.csv and reproduces the printed success table. Needs python3-pandas. $1 is the build folder.
set -euo pipefail
build=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for experiment in chain-slow chain-moderate chain-fast; do
  "$build/cli/reach" run $experiment --device simulated --trials 20 --seed 1 --fast --data "$work/data" 2> /dev/null >> "$work/printed"
done
"$build/cli/reach" export "$work/data" --format csv --out "$work/csv" > /dev/null
/usr/bin/python3 - "$work/csv" "$work/printed" <<'PYTHON'
import glob, re, sys
import pandas
folder, printed = sys.argv[1:]
trials = pandas.read_csv(folder + "/trials.csv", dtype={"subject": str, "session": str}, float_precision="round_trip")
table = {}
for line in open(printed):
    cells = line.split()
    if len(cells) == 8 and cells[0] != "condition" and not line.startswith("trial="):
        table[cells[0]] = [int(c) for c in cells[1:6]]
assert len(table) == 3, table
for condition, rows in trials.groupby("condition"):
    counts = [len(rows)] + [int((rows.outcome == o).sum()) for o in ("success", "failure", "aborted", "interrupted")]
    assert counts == table[condition], (condition, counts, table[condition])
    print(f"pandas: {condition}: {counts[1]} of {counts[0]} succeed, as printed")
times = [float(t) for t in re.findall(r"time_s=(\S+)", open(printed).read())]
onset = trials.sort_values(["run", "trial"])
assert len(times) == len(onset)
assert all(row.movement_time_s == t for (_, row), t in zip(onset.iterrows(), times) if row.movement_time_s == row.movement_time_s)
for file in glob.glob(folder + "/*_samples.csv"):
    samples = pandas.read_csv(file)
    assert samples.dtypes.map(lambda t: t.kind in "fi").all(), file
    assert abs(samples.time_s.diff().dropna() - 0.01).max() < 1e-9, file
PYTHON
