#pragma once
#include <string>

namespace reachlab::experiment {

/// How v_HIP is estimated from device samples.
struct VelocityEstimatorSpec {
  std::string kind = "auto";  // auto | difference | butterworth | device
  double cutoff = 40;         // [Hz] butterworth
  bool operator==(const VelocityEstimatorSpec&) const = default;
};

}  // namespace reachlab::experiment
