#include "sim/predict/transcription/path_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math/gauss_legendre.h"

namespace reachlab::predict {
namespace {

constexpr int kIntervals = 96;
constexpr double kAgrees = 1e-6;  // of the largest change of the same kind over any interval: what is not resolved there differs by more

bool isFinitePoint(const PathPoint& p) { return isFinite(p.r) && isFinite(p.velocity) && isFinite(p.acceleration) && isFinite(p.jerk); }

}  // namespace

PathCheck checkPath(double duration, const std::function<PathPoint(double)>& at) {
  const GaussRule& rule = gaussRule16();
  const double width = duration / kIntervals;
  PathCheck check;
  struct Gap {
    std::array<double, 3> differs{};
  };
  std::array<Gap, kIntervals> gaps;
  std::array<double, 3> largest{};
  PathPoint begin = at(0);
  for (int i = 0; i < kIntervals; ++i) {
    std::array<Vec3, 3> change{};
    bool finite = true;
    for (size_t g = 0; g < rule.node.size(); ++g) {
      const PathPoint p = at(width * (i + (rule.node[g] + 1) / 2));
      const double weight = rule.weight[g] * width / 2;
      finite = finite && isFinitePoint(p);
      change[0] += weight * p.velocity, change[1] += weight * p.acceleration, change[2] += weight * p.jerk;
      check.cost += weight * dot(p.jerk, p.jerk);
    }
    const PathPoint end = at(width * (i + 1));
    if (!finite || !isFinitePoint(end)) return {check.cost, false, width * (i + 0.5)};
    const std::array<Vec3, 3> was{end.r - begin.r, end.velocity - begin.velocity, end.acceleration - begin.acceleration};
    for (size_t k = 0; k < 3; ++k) {
      gaps[i].differs[k] = norm(was[k] - change[k]);
      largest[k] = std::max({largest[k], norm(was[k]), norm(change[k])});
    }
    begin = end;
  }
  for (int i = 0; i < kIntervals; ++i)
    for (size_t k = 0; k < 3; ++k)
      if (gaps[i].differs[k] > kAgrees * largest[k]) return {check.cost, false, width * (i + 0.5)};
  return check;
}

}  // namespace reachlab::predict
