#pragma once
#include <array>
#include <memory>

#include "constraints/formula/interval_series.h"

namespace reachlab::constraints {

struct Constraint;

/// Sees bumps, ridges and steps of a typed surface on the way of a mass, by interval arithmetic on the formula about its parameters. A step
/// over less than it allows misses less than narrow::kUnseen of the velocity. One for each plant. Only the constructor allocates.
class SurfaceWatch {
 public:
  /// Null for a definition of the catalogue, whose shape is known.
  static std::shared_ptr<SurfaceWatch> make(const Constraint& surface);
  explicit SurfaceWatch(const Constraint& surface);

  struct Motion {
    std::array<double, 2> q{}, rate{}, acceleration{};  // [1/s], [1/s^2]
    std::array<double, 2> length{};                     // [m] |r_u|, |r_v|
    double speed = 0;                                   // [m/s]
  };
  /// The longest step, at most `most` [s]. Where the formula has no bounds, as beside a pole, nothing is said and it is `most`.
  double reach(const Motion& motion, double most) noexcept;
  /// True if the mass is where each step of dt is known to be short enough. Does not compute.
  bool knows(const std::array<double, 2>& q, const std::array<double, 2>& rate, double dt) const noexcept {
    for (std::size_t k = 0; k < 2; ++k)
      if (!(std::abs(rate[k]) <= fastest_[k] && q[k] - fastest_[k] * dt >= known_[k].lo && q[k] + fastest_[k] * dt <= known_[k].hi))
        return false;
    return dt <= within_;
  }
  /// Whether steps of dt are short enough now. Learns about some ticks ahead.
  bool allows(const Motion& motion, double dt) noexcept;

 private:
  IntervalSeries series_;
  std::array<Interval, 2> known_{Interval{0, -1}, Interval{0, -1}};
  std::array<double, 2> fastest_{};
  double within_ = 0;
};

}  // namespace reachlab::constraints
