#pragma once
#include <vector>

#include "base/ticks.h"
#include "devices/virtual/device_model.h"
#include "devices/virtual/virtual_device.h"
#include "sim/experiment/velocity_estimator_spec.h"

namespace reachlab::devices {

/// A held device on a virtual spring and damper to a fixed point, sampled at the tick: the simplest loop that can become unstable.
struct LoopSettings {
  double stiffness = 600;                       // [N/m] k_h
  double damping = 0;                           // [N s/m] b_h, on the estimated velocity
  double mass = 0.1;                            // [kg] apparent mass of the device and what moves with it
  double friction = 0.5;                        // [N s/m] viscous: device and hand together
  double handStiffness = 0;                     // [N/m] of the hand to the ground
  int delayTicks = 0;                           // beyond the loop's own hold of one tick
  double period = kTickSeconds;                 // [s] T of the loop
  experiment::VelocityEstimatorSpec estimator;  // of b_h: difference, butterworth (auto and device are taken for it)
};

/// Largest |eigenvalue| of one tick of the sampled loop: below 1 every motion dies out. Between two ticks the force is held and the body
/// follows m x'' = F - b x' - k x exactly (matrix exponential); F(n) = -k_h x(n - d) - b_h v(n - d) with v the estimator's. Linear:
/// Coulomb friction and quantisation, which bound what an unstable loop does and feed what a stable one does, are left out.
double spectralRadius(const LoopSettings& settings);
inline bool isStable(const LoopSettings& settings) { return spectralRadius(settings) < 1; }

/// Colgate and Schenkel 1997: a sampled wall of stiffness K and damping B is passive when the body's own viscous friction exceeds
/// K T/2 + |B|. What friction is left over (negative: not passive) [N s/m].
double passivityMargin(const LoopSettings& settings) noexcept;

/// The largest stable stiffness, everything else as given, by bisection within [0, most] to 0.1 %; `most` where all are stable.
double largestStableStiffness(LoopSettings settings, double most = 1e5);

}  // namespace reachlab::devices
