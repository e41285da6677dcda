#pragma once
#include <cstdint>
#include <deque>

#include "base/math/seeded.h"

namespace reachlab::network {

/// The effect of a link on its messages, in one direction.
struct LinkConditions {
  double delay = 0;   // [s]
  double jitter = 0;  // [s] uniform, +-
  double loss = 0;    // share
};

/// A link under a clock of the caller, with a seed. The same sends give the same arrivals on every machine.
template <class Sample>
class SimulatedLink {
 public:
  SimulatedLink(const LinkConditions& conditions, std::uint64_t seed) : conditions_(conditions), seed_(seed) {}

  void send(const Sample& sample, double now) {
    if (seededFraction(seed_, count_++) < conditions_.loss) return;
    const double jitter = conditions_.jitter * (2 * seededFraction(seed_, count_++) - 1);
    under_.push_back({now + conditions_.delay + jitter, sample, false});
  }
  /// Every message that has arrived by `now`, in the order of sending.
  template <class Take>
  void receive(double now, Take&& take) {
    constexpr double kSame = 1e-9;  // [s]
    for (Flying& one : under_)
      if (!one.taken && one.at <= now + kSame) take(one.sample), one.taken = true;
    while (!under_.empty() && under_.front().taken) under_.pop_front();
  }

 private:
  struct Flying {
    double at = 0;  // [s]
    Sample sample;
    bool taken = false;
  };
  LinkConditions conditions_;
  std::uint64_t seed_, count_ = 0;
  std::deque<Flying> under_;  // in the order of sending
};

}  // namespace reachlab::network
