#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "sim/dynamics/adaptive.h"

namespace reachlab::dynamics {

/// Adams-Bashforth-Moulton, predict-evaluate-correct-evaluate (Hairer, Norsett, Wanner I, III.1): at most two right-hand sides and one
/// hand sample a tick. Predictor of order 7, corrector of order 8: y = p + dt gamma_7 nabla^7 f(p). Where the correction is near
/// rounding, f(p) stands for f(y) and the second right-hand side is spared (PEC), but for q' of y = (q, q'), which costs nothing: that
/// keeps an undamped mode stable up to |eigenvalue| dt = 0.1, where f(p) alone would up to 0.025. Beyond, the correction grows and brings
/// PECE back. The correction also estimates the error; where it is too large, and in the first ticks after a start or a break, the tick is done by
/// `Fallback` instead (the adaptive pair), and f at the ticks keeps its place in the history.
namespace adams {
inline constexpr int kHistory = 7;
inline constexpr double kGamma[kHistory + 1] = {1.0, 1.0 / 2, 5.0 / 12, 3.0 / 8, 251.0 / 720, 95.0 / 288, 19087.0 / 60480, 5257.0 / 17280};
inline constexpr double kCorrectorError = 275.0 / 24192;  // of order 7, |gamma*_7|
inline constexpr double kSparedShare = 0.5;  // of the largest good correction: below, f(p) is wrong by less than the tick's own error

template <int Width>
struct PackOf;  // written out: g++ 12 drops a vector size that depends on a parameter
template <>
struct PackOf<2> {
  using Type = double __attribute__((vector_size(16)));
};
template <>
struct PackOf<4> {
  using Type = double __attribute__((vector_size(32)));
};
template <>
struct PackOf<8> {
  using Type = double __attribute__((vector_size(64)));
};

/// S numbers in packs that the compiler keeps in vector registers (split where the processor has narrower ones); S = 0: as many as
/// there are. Lanes beyond the last number hold zeros.
template <int S>
struct Packs {
  static constexpr int kWidth = S == 0 ? 4 : S >= 8 ? 8 : static_cast<int>(std::bit_ceil(static_cast<unsigned>(S)));
  static constexpr int kMost = ((S == 0 ? kMostStates : S) + kWidth - 1) / kWidth;
  static constexpr bool kFull = S > 0 && S % kWidth == 0;
  using Pack = typename PackOf<kWidth>::Type;

  static constexpr int count(int states) noexcept { return S == 0 ? (states + kWidth - 1) / kWidth : kMost; }
  static Pack load(const Numbers<S>& y, int c) noexcept {
    if constexpr (kFull) {
      Pack pack;
      std::memcpy(&pack, &y[c * kWidth], sizeof(Pack));
      return pack;
    }
    return gather(y, c * kWidth, std::make_index_sequence<kWidth>());
  }
  static void store(const Pack& pack, Numbers<S>& y, int c) noexcept {
    if constexpr (kFull) {
      std::memcpy(&y[c * kWidth], &pack, sizeof(Pack));
      return;
    }
    for (int i = 0; i < kWidth; ++i)
      if (c * kWidth + i < y.size()) y[c * kWidth + i] = pack[i];
  }

  /// Number kBy + i in lane i of the first kBy, zero in the others.
  template <int kBy, std::size_t... I>
  static Pack shifted(const Pack& pack, std::index_sequence<I...>) noexcept {
    return __builtin_shufflevector(pack, Pack{}, (static_cast<int>(I) < kBy ? kBy + static_cast<int>(I) : kWidth)...);
  }

 private:
  template <std::size_t... I>
  static Pack gather(const Numbers<S>& y, int first, std::index_sequence<I...>) noexcept {
    return Pack{(first + static_cast<int>(I) < y.size() ? y[first + static_cast<int>(I)] : 0.0)...};
  }
};

template <class Pack>
Pack magnitude(const Pack& x) noexcept {
  return x < 0 ? -x : x;
}
/// Lane by lane all ones where `x` is not within `most`, or not a number.
template <class Pack>
auto beyond(const Pack& x, const Pack& most) noexcept {
  return ~(magnitude(x) <= most);
}
/// Some lane is not zero: by halves, since lanes taken out one by one cost more than the step's arithmetic.
template <class Mask>
bool anyLane(Mask mask) noexcept {
  constexpr int kWidth = sizeof(Mask) / sizeof(std::int64_t);
  if constexpr (kWidth == 8) mask |= __builtin_shufflevector(mask, mask, 4, 5, 6, 7, 0, 1, 2, 3);
  if constexpr (kWidth == 8) mask |= __builtin_shufflevector(mask, mask, 2, 3, 0, 1, 6, 7, 4, 5);
  if constexpr (kWidth == 4) mask |= __builtin_shufflevector(mask, mask, 2, 3, 0, 1);
  return (mask[0] | mask[1]) != 0;
}
}  // namespace adams

template <class System, template <class> class Fallback>
class AbmWith {
 public:
  using State = typename System::State;
  AbmWith(const System& system, double tolerance)
      : fallback_(system, tolerance), limit_((tolerance > 0 ? tolerance : kDefaultTolerance) / 2),
        rows_(static_cast<std::size_t>(Packs::count(system.states()))) {
    State scale(system.states());
    for (int i = 0; i < system.states(); ++i) scale[i] = system.scale(i);
    for (int c = 0; c < packs(); ++c) rows_[c].scale = Packs::load(scale, c);
  }
  void restart() noexcept {
    count_ = 0;
    fallback_.restart();
  }

  [[gnu::flatten]] StepStatus step(const System& system, const HandSegment& hand, double dt, const State& y, State& next,
                                   StepReport& report) noexcept {
    if (count_ == 0 || dt != dt_) begin(system, hand, dt, y, report);
    if (count_ < adams::kHistory) return stepOtherwise(system, hand, y, next, report);
    const auto end = system.handOf(endOf(hand));
    const int n = system.states();
    State predicted(n), f(n);
    for (int c = 0; c < packs(); ++c) Packs::store(Packs::load(y, c) + dt * rows_[c].ahead, predicted, c);
    system.rate(end, predicted, f);
    report.rhs += 1;
    report.error = limit_;
    Pack deviation[Packs::kMost];
    Mask noticeable{}, bad{};
    for (int c = 0; c < packs(); ++c) {
      deviation[c] = Packs::load(f, c) - rows_[c].sums[0];
      const Pack correction = dt * deviation[c];
      const Pack most = limit_ / adams::kCorrectorError * (rows_[c].scale + adams::magnitude(Packs::load(y, c)));
      Packs::store(Packs::load(predicted, c) + adams::kGamma[adams::kHistory] * correction, next, c);
      noticeable |= adams::beyond<Pack>(correction, adams::kSparedShare * most);
      bad |= adams::beyond<Pack>(correction, most);
    }
    if (adams::anyLane(noticeable)) {
      if (adams::anyLane(bad)) return stepOtherwise(system, hand, y, next, report);
      system.rate(end, next, f);
      report.rhs += 1;
      Mask broken{};
      for (int c = 0; c < packs(); ++c) {
        deviation[c] = Packs::load(f, c) - rows_[c].sums[0];
        broken |= ~(deviation[c] * 0.0 == 0.0);
      }
      if (adams::anyLane(broken)) return failed(StepStatus::NotFinite);
    } else if constexpr (System::kSecondOrder) {
      addCorrectedRates(adams::kGamma[adams::kHistory] * dt, n, deviation);
    }
    for (int c = 0; c < packs(); ++c) rows_[c].keep(deviation[c]);
    return StepStatus::Ok;
  }

 private:
  using Packs = adams::Packs<System::kStates>;
  using Pack = typename Packs::Pack;
  using Mask = decltype(Pack{} < Pack{});

  /// The history of some numbers as backward differences of f: sums[j] = nabla^j f + ... + nabla^6 f, so that sums[0] extrapolates f to
  /// the next tick and sums[j] + (f - sums[0]) is nabla^j f there. Only `ahead` waits for the newest f. Rounding dies out in seven ticks,
  /// since an error of nabla^j reaches higher differences alone.
  struct Row {
    Pack sums[adams::kHistory]{};
    Pack weighted{}, ahead{};  // sum of gamma_j sums[j]; of gamma_j nabla^j f: the predictor's mean slope
    Pack scale{};

    [[gnu::always_inline]] void keep(const Pack& deviation) noexcept {
      constexpr double kGammaSum = (adams::kGamma[0] + adams::kGamma[1] + adams::kGamma[2] + adams::kGamma[3]) +
                                   (adams::kGamma[4] + adams::kGamma[5] + adams::kGamma[6]);
      ahead = weighted + kGammaSum * deviation;
      Pack sum{}, total{};
      for (int j = adams::kHistory - 1; j >= 0; --j) {
        sum += sums[j] + deviation;
        sums[j] = sum;
        total += adams::kGamma[j] * sum;
      }
      weighted = total;
    }
  };

  /// q' of the corrected state in place of the predicted one's.
  [[gnu::always_inline]] static void addCorrectedRates(double factor, int n, Pack* deviation) noexcept {
    constexpr int kWidth = Packs::kWidth, kHalf = System::kStates / 2;
    if constexpr (kHalf > 0 && Packs::kMost == 1) {
      deviation[0] += factor * Packs::template shifted<kHalf>(deviation[0], std::make_index_sequence<kWidth>());
    } else if constexpr (kHalf > 0 && kHalf % kWidth == 0) {
      for (int c = 0; c < kHalf / kWidth; ++c) deviation[c] += factor * deviation[c + kHalf / kWidth];
    } else {
      for (int i = 0; i < n / 2; ++i) {
        const int from = n / 2 + i;
        deviation[i / kWidth][i % kWidth] += factor * deviation[from / kWidth][from % kWidth];
      }
    }
  }

  int packs() const noexcept { return System::kStates > 0 ? Packs::kMost : static_cast<int>(rows_.size()); }

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
    for (int c = 0; c < packs(); ++c) rows_[c].keep(Packs::load(f, c) - rows_[c].sums[0]);
    if (count_ < adams::kHistory) ++count_;
  }
  [[gnu::noinline]] void begin(const System& system, const HandSegment& hand, double dt, const State& y, StepReport& report) noexcept {
    State f(system.states());
    system.rate(system.handAt(hand, 0), y, f);
    report.rhs += 1;
    for (Row& row : rows_) {
      for (Pack& sum : row.sums) sum = Pack{};
      row.weighted = Pack{};
    }
    dt_ = dt;
    count_ = 0;
    keep(f);
  }
  /// By the fallback.
  [[gnu::noinline]] StepStatus stepOtherwise(const System& system, const HandSegment& hand, const State& y, State& next,
                                             StepReport& report) noexcept {
    const StepStatus status = fallback_.step(system, hand, dt_, y, next, report);
    if (status != StepStatus::Ok) return failed(status);
    State f(system.states());
    system.rate(system.handAt(hand, 1), next, f);
    report.rhs += 1;
    if (!isFinite(f)) return failed(StepStatus::NotFinite);
    keep(f);
    return StepStatus::Ok;
  }

  Fallback<System> fallback_;
  double limit_;
  double dt_ = 0;
  int count_ = 0;
  std::vector<Row> rows_;
};

template <class System>
using Abm = AbmWith<System, Adaptive>;

}  // namespace reachlab::dynamics
