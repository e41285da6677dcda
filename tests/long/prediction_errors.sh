#!/usr/bin/env bash
# What predictions on curves and surfaces say of their own error, on the whole catalogue, against a truth by another formulation, computed
# anew (a minute; needs python3-scipy and python3-sympy). The default tests take the table of that truth that is in the repository.
#   tests/long/prediction_errors.sh BUILD_FOLDER
set -euo pipefail
build=${1:-build/dev}
reference=$(mktemp)
trap 'rm -f "$reference"' EXIT
/usr/bin/python3 tests/predict/path_reference.py constraints/definitions > "$reference"
REACHLAB_PATH_REFERENCE=$reference "$build/tests/test_predict" --gtest_filter='PathError.*'
