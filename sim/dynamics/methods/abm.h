#pragma once
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include "base/math/lanes.h"
#include "sim/dynamics/methods/adaptive.h"

namespace reachlab::dynamics {

/// Adams-Bashforth-Moulton, predict-evaluate-correct-evaluate (Hairer, Norsett, Wanner I, III.1): at most two right-hand sides and one hand
/// sample per tick. The predictor has order 7, the corrector order 8: y = p + dt gamma_7 nabla^7 f(p). Where the correction is near
/// rounding, f(p) replaces f(y) and saves the second right-hand side (PEC). The exception is q' of y = (q, q'), which costs nothing. This
/// keeps an undamped mode stable up to |eigenvalue| dt = 0.1, where f(p) alone would be stable up to 0.025. Beyond this limit the
/// correction grows and brings PECE back. The correction also estimates the error. `Fallback` (the adaptive pair) computes a tick where the
/// error is too large, and the first ticks after a start or a break. f at these ticks still enters the history.
namespace adams {
inline constexpr int kHistory = 7;
inline constexpr double kGamma[kHistory + 1] = {1.0, 1.0 / 2, 5.0 / 12, 3.0 / 8, 251.0 / 720, 95.0 / 288, 19087.0 / 60480, 5257.0 / 17280};
inline constexpr double kCorrectorError = 275.0 / 24192;  // of order 7, |gamma*_7|
inline constexpr double kSparedShare = 0.5;  // of the largest good correction: below, f(p) is wrong by less than the tick's own error

/// S numbers in rows of lanes. S = 0: the number is known when the scene is compiled. Lanes beyond the last number hold zeros.
template <int S>
struct Rows {
  static constexpr int kWidth = S == 0 || Numbers<S>::kHalves ? 4 : S >= 8 ? 8 : static_cast<int>(std::bit_ceil(static_cast<unsigned>(S)));
  static constexpr int kCapacity = ((S == 0 ? kMaxStates : S) + kWidth - 1) / kWidth;
  static constexpr bool kFull = S > 0;  // Numbers have room for whole rows
  using Lanes = reachlab::Lanes<kWidth>;

  static constexpr int count(int states) noexcept { return S == 0 ? (states + kWidth - 1) / kWidth : kCapacity; }
  static Lanes load(const Numbers<S>& y, int c) noexcept {
    if constexpr (kFull) return loadLanes<Lanes>(y.values.data() + c * kWidth);
    return gather(y, c * kWidth, std::make_index_sequence<kWidth>());
  }
  static void store(const Lanes& row, Numbers<S>& y, int c) noexcept {
    if constexpr (kFull) {
      storeLanes(row, y.values.data() + c * kWidth);
      return;
    }
    for (int i = 0; i < kWidth; ++i)
      if (c * kWidth + i < y.size()) y[c * kWidth + i] = row[i];
  }

 private:
  template <std::size_t... I>
  static Lanes gather(const Numbers<S>& y, int first, std::index_sequence<I...>) noexcept {
    return Lanes{(first + static_cast<int>(I) < y.size() ? y[first + static_cast<int>(I)] : 0.0)...};
  }
};

/// Marks the lanes where `x` is not within `most`, or not a number.
template <class Lanes>
auto beyond(const Lanes& x, const Lanes& most) noexcept {
  return ~(magnitude(x) <= most);
}
}  // namespace adams

template <Equations System, template <class> class Fallback>
class AbmWith {
 public:
  using State = typename System::State;
  AbmWith(const System& system, double tolerance)
      : fallback_(system, tolerance), maxCorrection_((tolerance > 0 ? tolerance : kDefaultTolerance) / 2 / adams::kCorrectorError),
        rows_(static_cast<std::size_t>(Rows::count(system.states()))) {
    State scale(system.states());
    for (int i = 0; i < system.states(); ++i) scale[i] = system.scale(i);
    for (int c = 0; c < rowCount(); ++c) rows_[c].scale = Rows::load(scale, c);
  }
  void restart() noexcept {
    count_ = 0;
    fallback_.restart();
  }

  [[gnu::flatten]] StepStatus step(const System& system, const HandSegment& hand, double dt, const State& y, State& next,
                                   std::uint64_t& rhs) noexcept {
    if constexpr (System::kHas.gliding)
      if (system.glide(dt, y, next)) {  // exact, and leaves the history behind
        restart();
        return StepStatus::Ok;
      }
    if (count_ == 0 || dt != dt_) begin(system, hand, dt, y, rhs);
    if (count_ < adams::kHistory) return stepOtherwise(system, hand, y, next, rhs);
    if constexpr (System::kHas.care)
      if (system.wantsSubSteps(y, dt)) return stepOtherwise(system, hand, y, next, rhs);
    const auto end = system.handOf(endOf(hand));
    const int n = system.states();
    State predicted(n), f(n);
    for (int c = 0; c < rowCount(); ++c) Rows::store(mulAdd(dt, rows_[c].ahead, Rows::load(y, c)), predicted, c);
    system.rate(end, predicted, f);
    ++rhs;
    Lanes deviation[Rows::kCapacity];
    Marks noticeable{}, bad{};
    for (int c = 0; c < rowCount(); ++c) {
      deviation[c] = Rows::load(f, c) - rows_[c].sums[0];
      const Lanes correction = dt * deviation[c];
      const Lanes most = maxCorrection_ * (rows_[c].scale + magnitude(Rows::load(y, c)));
      Rows::store(mulAdd(adams::kGamma[adams::kHistory], correction, Rows::load(predicted, c)), next, c);
      noticeable |= adams::beyond<Lanes>(correction, adams::kSparedShare * most);
      bad |= adams::beyond<Lanes>(correction, most);
    }
    if (anyLane(noticeable)) {
      if (anyLane(bad)) return stepOtherwise(system, hand, y, next, rhs);
      system.rate(end, next, f);
      ++rhs;
      Marks broken{};
      for (int c = 0; c < rowCount(); ++c) {
        deviation[c] = Rows::load(f, c) - rows_[c].sums[0];
        broken |= ~(deviation[c] * 0.0 == 0.0);
      }
      if (anyLane(broken)) return failed(StepStatus::NotFinite);
    } else if constexpr (System::kSecondOrder) {
      addCorrectedRates(adams::kGamma[adams::kHistory] * dt, n, deviation);
    }
    for (int c = 0; c < rowCount(); ++c) rows_[c].keep(deviation[c]);
    return StepStatus::Ok;
  }

 private:
  using Rows = adams::Rows<System::kStates>;
  using Lanes = typename Rows::Lanes;
  using Marks = LaneMarks<Rows::kWidth>;

  /// The history of some numbers as backward differences of f: sums[j] = nabla^j f + ... + nabla^6 f. So sums[0] extrapolates f to the next
  /// tick, and sums[j] + (f - sums[0]) is nabla^j f there. Only `ahead` waits for the newest f. Rounding errors vanish after seven ticks,
  /// since an error of nabla^j reaches higher differences alone.
  struct Row {
    Lanes sums[adams::kHistory]{};
    Lanes weighted{}, ahead{};  // sum of gamma_j sums[j]; of gamma_j nabla^j f: the predictor's mean slope
    Lanes scale{};

    [[gnu::always_inline]] void keep(const Lanes& deviation) noexcept {
      constexpr double kGammaSum = (adams::kGamma[0] + adams::kGamma[1] + adams::kGamma[2] + adams::kGamma[3]) +
                                   (adams::kGamma[4] + adams::kGamma[5] + adams::kGamma[6]);
      ahead = mulAdd(kGammaSum, deviation, weighted);
      Lanes sum{}, total{};
      for (int j = adams::kHistory - 1; j >= 0; --j) {
        sum += sums[j] + deviation;
        sums[j] = sum;
        total = mulAdd(adams::kGamma[j], sum, total);
      }
      weighted = total;
    }
  };

  /// q' of the corrected state in place of q' of the predicted state.
  [[gnu::always_inline]] static void addCorrectedRates(double factor, int n, Lanes* deviation) noexcept {
    constexpr int kWidth = Rows::kWidth, kHalf = System::kStates / 2;
    if constexpr (kHalf > 0 && Rows::kCapacity == 1) {
      static_assert(2 * kHalf == kWidth);
      deviation[0] = mulAdd(factor, upperHalf(deviation[0]), deviation[0]);
    } else if constexpr (kHalf > 0 && (kHalf % kWidth == 0 || System::State::kHalves)) {
      constexpr int kRows = Rows::kCapacity / 2;
      for (int c = 0; c < kRows; ++c) deviation[c] = mulAdd(factor, deviation[c + kRows], deviation[c]);
    } else {
      for (int i = 0; i < n / 2; ++i) {
        const int from = n / 2 + i;
        deviation[i / kWidth][i % kWidth] += factor * deviation[from / kWidth][from % kWidth];
      }
    }
  }

  int rowCount() const noexcept { return System::kStates > 0 ? Rows::kCapacity : static_cast<int>(rows_.size()); }

  static bool isFinite(const State& f) noexcept {
    double check = 0;
    for (int i = 0; i < f.size(); ++i) check += f[i] * 0.0;
    return check == 0;
  }
  StepStatus failed(StepStatus status) noexcept {
    restart();
    return status;
  }
  void keep(const State& f) noexcept {
    for (int c = 0; c < rowCount(); ++c) rows_[c].keep(Rows::load(f, c) - rows_[c].sums[0]);
    if (count_ < adams::kHistory) ++count_;
  }
  [[gnu::noinline]] void begin(const System& system, const HandSegment& hand, double dt, const State& y, std::uint64_t& rhs) noexcept {
    State f(system.states());
    system.rate(system.handAt(hand, 0), y, f);
    ++rhs;
    for (Row& row : rows_) {
      for (Lanes& sum : row.sums) sum = Lanes{};
      row.weighted = Lanes{};
    }
    dt_ = dt;
    count_ = 0;
    keep(f);
  }
  /// One tick by the fallback.
  [[gnu::noinline]] StepStatus stepOtherwise(const System& system, const HandSegment& hand, const State& y, State& next,
                                             std::uint64_t& rhs) noexcept {
    const StepStatus status = fallback_.step(system, hand, dt_, y, next, rhs);
    if (status != StepStatus::Ok) return failed(status);
    State f(system.states());
    system.rate(system.handAt(hand, 1), next, f);
    ++rhs;
    if (!isFinite(f)) return failed(StepStatus::NotFinite);
    keep(f);
    return StepStatus::Ok;
  }

  Fallback<System> fallback_;
  double maxCorrection_;  // of the scale and the state
  double dt_ = 0;
  int count_ = 0;
  std::vector<Row> rows_;
};

}  // namespace reachlab::dynamics
