#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "bench/quad.h"

namespace reachlab::bench {

/// Integrates y' = f(t, y) with the extrapolated midpoint rule, in the arithmetic of T (Gragg 1965; Bulirsch & Stoer 1966). The step
/// numbers 2, 4, 6 … follow Hairer, Norsett & Wanner, Solving ODEs I, II.9. The method makes references: it is slow, of order 2·columns,
/// and checks itself. A step counts once its last two extrapolations differ by less than `tolerance` times the largest |y| so far.
template <class T, class Rate>
class Extrapolation {
 public:
  Extrapolation(Rate rate, int size, int columns, double tolerance)
      : rate_(std::move(rate)), size_(size), columns_(columns), tolerance_(tolerance), slope_(size), previous_(size), current_(size),
        inner_(size), table_(columns, std::vector<T>(size)), result_(size) {}

  /// From t to `end`. Updates y and remembers the step length for the next call.
  void advance(T t, const T& end, std::vector<T>& y) {
    while (t < end) {
      if (step_ <= 0) step_ = end - t;
      for (const T& value : y) scale_ = std::max(scale_, static_cast<double>(absolute(value)));
      const bool last = t + step_ * T(1.0000001) >= end;
      const T h = last ? end - t : step_;
      const int used = tryStep(t, h, y);
      if (used == 0) {
        step_ = h / 2;
        if (static_cast<double>(step_) < 1e-14) throw RefusedError("bench: the reference integrator's step fell below 1e-14 s");
        continue;
      }
      t = last ? end : t + h;
      y = result_;
      // Few columns needed: the next step may be longer.
      if (!last || h == step_) step_ = used <= columns_ - 3 ? h * T(1.5) : h;
    }
  }

 private:
  // The number of columns used. 0 if all of them were not enough.
  int tryStep(const T& t, const T& h, const std::vector<T>& y) {
    rate_(t, y.data(), slope_.data());
    for (int j = 0; j < columns_; ++j) {
      midpoint(t, h, 2 * (j + 1), y, table_[j]);
      // Aitken-Neville in place, from the newest row upwards: table_[i] becomes T(j, j-i).
      for (int i = j - 1; i >= 0; --i) {
        const T ratio = T(j + 1) / T(i + 1), factor = 1 / (ratio * ratio - 1);
        for (int a = 0; a < size_; ++a) table_[i][a] = table_[i + 1][a] + (table_[i + 1][a] - table_[i][a]) * factor;
      }
      if (j < 5) continue;
      double change = 0;
      bool finite = true;
      for (int a = 0; a < size_; ++a) {
        const double d = static_cast<double>(absolute(T(table_[0][a] - table_[1][a])));
        if (!std::isfinite(d)) finite = false;
        change = std::max(change, d);
      }
      if (!finite) return 0;
      if (change <= tolerance_ * std::max(scale_, 1e-3)) {
        result_ = table_[0];
        return j + 1;
      }
    }
    return 0;
  }

  void midpoint(const T& t, const T& h, int n, const std::vector<T>& y, std::vector<T>& out) {
    const T dt = h / n;
    previous_ = y;
    for (int a = 0; a < size_; ++a) current_[a] = y[a] + dt * slope_[a];
    for (int i = 1; i < n; ++i) {
      rate_(t + i * dt, current_.data(), inner_.data());
      for (int a = 0; a < size_; ++a) {
        const T next = previous_[a] + 2 * dt * inner_[a];
        previous_[a] = current_[a];
        current_[a] = next;
      }
    }
    out = current_;
  }

  Rate rate_;
  int size_, columns_;
  double tolerance_, scale_ = 0;
  T step_ = 0;
  std::vector<T> slope_, previous_, current_, inner_;
  std::vector<std::vector<T>> table_;
  std::vector<T> result_;
};

}  // namespace reachlab::bench
