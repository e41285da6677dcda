#pragma once
#include <array>
#include <span>

#include "sim/dynamics/object/mass_state.h"

namespace reachlab::dynamics {

/// Position and velocity of the first and of the last mass along one axis.
struct EndPlaces {
  std::array<double, 2> x{}, v{};  // [m], [m/s]
};

/// A plant whose first and last mass can be read alone, because observing all masses costs far more than a step (N^2 numbers from the modes
/// of a chain).
class EndMasses {
 public:
  virtual ~EndMasses() = default;
  /// Writes r, v, q and q' of masses 1 and N, with the bits of observe(). masses.size() >= massCount(). The masses between keep their
  /// values. Never allocates. Returns false and changes nothing where observing all masses is as cheap.
  virtual bool observeEnds(std::span<MassState> masses) const noexcept = 0;
};

}  // namespace reachlab::dynamics
