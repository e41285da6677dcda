#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <type_traits>

#include "base/system/triple_buffer.h"

namespace reachlab {

/// Carries every item from one thread to a second thread, in order. It is bounded, and a full queue reports that it is full. Neither side
/// waits.
template <typename T, std::size_t Capacity>
class SpscQueue {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// Writer, wait-free: false when full.
  bool tryPush(const T& item) noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) == Capacity) return false;
    items_[head % Capacity] = item;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }
  /// Reader, wait-free: false when empty.
  bool tryPop(T& item) noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) return false;
    item = items_[tail % Capacity];
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

 private:
  alignas(kCacheLine) std::atomic<std::size_t> head_{0};
  alignas(kCacheLine) std::atomic<std::size_t> tail_{0};
  alignas(kCacheLine) std::array<T, Capacity> items_{};
};

}  // namespace reachlab
