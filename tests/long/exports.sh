#!/bin/bash
# Octave and R read what `reach export` writes, number for number as the CSV has it. Needs octave, r-base-core and r-cran-hdf5r. $1 is the build folder.
set -euo pipefail
build=$(realpath "$1")
for program in octave-cli Rscript; do command -v $program > /dev/null || { echo "exports: $program is missing: apt-get install octave r-base-core r-cran-hdf5r"; exit 1; }; done
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
