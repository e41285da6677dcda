#!/bin/bash
# Sixty single faults put into what conducts a recorded run: each is noticed, or listed with the reason why it changes nothing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
exec tests/long/seeded_faults.py --seed "${REACHLAB_SEED:-11}" --count "${REACHLAB_FAULTS:-60}" --least 1 sim/session
