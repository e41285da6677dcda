#!/bin/bash
# A thousand seeded fault runs of every driver that renders force (tests/devices/fault_runs_test.cpp). $1 is the build folder.
set -euo pipefail
RC_PARAMS="seed=20260101 max_success=${2:-1000}" "$1/tests/test_devices" --gtest_filter='FaultRuns.*'
