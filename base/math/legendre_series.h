#pragma once
#include <vector>

namespace reachlab {

/// sum_n c[n] P_n(x), x in [-1, 1].
using LegendreSeries = std::vector<double>;

double valueAt(const LegendreSeries& series, double x);
/// The integral from -1.
LegendreSeries integralOf(const LegendreSeries& series);
/// P_0(x) … P_(count-1)(x).
std::vector<double> legendreValues(int count, double x);
/// The polynomial of degree values.size() - 1 through values at the nodes of the Gauss rule of as many points.
LegendreSeries projectOnLegendre(const std::vector<double>& values, const std::vector<double>& node, const std::vector<double>& weight);

}  // namespace reachlab
