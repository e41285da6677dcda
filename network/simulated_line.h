#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "base/seeded.h"

namespace reachlab::network {

/// How a line treats what is sent over it, one way.
struct LineConditions {
  double delay = 0;   // [s]
  double jitter = 0;  // [s] uniform, +-
  double loss = 0;    // share
};

/// A line under a clock of the caller's, seeded: the same sends give the same arrivals on every machine.
template <class Sample>
class SimulatedLine {
 public:
  SimulatedLine(const LineConditions& conditions, std::uint64_t seed) : conditions_(conditions), seed_(seed) {}

  void send(const Sample& sample, double now) {
    if (seededFraction(seed_, count_++) < conditions_.loss) return;
    const double jitter = conditions_.jitter * (2 * seededFraction(seed_, count_++) - 1);
    under_.push_back({now + conditions_.delay + jitter, sample});
  }
  /// Everything that has arrived by `now`, in the order of sending.
  template <class Take>
  void receive(double now, Take&& take) {
    constexpr double kSame = 1e-9;  // [s]
    std::size_t kept = 0;
    for (std::size_t i = 0; i < under_.size(); ++i) {
      if (under_[i].at <= now + kSame) take(under_[i].sample);
      else under_[kept++] = under_[i];
    }
    under_.resize(kept);
  }

 private:
  struct Flying {
    double at = 0;  // [s]
    Sample sample;
  };
  LineConditions conditions_;
  std::uint64_t seed_, count_ = 0;
  std::vector<Flying> under_;
};

}  // namespace reachlab::network
