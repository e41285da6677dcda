#!/bin/bash
# A few single faults put into the sources (REACHLAB_FAULTS of them, by the seed REACHLAB_SEED): the tests must notice them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
exec tests/long/seeded_faults.py --seed "${REACHLAB_SEED:-1}" --count "${REACHLAB_FAULTS:-12}" --least 0.75
