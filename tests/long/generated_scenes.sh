#!/usr/bin/env bash
# 240 hard scenes composed at random (REACHLAB_SCENES, REACHLAB_SEED) beside solutions that use neither the program nor its equations.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=${1:-build/dev}
/usr/bin/python3 tests/nasty/generated_scenes.py "$build/cli/reach" --count "${REACHLAB_SCENES:-240}" --seed "${REACHLAB_SEED:-1}" > "$build/generated_scenes.tsv"
