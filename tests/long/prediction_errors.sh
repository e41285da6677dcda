#!/usr/bin/env bash
# What predictions on curves and surfaces say of their own error, against the truth, on the whole catalogue.
#   tests/long/prediction_errors.sh BUILD_FOLDER
set -euo pipefail
"${1:-build/dev}/tests/test_predict" --gtest_also_run_disabled_tests --gtest_filter='PathJerk.DISABLED_*'
