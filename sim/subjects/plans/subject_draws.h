#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/math/elementary.h"
#include "base/math/seeded.h"

namespace reachlab::subjects {

/// Draws of one trial. They are the same on every machine, unlike the standard library's distributions.
class SubjectDraws {
 public:
  SubjectDraws(std::uint64_t seed, std::uint64_t trial) : state_(seededBits(seed, trial)) {}
  double uniform() { return seededFraction(state_, count_++); }
  /// Box and Muller 1958.
  double normal() {
    const double radius = std::sqrt(-2 * elementary::log(1 - uniform()));
    return radius * elementary::cos(2 * std::numbers::pi * uniform());
  }
  /// The same within 3 SD, so that no trial leaves the human range.
  double boundedNormal() { return std::clamp(normal(), -3.0, 3.0); }
  /// A reaction time of `usual` on average with 15 % SD, and less with a noise below 1.
  double reaction(double usual, double noise) { return usual * (1 + std::min(noise, 1.0) * kReactionSpread * boundedNormal()); }

 private:
  static constexpr double kReactionSpread = 0.15;

  std::uint64_t state_, count_ = 0;
};

}  // namespace reachlab::subjects
