#!/bin/bash
# Ten minutes of mutated inputs under AddressSanitizer and UndefinedBehaviorSanitizer (REACHLAB_MINUTES, REACHLAB_SEED), then two with limits of
# time and memory in the release build. packaging/test --all has built both.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
minutes=${REACHLAB_MINUTES:-10} seed=${REACHLAB_SEED:-$(date +%j)}
echo "mutate: seed $seed"
tests/fuzz/mutate.py build/asan --minutes "$minutes" --seed "$seed"
tests/fuzz/mutate.py build/release --minutes 2 --seed "$seed" --limits
