#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "bench/contender.h"

/// Times the method that `auto` takes on the scenes named (none: all), REPEATS times each: a line `scene ns` with the least price of a
/// millisecond. tests/bench/against.py builds this file against two versions, so it uses what both have.
int main(int count, char** words) {
  using namespace reachlab::bench;
  const int repeats = count > 1 ? std::atoi(words[1]) : 100;
  for (const BenchScene& scene : benchScenes()) {
    bool wanted = count < 3;
    for (int i = 2; i < count; ++i) wanted = wanted || scene.name == words[i];
    if (!wanted) continue;
    const Contender contender = makePlantContender(scene, "auto", 1e-3, 1e-10);
    double best = 1e300;
    for (int i = 0; i <= repeats; ++i) {
      const auto begin = std::chrono::steady_clock::now();
      contender.run(nullptr);
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
      if (i > 0) best = std::min(best, took.count());
    }
    std::printf("%s %.6g\n", scene.name.c_str(), best / scene.duration * 1e6);
  }
}
