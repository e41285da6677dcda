#pragma once
#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/record/log/trial_tracker.h"

namespace reachlab::record {

/// One tick for the recorder. The samples of its hands and its row, if any, lie in stores of the ring.
struct QueuedTick {
  TickStamp stamp;
  TickFacts facts;
  bool hasRow = false;
};

/// Bounded queue of ticks with rows of a length known at the start. It has one writer (haptic thread) and one reader (recorder), and no
/// thread waits. A row is `columns` numbers. Only some ticks have a row, so rows have a separate store.
class TickRing {
 public:
  TickRing(std::size_t ticks, std::size_t rows, std::size_t columns, std::size_t hands)
      : columns_(columns), slots_(ticks), rows_(rows * columns), rowCount_(rows), hands_(hands), devices_(ticks * hands) {}

  /// Writer: a slot to fill, or nullptr when full. `rowSpace` is set when a row fits too. `publish` makes it visible.
  QueuedTick* beginPush(double*& rowSpace) noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) == slots_.size()) return nullptr;
    const bool rowFits = rowHead_ - rowTail_.load(std::memory_order_acquire) < rowCount_;
    rowSpace = rowFits ? rows_.data() + rowHead_ % rowCount_ * columns_ : nullptr;
    return &slots_[head % slots_.size()];
  }
  /// Writer: room for each hand's raw sample at the slot that `beginPush` gave.
  std::span<haptics::DeviceSample> deviceSpace(const QueuedTick* slot) noexcept {
    return {devices_.data() + static_cast<std::size_t>(slot - slots_.data()) * hands_, hands_};
  }
  void publish(bool withRow) noexcept {
    if (withRow) ++rowHead_;
    head_.store(head_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

  /// Reader: the oldest tick, or nullptr. `row` is its row or nullptr. Valid until `pop`.
  const QueuedTick* front(const double*& row) const noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) return nullptr;
    const QueuedTick& tick = slots_[tail % slots_.size()];
    row = tick.hasRow ? rows_.data() + rowTail_.load(std::memory_order_relaxed) % rowCount_ * columns_ : nullptr;
    return &tick;
  }
  /// Reader: each hand's raw sample at that tick.
  std::span<const haptics::DeviceSample> devicesOf(const QueuedTick* tick) const noexcept {
    return {devices_.data() + static_cast<std::size_t>(tick - slots_.data()) * hands_, hands_};
  }
  void pop(bool withRow) noexcept {
    if (withRow) rowTail_.store(rowTail_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
    tail_.store(tail_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

 private:
  static constexpr std::size_t kCacheLine = 64;
  std::size_t columns_;
  std::vector<QueuedTick> slots_;
  std::vector<double> rows_;
  std::size_t rowCount_;
  std::size_t hands_;
  std::vector<haptics::DeviceSample> devices_;
  std::size_t rowHead_ = 0;  // writer only
  alignas(kCacheLine) std::atomic<std::size_t> head_{0};
  alignas(kCacheLine) std::atomic<std::size_t> tail_{0};
  alignas(kCacheLine) std::atomic<std::size_t> rowTail_{0};
};

}  // namespace reachlab::record
