#!/bin/bash
# 200 kill -9 at seeded random moments of fast runs, and as many of an export. $1 is the build folder.
set -euo pipefail
REACHLAB_KILLS=${REACHLAB_KILLS:-200} "$1/tests/test_cli" --gtest_filter='Kill.*'
