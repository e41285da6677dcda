#!/bin/bash
# Measures, and judges nothing: the recorder at 1 kHz x 50 masses, and opening sessions of 100, 1,000 and 10,000 trials. $1 is the build folder.
set -euo pipefail
"$1/tests/record_bench" rate 10
"$1/tests/record_bench" open 100 1000 10000
