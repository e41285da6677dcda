#include "sim/predict/transcription/rest_to_rest_basis.h"

#include <cmath>

namespace reachlab::predict {

RestToRestBasis::RestToRestBasis(int order, int unknowns) : order_(order) {
  double start = 0.5;  // of P_(order-1), so that the first column ends at 1: each integration hands -1/(2n+1) down to P_(n-1)
  for (int n = order - 1; n > 0; --n) start *= -(2 * n + 1);
  for (int column = 0; column <= unknowns; ++column) {
    const int degree = order - 1 + column;
    std::vector<LegendreSeries> all(order + 1);
    all[order].assign(degree + 1, 0);
    all[order][degree] = column == 0 ? start : std::sqrt(2.0 * degree + 1);
    for (int m = order; m > 0; --m) all[m - 1] = integralOf(all[m]);
    series_.push_back(std::move(all));
  }
}

void RestToRestBasis::tabulate(double x, double rate, double* table) const {
  const std::vector<double> values = legendreValues(columns() + 2 * order_, x);
  for (int column = 0; column < columns(); ++column) {
    double factor = 1;
    for (int m = 0; m <= order_; ++m, factor *= rate) {
      const LegendreSeries& series = derivative(column, m);
      double sum = 0;
      for (size_t n = firstTerm(column, m); n < series.size(); ++n) sum += series[n] * values[n];
      *table++ = factor * sum;
    }
  }
}

LegendreSeries RestToRestBasis::combine(const std::vector<double>& coefficient, int m) const {
  LegendreSeries sum(series_.back()[m].size(), 0);
  for (size_t c = 0; c < coefficient.size(); ++c) {
    const LegendreSeries& column = series_[c][m];
    for (size_t n = firstTerm(static_cast<int>(c), m); n < column.size(); ++n) sum[n] += coefficient[c] * column[n];
  }
  return sum;
}

}  // namespace reachlab::predict
