#!/usr/bin/env bash
# 10,000 random formulas of the whole language: a free mass keeps its energy to 1e-9 over 2 s, or stops in words.
set -euo pipefail
build=${1:-build/dev}
REACHLAB_RANDOM_FORMULAS=10000 "$build/tests/test_dynamics" --gtest_filter='RandomFormulas.*'
