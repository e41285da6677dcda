#include "sim/predict/panel_series.h"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace reachlab::predict {
namespace {

void scale(Pack& x, double factor) { x *= factor; }
void scale(WidePack& x, const DoubleDouble& factor) {
  WidePack scaled{};
  addProduct(scaled, factor, x);
  settle(scaled);
  x = scaled;
}

void add(Pack& sum, const Pack& x) { sum += x; }
void add(WidePack& sum, const Pack& x) { addWide(sum, x, Pack{}); }

template <class Real>
SparseRows<Real> makeRows(const LineSystem<Real>& system, bool transposed, double halfWidth) {
  SparseRows<Real> rows(system, system.size, transposed);
  rows.scale(Real(halfWidth));
  return rows;
}

SparseRows<double> roundToDouble(const SparseRows<DoubleDouble>& rows) {
  SparseRows<double> rounded{rows.begin, rows.column, {}};
  for (const DoubleDouble& value : rows.value) rounded.value.push_back(value.hi);
  return rounded;
}
const SparseRows<double>& roundToDouble(const SparseRows<double>& rows) { return rows; }

// From x = wide[0 … states-1]: the wide terms, then the narrow ones.
template <class Real>
void expandMixed(const SparseRows<Real>& rows, const SparseRows<double>& rounded, int states, TermCount terms,
                 typename PackOf<Real>::Type* wide, Pack* narrow) {
  expandPanels<Real>(rows, states, terms.wide, wide);
  if (terms.narrow == 0) return;
  const auto* last = wide + static_cast<size_t>(terms.wide - 1) * states;
  std::vector<Pack> rounding(static_cast<size_t>(2) * states);
  for (int i = 0; i < states; ++i) rounding[i] = nearest(last[i]);
  expandPanels<double>(rounded, states, 2, rounding.data());
  std::copy_n(rounding.begin() + states, states, narrow);
  expandPanels<double>(rounded, states, terms.narrow, narrow);
}

// Not set to zero: every place is written before it is read.
template <class Packed>
Packed* allocate(std::pmr::memory_resource& memory, int count) {
  return static_cast<Packed*>(memory.allocate(static_cast<size_t>(count) * sizeof(Packed), alignof(Packed)));
}

template <class Real>
TermCount countTerms(const PanelGrid& grid, double tolerance) {
  const int all = grid.termsAbove(tolerance);
  if (std::is_same_v<Real, double>) return {all, 0};
  const int wide = std::min(all, grid.termsAbove(tolerance / std::numeric_limits<double>::epsilon()));
  return {wide, all - wide};
}

}  // namespace

int PanelGrid::termsAbove(double part) const {
  double size = 1, largest = 1;
  int k = 0;
  while (size > part * largest || k < rate) {
    size *= rate / ++k;
    largest = std::max(largest, size);
  }
  return k + 1;
}

template <class Real>
void expandPanels(const SparseRows<Real>& rows, int states, int terms, typename PackOf<Real>::Type* x, const Real* b,
                  const typename PackOf<Real>::Type* u) {
  using Packed = typename PackOf<Real>::Type;
  for (int k = 0; k + 1 < terms; ++k, x += states) {
    for (int i = 0; i < states; ++i) {
      Packed sum{};
      for (int p = rows.begin[i]; p < rows.begin[i + 1]; ++p) addProduct(sum, rows.value[p], x[rows.column[p]]);
      if (u != nullptr) addProduct(sum, b[i], u[k]);
      settle(sum);
      x[states + i] = sum;
    }
  }
}

template <class Real>
std::vector<Real> inverseFactorials(int count) {
  std::vector<Real> inverse(static_cast<size_t>(count), Real(1.0));
  for (int k = 2; k < count; ++k) inverse[k] = inverse[k - 1] / Real(1.0 * k);
  return inverse;
}

template <class Real>
PanelStep<Real>::PanelStep(const LineSystem<Real>& system, const PanelGrid& grid, TermCount terms)
    : states_(system.size), packs_((system.size + kPack - 1) / kPack), columns_(static_cast<size_t>(states_) * packs_) {
  const SparseRows<Real> transposed = makeRows(system, true, grid.halfWidth);
  const SparseRows<double>& rounded = roundToDouble(transposed);
  const std::vector<Real> weight = inverseFactorials<Real>(terms.wide + terms.narrow);
  std::vector<Packed> wide(static_cast<size_t>(terms.wide) * states_);
  std::vector<Pack> narrow(static_cast<size_t>(terms.narrow) * states_);
  for (int pack = 0; pack < packs_; ++pack) {  // rows of e^{A w} are columns of its transpose
    std::fill_n(wide.begin(), states_, Packed{});
    for (int lane = 0; lane < kPack && pack * kPack + lane < states_; ++lane) setLane(wide[pack * kPack + lane], lane, Real(1.0));
    expandMixed(transposed, rounded, states_, terms, wide.data(), narrow.data());
    for (int i = 0; i < states_; ++i) {
      Pack small{};
      for (int k = terms.narrow - 1; k >= 0; --k)
        addProduct(small, static_cast<double>(weight[terms.wide + k]), narrow[static_cast<size_t>(k) * states_ + i]);
      Packed sum{};
      add(sum, small);
      for (int k = terms.wide - 1; k >= 0; --k) addProduct(sum, weight[k], wide[static_cast<size_t>(k) * states_ + i]);
      settle(sum);
      columns_[static_cast<size_t>(i) * packs_ + pack] = sum;
    }
  }
}

template <class Real>
void PanelStep<Real>::apply(const std::vector<Real>& x, std::vector<Real>& y) const {
  for (int pack = 0; pack < packs_; ++pack) {
    Packed sum{};
    for (int j = 0; j < states_; ++j) addProduct(sum, x[j], columns_[static_cast<size_t>(j) * packs_ + pack]);
    settle(sum);
    for (int lane = 0; lane < kPack && pack * kPack + lane < states_; ++lane) y[pack * kPack + lane] = laneOf(sum, lane);
  }
}

template <class Real>
size_t PanelSeries<Real>::bytesFor(const PanelGrid& grid, int states, double tolerance) {
  const TermCount terms = countTerms<Real>(grid, tolerance);
  const size_t places = static_cast<size_t>(grid.blocks()) * states;
  return places * terms.wide * sizeof(Packed) + places * terms.narrow * sizeof(Pack) + 2 * alignof(Pack);
}

template <class Real>
PanelSeries<Real>::PanelSeries(const LineSystem<Real>& system, const PanelGrid& grid, double tolerance, std::pmr::memory_resource& memory)
    : grid_(grid), states_(system.size), terms_(countTerms<Real>(grid, tolerance)), step_(system, grid, terms_),
      wide_(allocate<Packed>(memory, grid.blocks() * terms_.wide * states_)),
      narrow_(allocate<Pack>(memory, grid.blocks() * terms_.narrow * states_)) {
  const SparseRows<Real> rows = makeRows(system, false, grid.halfWidth);
  const SparseRows<double>& rounded = roundToDouble(rows);
  std::vector<Real> y(system.b), next(y);
  step_.apply(system.b, y);
  for (int block = 0; block < grid_.blocks(); ++block) {
    Packed* first = wideOf(block, 0);
    for (int lane = 0; lane < kPack; ++lane) {
      for (int i = 0; i < states_; ++i) setLane(first[i], lane, y[i]);
      step_.apply(y, next);
      step_.apply(next, y);
    }
    expandMixed(rows, rounded, states_, terms_, first, narrowOf(block, 0));
  }
}

template <class Real>
std::vector<Pack> PanelSeries<Real>::makeControl(const std::vector<Real>& l) const {
  std::vector<Pack> u(static_cast<size_t>(grid_.blocks()) * terms());
  auto to = u.begin();
  for (int block = 0; block < grid_.blocks(); ++block) {
    for (int k = 0; k < terms_.wide; ++k) {
      Packed sum{};
      for (int i = 0; i < states_; ++i) addProduct(sum, l[i], wideOf(block, k)[i]);
      settle(sum);
      *to++ = nearest(sum);
    }
    for (int k = 0; k < terms_.narrow; ++k) {
      Pack sum{};
      for (int i = 0; i < states_; ++i) addProduct(sum, static_cast<double>(l[i]), narrowOf(block, k)[i]);
      *to++ = sum;
    }
  }
  return u;
}

template <class Real>
std::vector<Real> PanelSeries<Real>::integrate(const std::vector<Pack>& u) const {
  const int all = terms();
  const std::vector<Real> factorial = inverseFactorials<Real>(all);
  std::vector<Real> moment(static_cast<size_t>(2 * all), Real(0.0));  // of s^n over a panel
  for (int n = 0; n < 2 * all; n += 2) moment[n] = Real(2 * grid_.halfWidth) / Real(n + 1.0);
  std::vector<Packed> sums(static_cast<size_t>(states_), Packed{});
  std::vector<Pack> small(static_cast<size_t>(states_), Pack{}), taylor(static_cast<size_t>(all));
  for (int block = 0; block < grid_.blocks(); ++block) {
    for (int j = 0; j < all; ++j) taylor[j] = static_cast<double>(factorial[j]) * u[static_cast<size_t>(block) * all + j];
    for (int k = 0; k < all; ++k) {
      Packed weight{};
      for (int j = k % 2; j < all; j += 2) addProduct(weight, moment[k + j], taylor[j]);
      settle(weight);
      scale(weight, factorial[k]);
      if (k < terms_.wide)
        for (int i = 0; i < states_; ++i) addProduct(sums[i], weight, wideOf(block, k)[i]);
      else
        for (int i = 0; i < states_; ++i) addProduct(small[i], nearest(weight), narrowOf(block, k - terms_.wide)[i]);
    }
  }
  std::vector<Real> integral(static_cast<size_t>(states_), Real(0.0));
  for (int i = 0; i < states_; ++i) {
    add(sums[i], small[i]);
    settle(sums[i]);
    for (int lane = 0; lane < kPack; ++lane) integral[i] += laneOf(sums[i], lane);
  }
  return integral;
}

template std::vector<double> inverseFactorials(int);
template void expandPanels(const SparseRows<double>&, int, int, Pack*, const double*, const Pack*);
template class PanelStep<double>;
template class PanelStep<DoubleDouble>;
template class PanelSeries<double>;
template class PanelSeries<DoubleDouble>;

}  // namespace reachlab::predict
