#pragma once
#include <vector>

#include "base/ticks.h"
#include "devices/virtual/device_model.h"
#include "devices/virtual/virtual_device.h"
#include "sim/experiment/velocity_estimator_spec.h"

namespace reachlab::devices {

/// A held device on a virtual spring and damper to a fixed point, sampled at the tick. This is the simplest loop that can become unstable.
struct LoopSettings {
  double stiffness = 600;                       // [N/m] k_h
  double damping = 0;                           // [N s/m] b_h, on the estimated velocity
  double mass = 0.1;                            // [kg] apparent mass of the device and of the parts that move with it
  double friction = 0.5;                        // [N s/m] viscous: device and hand together
  double handStiffness = 0;                     // [N/m] of the hand to the ground
  int delayTicks = 0;                           // beyond the loop's hold of one tick
  double period = kTickSeconds;                 // [s] T of the loop
  experiment::VelocityEstimatorSpec estimator;  // of b_h: difference, butterworth (auto and device are taken for it)
};

/// The largest |eigenvalue| of one tick of the sampled loop. Below 1 every motion dies out. Between two ticks the force is constant, and
/// the body follows m x'' = F - b x' - k x exactly (matrix exponential). The force is F(n) = -k_h x(n - d) - b_h v(n - d), with v from the
/// estimator. The model is linear. It leaves out Coulomb friction and quantisation. They limit the motion of an unstable loop, and they
/// feed the motion of a stable loop.
double spectralRadius(const LoopSettings& settings);
inline bool isStable(const LoopSettings& settings) { return spectralRadius(settings) < 1; }

/// Colgate and Schenkel 1997: a sampled wall of stiffness K and damping B is passive when the body's viscous friction exceeds K T/2 + |B|.
/// With d ticks of delay the first term is (1 + 2 d) K T/2, since sin((d + 1/2) w T)/sin(w T/2) in their condition is at most 1 + 2 d.
/// Returns the friction that is left over [N s/m]. A negative value means that the wall is not passive.
double passivityMargin(const LoopSettings& settings) noexcept;
/// The stiffness [N/m] at which nothing is left over: 2 (b - |B|)/(T (1 + 2 d)). 0 if the damping alone is not passive.
double largestPassiveStiffness(const LoopSettings& settings) noexcept;

/// The largest stable stiffness with all other values as given, by bisection within [0, most] to 0.1 %. Returns `most` if every stiffness
/// is stable.
double largestStableStiffness(LoopSettings settings, double most = 1e5);

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
  double largestPassive = 0;  // [N/m] largestPassiveStiffness: passive with any passive object
};

/// Ordered by hand damping, then by b_h. Settings out of range (a step that is not positive) give an empty map.
std::vector<StabilityPoint> computeStabilityMap(const DeviceModel& model, const StabilityMapSettings& settings);

}  // namespace reachlab::devices
