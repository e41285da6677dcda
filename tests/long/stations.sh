#!/bin/bash
# Stations that live in real time, one of them killed in mid-trial. $1 is the build folder; the machine should be quiet.
set -euo pipefail
exec "$1/tests/test_cli" --gtest_also_run_disabled_tests --gtest_filter='Stations.*'
