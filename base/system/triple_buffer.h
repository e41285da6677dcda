#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

namespace reachlab {

inline constexpr std::size_t kCacheLine = 64;

/// Carries the latest value from one thread to a second thread. One slot is being written, one is being read, and one waits between them.
/// Each side swaps its slot with the waiting slot. Neither side ever waits, and a value is never torn. Values that are not taken in time
/// are lost.
template <typename T>
class TripleBuffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// Writer: the slot to fill, holding some older value. Then `publish`.
  T& back() noexcept { return (*slots_)[back_].value; }
  /// Writer, wait-free: makes the slot the latest value.
  void publish() noexcept { back_ = waiting_.exchange(back_ | kNew, std::memory_order_acq_rel) & kIndex; }
  void publish(const T& value) noexcept {
    back() = value;
    publish();
  }

  /// Reader, wait-free: the latest value, or nullptr if no value is newer than the last that was taken. Valid until the next call.
  const T* takeLatest() noexcept {
    if ((waiting_.load(std::memory_order_relaxed) & kNew) == 0) return nullptr;
    front_ = waiting_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return &(*slots_)[front_].value;
  }

 private:
  static constexpr std::uint8_t kIndex = 3, kNew = 4;
  struct alignas(kCacheLine) Slot {
    T value{};
  };
  std::unique_ptr<std::array<Slot, 3>> slots_ = std::make_unique<std::array<Slot, 3>>();
  alignas(kCacheLine) std::uint8_t back_ = 0;  // writer only
  alignas(kCacheLine) std::atomic<std::uint8_t> waiting_{1};
  alignas(kCacheLine) std::uint8_t front_ = 2;  // reader only
};

}  // namespace reachlab
