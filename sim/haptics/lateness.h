#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstdint>

namespace reachlab::haptics {

/// Counts durations in buckets that are 1/16 of their octave wide. Percentiles are right to 6 % from nanoseconds to hours, and the
/// maximum is exact. Fixed size. `add` from one thread, wait-free. Reading from any thread, approximate while it is being filled.
class LatenessHistogram {
 public:
  void add(std::int64_t ns) noexcept {
    const auto value = static_cast<std::uint64_t>(std::max<std::int64_t>(ns, 0));
    auto& bucket = counts_[bucketOf(value)];
    bucket.store(bucket.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    if (value > max_.load(std::memory_order_relaxed)) max_.store(value, std::memory_order_relaxed);
  }

  /// The duration [ns] that `share` (0 … 1) of all stay below. It is the upper edge of its bucket, at most the maximum. 0 if empty.
  double percentile(double share) const noexcept {
    std::uint64_t total = 0;
    for (const auto& count : counts_) total += count.load(std::memory_order_relaxed);
    if (total == 0) return 0;
    const double wanted = share * static_cast<double>(total);
    std::uint64_t seen = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      seen += counts_[i].load(std::memory_order_relaxed);
      if (static_cast<double>(seen) >= wanted) return std::min(static_cast<double>(upperEdge(i)), max());
    }
    return max();
  }
  double max() const noexcept { return static_cast<double>(max_.load(std::memory_order_relaxed)); }

 private:
  static constexpr int kSubBits = 4;
  static constexpr std::uint64_t kSub = 1u << kSubBits;
  // Below 16 each number has its own bucket. Above, the four bits after the leading one choose within the octave.
  static constexpr std::size_t bucketOf(std::uint64_t value) noexcept {
    if (value < kSub) return value;
    const int shift = static_cast<int>(std::bit_width(value)) - 1 - kSubBits;
    return static_cast<std::size_t>((static_cast<std::uint64_t>(shift) + 1) * kSub + ((value >> shift) - kSub));
  }
  static constexpr std::uint64_t upperEdge(std::size_t bucket) noexcept {
    if (bucket < kSub) return bucket;
    const std::uint64_t shift = bucket / kSub - 1;
    return ((bucket % kSub + kSub + 1) << shift) - 1;
  }
  std::array<std::atomic<std::uint64_t>, 61 * kSub> counts_{};
  std::atomic<std::uint64_t> max_{0};
};

}  // namespace reachlab::haptics
