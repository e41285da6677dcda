#!/bin/bash
# Both BIDS validators on a dataset of two subjects x two days that `reach` writes, with a block of several kinds.
# Needs node and npm; $1 is the build folder.
set -euo pipefail
build=$(realpath "$1")
source=$(realpath "$(dirname "$0")/../..")
work=$build/bids-validators
data=$work/dataset
command -v npm > /dev/null || { echo "bids_validators: npm is missing: apt-get install nodejs npm"; exit 1; }
mkdir -p "$work"
cd "$work"
[ -d node_modules/bids-validator ] && [ -d node_modules/deno ] || npm install --no-audit --no-fund bids-validator@1.15.0 deno > npm.log 2>&1 || { cat npm.log; exit 1; }

rm -rf "$data"
age=24
for subject in 01 02; do
  for session in 01 02; do
    for experiment in chain-moderate torus; do
      "$build/cli/reach" run $experiment --device simulated --trials 3 --seed 1 --fast --subject $subject --session $session --data "$data" \
        --age $age --sex F --handedness R > /dev/null
    done
    "$build/cli/reach" run "$source/tests/record/bids/mixed.json" --device simulated:kind=ofc --seed 1 --fast --subject $subject --session $session \
      --data "$data" --age $age --sex F --handedness R > /dev/null
  done
  age=31
done
npx bids-validator "$data" -c "$source/tests/record/bids/legacy-validator.json" --no-color
npx deno run --allow-read --allow-env --no-remote node_modules/bids-validator/dist/validator/bids-validator.js "$data" \
  -c "$source/tests/record/bids/schema-validator.json" --no-color
echo "bids_validators: both pass"
