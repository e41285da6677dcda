#pragma once
#include <array>
#include <bit>

#include "base/math/lanes.h"
#include "sim/experiment/object_limits.h"

namespace reachlab::dynamics {

/// S numbers on the stack, with the size known to the compiler. S = 0: the size is known when the scene is compiled, within a bound, so
/// that a step never allocates. They are left uninitialised, because every method writes before it reads. Room beyond the last number holds
/// zeros, so that vectors are loaded and stored whole. Six numbers are a position and a velocity in space, each in a vector of four. A
/// vector of eight takes two registers on most processors, and g++ 12 builds it in memory, number by number.
template <int S>
struct Numbers {
  static constexpr bool kHalves = S == 6;
  static constexpr int kRoom = S < 8 ? static_cast<int>(std::bit_ceil(static_cast<unsigned>(S))) : (S + 7) / 8 * 8;  // whole vectors
  std::array<double, kRoom> values;
  explicit Numbers(int = S) {
    if constexpr (kHalves) values[3] = values[7] = 0;
    else
      for (int i = S; i < kRoom; ++i) values[i] = 0;
  }
  /// Writes all numbers in one store. A vector load waits until the last of several single stores has left the store buffer. This costs as
  /// much as a third of a step.
  template <class... Each>
  [[gnu::always_inline]] void assign(Each... each) noexcept requires(sizeof...(Each) == S && kRoom <= 8) {
    if constexpr (kHalves) {
      const std::array<double, S> all{each...};
      storeLanes(Lanes<4>{all[0], all[1], all[2], 0.0}, &values[0]);
      storeLanes(Lanes<4>{all[3], all[4], all[5], 0.0}, &values[4]);
    } else {
      storeLanes(Lanes<kRoom>{each...}, values.data());
    }
  }
  static constexpr int size() noexcept { return S; }
  double& operator[](int i) noexcept { return values[slot(i)]; }
  const double& operator[](int i) const noexcept { return values[slot(i)]; }

 private:
  static constexpr int slot(int i) noexcept { return kHalves && i >= 3 ? i + 1 : i; }
};

inline constexpr int kMaxStates = 6 * experiment::kMaxMasses;

template <>
struct Numbers<0> {
  static constexpr bool kHalves = false;
  explicit Numbers(int size) : size_(size) {}
  Numbers(const Numbers& other) noexcept : size_(other.size_) { copy(other); }
  Numbers& operator=(const Numbers& other) noexcept {
    size_ = other.size_;
    copy(other);
    return *this;
  }
  int size() const noexcept { return size_; }
  double& operator[](int i) noexcept { return values_[i]; }
  const double& operator[](int i) const noexcept { return values_[i]; }

 private:
  void copy(const Numbers& other) noexcept {
    for (int i = 0; i < size_; ++i) values_[i] = other.values_[i];
  }
  int size_;
  std::array<double, kMaxStates> values_;
};

}  // namespace reachlab::dynamics
