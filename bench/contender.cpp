#include "bench/contender.h"

#include <cmath>

namespace reachlab::bench {

Segments makeSegments(const BenchScene& scene, double step) {
  const int count = static_cast<int>(std::lround(scene.duration / step));
  auto segments = std::make_shared<std::vector<dynamics::HandSegment>>();
  segments->reserve(count);
  for (int i = 0; i < count; ++i) segments->push_back(makeSegment(scene.hand, i * step, step));
  return segments;
}

}  // namespace reachlab::bench
