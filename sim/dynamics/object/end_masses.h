#pragma once
#include <array>
#include <span>

#include "sim/dynamics/object/mass_state.h"

namespace reachlab::dynamics {

/// One axis of the first and of the last mass.
struct EndPlaces {
  std::array<double, 2> x{}, v{};  // [m], [m/s]
};

/// A plant whose masses cost far more to observe than a step (N^2 numbers from a chain's modes): its first and its last mass alone.
class EndMasses {
 public:
  virtual ~EndMasses() = default;
  /// r, v, q and q' of masses 1 and N, the same bits as observe() gives; masses.size() >= massCount(), the others stay as they were. Never
  /// allocates. False, and nothing done, where observing all is as cheap.
  virtual bool observeEnds(std::span<MassState> masses) const noexcept = 0;
};

}  // namespace reachlab::dynamics
