#pragma once
#include <array>
#include <bit>

#include "base/lanes.h"
#include "sim/experiment/experiment.h"

namespace reachlab::dynamics {

/// S numbers on the stack with the size known to the compiler; S = 0: the size is known when the scene is compiled, within a bound, so
/// that a step allocates nothing either way. Left uninitialised: every method writes before it reads. Room beyond
/// the last number holds zeros, so that vectors are loaded and stored whole.
template <int S>
struct Numbers {
  static constexpr int kRoom = S < 8 ? static_cast<int>(std::bit_ceil(static_cast<unsigned>(S))) : (S + 7) / 8 * 8;  // whole vectors
  std::array<double, kRoom> values;
  explicit Numbers(int = S) {
    for (int i = S; i < kRoom; ++i) values[i] = 0;
  }
  /// All numbers in one store: a vector that is loaded where its numbers were stored one by one waits for the last of them to leave
  /// the store buffer, which costs as much as a third of a step.
  template <class... Each>
  [[gnu::always_inline]] void assign(Each... each) noexcept requires(sizeof...(Each) == S && kRoom <= 8) {
    storeLanes(Lanes<kRoom>{each...}, values.data());
  }
  static constexpr int size() noexcept { return S; }
  double& operator[](int i) noexcept { return values[i]; }
  const double& operator[](int i) const noexcept { return values[i]; }
};

inline constexpr int kMaxStates = 6 * experiment::kMaxMasses;

template <>
struct Numbers<0> {
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
