#include "sim/predict/legendre.h"

#include <cmath>

namespace reachlab::predict {

double evaluate(const LegendreSeries& series, double x) {
  double before = 0, p = 1, sum = 0;
  for (size_t n = 0; n < series.size(); ++n) {
    sum += series[n] * p;
    const double m = static_cast<double>(n), next = ((2 * m + 1) * x * p - m * before) / (m + 1);
    before = p, p = next;
  }
  return sum;
}

LegendreSeries integrate(const LegendreSeries& series) {  // int P_n = (P_(n+1) - P_(n-1)) / (2n+1), int P_0 = P_1 + P_0
  LegendreSeries result(series.size() + 1, 0);
  for (size_t n = 0; n < series.size(); ++n) {
    const double part = series[n] / (2 * static_cast<double>(n) + 1);
    result[n + 1] += part;
    if (n > 0) result[n - 1] -= part;
    else result[0] += part;
  }
  return result;
}

std::vector<double> legendreValues(int count, double x) {
  std::vector<double> values;
  double before = 0, p = 1;
  for (int n = 0; n < count; ++n) {
    values.push_back(p);
    const double next = ((2 * n + 1) * x * p - n * before) / (n + 1);
    before = p, p = next;
  }
  return values;
}

LegendreSeries projectOnLegendre(const std::vector<double>& values, const std::vector<double>& node, const std::vector<double>& weight) {
  const auto count = static_cast<int>(node.size());
  LegendreSeries series(node.size(), 0);
  for (size_t i = 0; i < node.size(); ++i) {
    const std::vector<double> p = legendreValues(count, node[i]);
    for (size_t n = 0; n < series.size(); ++n) series[n] += (static_cast<double>(n) + 0.5) * weight[i] * values[i] * p[n];
  }
  return series;
}

RestToRestBasis::RestToRestBasis(int order, int unknowns) : order_(order) {
  double start = 0.5;  // of P_(order-1), so that the first column ends at 1: each integration hands -1/(2n+1) down to P_(n-1)
  for (int n = order - 1; n > 0; --n) start *= -(2 * n + 1);
  for (int column = 0; column <= unknowns; ++column) {
    const int degree = order - 1 + column;
    std::vector<LegendreSeries> all(order + 1);
    all[order].assign(degree + 1, 0);
    all[order][degree] = column == 0 ? start : std::sqrt(2.0 * degree + 1);
    for (int m = order; m > 0; --m) all[m - 1] = integrate(all[m]);
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
  LegendreSeries sum(series_.back()[static_cast<size_t>(m)].size(), 0);
  for (size_t c = 0; c < coefficient.size(); ++c) {
    const LegendreSeries& column = series_[c][static_cast<size_t>(m)];
    for (size_t n = firstTerm(static_cast<int>(c), m); n < column.size(); ++n) sum[n] += coefficient[c] * column[n];
  }
  return sum;
}

}  // namespace reachlab::predict
