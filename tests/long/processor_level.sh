#!/bin/bash
# What is compiled for x86-64-v3 refuses an older processor in words, before any newer instruction, and runs on one that has it. Needs qemu-user.
# $1 is the build folder.
set -euo pipefail
command -v qemu-x86_64 > /dev/null || { echo "processor_level: qemu-x86_64 is missing: apt-get install qemu-user"; exit 1; }
source=$(realpath "$(dirname "$0")/../..")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
# An object with a constructor that needs AVX2, beside the check.
cat > newer.cpp <<'CPP'
#include <cstdio>
#include <immintrin.h>
#include "base/system/processor_level.h"
volatile long long out[4];
struct Early {
  Early() {
    const __m256i sum = _mm256_add_epi64(_mm256_set1_epi64x(out[0] + 1), _mm256_set1_epi64x(2));
    _mm256_storeu_si256((__m256i*)out, sum);
  }
} early;
int main() {
  reachlab::requireProcessorLevel();
  std::printf("%s %lld\n", reachlab::processorLevel(), out[3]);
}
CPP
g++ -std=c++20 -O2 -I"$source" -march=x86-64-v3 -c newer.cpp
g++ -std=c++20 -O2 -I"$source" -march=x86-64 -DREACHLAB_LEVEL_NUMBER=3 -DREACHLAB_LEVEL_NAME='"x86-64-v3"' -c "$source/base/system/processor_level.cpp"
g++ newer.o processor_level.o -o newer
said=$(qemu-x86_64 -cpu Nehalem ./newer 2>&1) && ended=0 || ended=$?
[[ $ended == 3 && $said == *"level x86-64-v3"*"packaging/run" ]] || { echo "processor_level: on an older processor: exit $ended, '$said'"; exit 1; }
[[ $(qemu-x86_64 -cpu max ./newer) == "x86-64-v3 3" ]] || { echo "processor_level: on a newer processor it does not run"; exit 1; }
echo "processor_level: an older processor is refused with exit 3 and words, a newer one runs"
