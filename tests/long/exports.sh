#!/bin/bash
# Octave, R and h5dump read what `reach export` writes, number for number as the CSV has it. Needs octave, r-base-core, r-cran-hdf5r and hdf5-tools.
# $1 is the build folder.
set -euo pipefail
build=$(realpath "$1")
for program in octave-cli Rscript h5dump; do command -v $program > /dev/null || { echo "exports: $program is missing: apt-get install octave r-base-core r-cran-hdf5r hdf5-tools"; exit 1; }; done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"$build/cli/reach" run chain-moderate --device simulated --trials 3 --seed 1 --fast --data data --notes "Übung" > /dev/null 2>&1
for format in csv mat hdf5; do "$build/cli/reach" export data --format $format > /dev/null; done
name=sub-01_ses-01_task-chainmoderate_run-01
cat > check.m <<'OCTAVE'
m = load(getenv('MAT'));
[file, columns] = deal(fopen(getenv('CSV')), []);
names = strsplit(fgetl(file), ',');
fclose(file);
rows = dlmread(getenv('CSV'), ',', 1, 0);
for k = 1:numel(names)
  a = m.(names{k}); b = rows(:, k);
  assert(isequal(size(a), size(b)) && all(a == b | (isnan(a) & isnan(b))), names{k});
end
assert(iscellstr(m.trials.outcome) && numel(m.trials.outcome) == 3);
assert(strcmp(m.trials.subject{1}, '01'));
assert(strcmp(m.units.hand_vx_m_per_s, 'm/s'));
printf('octave: %d columns of %d rows of the MAT file are those of the CSV\n', numel(names), rows(end, 1) * 100 + 1 - rows(1, 1) * 100);
OCTAVE
MAT=data/derivatives/mat/$name.mat CSV=data/derivatives/csv/${name}_samples.csv octave-cli --quiet --no-init-file check.m
# h5dump prints 17 digits, so that every number of the column is the CSV's to the bit.
for column in time_s hand_x_m; do
  h5dump -y -w 1 -m %.17g -d "samples/$column" "data/derivatives/hdf5/$name.h5" | sed -n '/DATA {/,/^ *}/{s/[ ,]//g;/^[-0-9.n]/p}' > dumped
  python3 - dumped "data/derivatives/csv/${name}_samples.csv" $column <<'PYTHON'
import csv, sys
dumped = [float(line) for line in open(sys.argv[1])]
rows = [float(row[sys.argv[3]]) for row in csv.DictReader(open(sys.argv[2]))]
assert len(rows) > 100 and dumped == rows, f"{sys.argv[3]}: {len(dumped)} and {len(rows)} numbers"
print(f"h5dump: {len(rows)} numbers of {sys.argv[3]} are those of the CSV")
PYTHON
done
# R: the CSV, and by hdf5r the HDF5 file.
Rscript - "data/derivatives/csv/${name}_samples.csv" "data/derivatives/hdf5/$name.h5" <<'R'
paths <- commandArgs(TRUE)
samples <- read.csv(paths[1], numerals = "no.loss")
suppressPackageStartupMessages(library(hdf5r))
file <- H5File$new(paths[2], "r")
for (name in names(samples)) stopifnot(identical(as.numeric(samples[[name]]), file[[paste0("samples/", name)]]$read()))
stopifnot(identical(file[["trials/subject"]]$read(), rep("01", 3)))
cat(sprintf("R: %d columns of %d rows of the HDF5 file are those of the CSV\n", ncol(samples), nrow(samples)))
R
