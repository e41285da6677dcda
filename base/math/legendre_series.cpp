#include "base/math/legendre_series.h"

namespace reachlab {

double valueAt(const LegendreSeries& series, double x) {
  double before = 0, p = 1, sum = 0;
  for (std::size_t n = 0; n < series.size(); ++n) {
    sum += series[n] * p;
    const double m = static_cast<double>(n), next = ((2 * m + 1) * x * p - m * before) / (m + 1);
    before = p, p = next;
  }
  return sum;
}

LegendreSeries integralOf(const LegendreSeries& series) {  // int P_n = (P_(n+1) - P_(n-1)) / (2n+1), int P_0 = P_1 + P_0
  LegendreSeries result(series.size() + 1, 0);
  for (std::size_t n = 0; n < series.size(); ++n) {
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
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::vector<double> p = legendreValues(count, node[i]);
    for (std::size_t n = 0; n < series.size(); ++n) series[n] += (static_cast<double>(n) + 0.5) * weight[i] * values[i] * p[n];
  }
  return series;
}

}  // namespace reachlab
