#pragma once
#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace reachlab::network {

/// The loss of a peer's link, measured with probes. They are so far apart that no probe overtakes another probe (50 per second: a jitter of
/// up to 10 ms in each direction).
class ProbeLoss {
 public:
  void add(std::uint32_t number) {
    if (known_ == 0 || number <= last_) came_.reset(), known_ = 0, last_ = number - 1;  // the program of the peer was started again
    const std::size_t steps = std::min<std::size_t>(number - last_, kMany);
    came_ <<= steps;
    came_.set(0);
    known_ = std::min(known_ + steps, kMany);
    last_ = number;
  }
  /// Over the last two or the last ten seconds, whichever is more: a link that becomes bad is noticed soon, and two lucky seconds do not
  /// make a bad link good. 0 before the first probe.
  double share() const { return std::max(shareOf(kFew), shareOf(kMany)); }
  /// The most that may be lost if the probes of the last ten seconds had little luck: one-sided interval of Wilson (1927), and at least
  /// `share`. 1 before the first probe, at most 0.2 from the 56th on if all came.
  double bound() const {
    if (known_ == 0) return 1;
    constexpr double kZ = 3.719;  // standard normal quantile of 1 - 1e-4: a trial may be armed at each of many moments
    const double n = static_cast<double>(known_), share = shareOf(kMany), half = kZ * kZ / (2 * n);
    return std::max(this->share(), (share + half + kZ * std::sqrt(share * (1 - share) / n + half / (2 * n))) / (1 + 2 * half));
  }

 private:
  static constexpr std::size_t kFew = 100, kMany = 500;
  double shareOf(std::size_t newest) const {
    const std::size_t count = std::min(newest, known_);
    if (count == 0) return 0;
    return 1 - static_cast<double>((came_ << (kMany - count)).count()) / static_cast<double>(count);
  }
  std::bitset<kMany> came_;  // the newest first
  std::size_t known_ = 0;
  std::uint32_t last_ = 0;
};

}  // namespace reachlab::network
