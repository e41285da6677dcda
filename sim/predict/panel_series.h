#pragma once
#include <memory_resource>
#include <vector>

#include "sim/predict/pack.h"
#include "sim/predict/sparse_rows.h"

namespace reachlab::predict {

/// A movement in equal panels, whose number is a multiple of kPack; s in [-1, 1] runs over each.
struct PanelGrid {
  int panels = 0;
  double halfWidth = 0;  // [s]
  double rate = 0;       // bound of |A| times halfWidth
  int blocks() const { return panels / kPack; }
  /// Taylor terms until they are below `part` of the largest.
  int termsAbove(double part) const;
};

/// x' = A x + b u of eight panels at once: derivatives of x after s, [term][state], from x itself, which is in place. `rows` and
/// `b` are A and b times the half width; without the derivatives of `u`, [term], the motion is free.
template <class Real>
void expandPanels(const SparseRows<Real>& rows, int states, int terms, typename PackOf<Real>::Type* x, const Real* b = nullptr,
                  const typename PackOf<Real>::Type* u = nullptr);

/// 1/k!, which makes derivatives Taylor coefficients.
template <class Real>
std::vector<Real> inverseFactorials(int count);

/// The first terms of Taylor series with all digits of Real; the small ones after them in double, whose digits then reach as far.
struct TermCount {
  int wide = 0, narrow = 0;
};

/// e^{A halfWidth}.
template <class Real>
class PanelStep {
 public:
  PanelStep(const LineSystem<Real>& system, const PanelGrid& grid, TermCount terms);
  /// y = e^{A halfWidth} x; not in place.
  void apply(const std::vector<Real>& x, std::vector<Real>& y) const;

 private:
  using Packed = typename PackOf<Real>::Type;
  int states_, packs_;
  std::vector<Packed> columns_;  // [column][pack of rows]
};

/// y(s) = e^{A s} b by its derivatives after s in the middles of all panels, to `tolerance` of y. Real is double or DoubleDouble. The
/// series lies in `memory`, which must live longer: bytesFor() of it.
template <class Real>
class PanelSeries {
 public:
  using Packed = typename PackOf<Real>::Type;
  PanelSeries(const LineSystem<Real>& system, const PanelGrid& grid, double tolerance, std::pmr::memory_resource& memory);
  static size_t bytesFor(const PanelGrid& grid, int states, double tolerance);

  /// y^T l by its derivatives, [block][term], to the nearest double.
  std::vector<Pack> makeControl(const std::vector<Real>& l) const;
  /// The integral of y u over the movement, exact for these series.
  std::vector<Real> integrate(const std::vector<Pack>& u) const;

  /// Derivatives of all states; not of the small terms of a series in DoubleDouble.
  const Packed* of(int block, int term) const { return wideOf(block, term); }
  int terms() const { return terms_.wide + terms_.narrow; }
  const PanelStep<Real>& step() const { return step_; }

 private:
  Packed* wideOf(int block, int term) const { return &wide_[(static_cast<size_t>(block) * terms_.wide + term) * states_]; }
  Pack* narrowOf(int block, int term) const { return &narrow_[(static_cast<size_t>(block) * terms_.narrow + term) * states_]; }

  PanelGrid grid_;
  int states_;
  TermCount terms_;
  PanelStep<Real> step_;
  Packed* wide_;  // [block][term][state]
  Pack* narrow_;  // the terms after those
};

}  // namespace reachlab::predict
