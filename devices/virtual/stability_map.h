#pragma once
#include <vector>

#include "devices/virtual/loop_stability.h"

namespace reachlab::devices {

/// The range of a map: one device, held by hands of several dampings, over a range of b_h.
struct StabilityMapSettings {
  double handMass = 0.3;                            // [kg] that moves with the handle
  std::vector<double> handDampings{0.5, 1, 3, 10};  // [N s/m]
  double mostDamping = 20, dampingStep = 0.25;      // [N s/m] of b_h, from 0
  int delayTicks = 0;
  experiment::VelocityEstimatorSpec estimator;
};

struct StabilityPoint {
  double handDamping = 0;     // [N s/m]
  double damping = 0;         // [N s/m] b_h
  double largestStable = 0;   // [N/m] k_h below which every motion dies out
  double largestPassive = 0;  // [N/m] Colgate's 2 (b - |b_h|)/T, or 0 without a passive stiffness: passive with any passive object
};

/// Ordered by hand damping, then by b_h. Settings out of range (a step that is not positive) give an empty map.
std::vector<StabilityPoint> computeStabilityMap(const DeviceModel& model, const StabilityMapSettings& settings);

}  // namespace reachlab::devices
