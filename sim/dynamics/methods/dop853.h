#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/math/elementary.h"
#include "sim/dynamics/object/numbers.h"

namespace reachlab::dynamics {

/// Dormand and Prince's pair of order 8 with error estimators of order 5 and 3, sub-stepping inside a tick. Source: Hairer, Norsett,
/// Wanner: Solving Ordinary Differential Equations I, 2nd ed., II.5 and II.10.
namespace dop853 {
inline constexpr int kStages = 12;
inline constexpr double kC[kStages] = {0,
                                       0.05260015195876773,
                                       0.0789002279381516,
                                       0.1183503419072274,
                                       0.2816496580927726,
                                       0.3333333333333333,
                                       0.25,
                                       0.3076923076923077,
                                       0.6512820512820513,
                                       0.6,
                                       0.8571428571428571,
                                       1.0};
inline constexpr double kA[kStages][kStages - 1] = {
    {},
    {0.05260015195876773},
    {0.0197250569845379, 0.0591751709536137},
    {0.02958758547680685, 0.0, 0.08876275643042054},
    {0.2413651341592667, 0.0, -0.8845494793282861, 0.924834003261792},
    {0.037037037037037035, 0.0, 0.0, 0.17082860872947386, 0.12546768756682242},
    {0.037109375, 0.0, 0.0, 0.17025221101954405, 0.06021653898045596, -0.017578125},
    {0.03709200011850479, 0.0, 0.0, 0.17038392571223998, 0.10726203044637328, -0.015319437748624402, 0.008273789163814023},
    {0.6241109587160757, 0.0, 0.0, -3.3608926294469414, -0.868219346841726, 27.59209969944671, 20.154067550477894, -43.48988418106996},
    {0.47766253643826434, 0.0, 0.0, -2.4881146199716677, -0.590290826836843, 21.230051448181193, 15.279233632882423, -33.28821096898486,
     -0.020331201708508627},
    {-0.9371424300859873, 0.0, 0.0, 5.186372428844064, 1.0914373489967295, -8.149787010746927, -18.52006565999696, 22.739487099350505,
     2.4936055526796523, -3.0467644718982196},
    {2.273310147516538, 0.0, 0.0, -10.53449546673725, -2.0008720582248625, -17.9589318631188, 27.94888452941996, -2.8589982771350235,
     -8.87285693353063, 12.360567175794303, 0.6433927460157636}};
inline constexpr double kB[kStages] = {0.054293734116568765,
                                       0,
                                       0,
                                       0,
                                       0,
                                       4.450312892752409,
                                       1.8915178993145003,
                                       -5.801203960010585,
                                       0.3111643669578199,
                                       -0.1521609496625161,
                                       0.20136540080403034,
                                       0.04471061572777259};
inline constexpr double kError3[kStages] = {-0.18980075407240762,
                                            0,
                                            0,
                                            0,
                                            0,
                                            4.450312892752409,
                                            1.8915178993145003,
                                            -5.801203960010585,
                                            -0.4226823213237919,
                                            -0.1521609496625161,
                                            0.20136540080403034,
                                            0.02265179219836082};
inline constexpr double kError5[kStages] = {0.01312004499419488,
                                            0,
                                            0,
                                            0,
                                            0,
                                            -1.2251564463762044,
                                            -0.4957589496572502,
                                            1.6643771824549864,
                                            -0.35032884874997366,
                                            0.3341791187130175,
                                            0.08192320648511571,
                                            -0.022355307863886294};

template <int S, int Count>
using Many = std::array<Numbers<S>, Count>;
template <int S, std::size_t... I>
auto makeMany(int n, std::index_sequence<I...>) noexcept {
  return Many<S, sizeof...(I)>{((void)I, Numbers<S>(n))...};
}
/// Room for `Count` vectors of n numbers.
template <int S, int Count>
Many<S, Count> makeMany(int n) noexcept {
  return makeMany<S>(n, std::make_index_sequence<Count>());
}
template <int S>
using Stages = Many<S, kStages>;
template <int S>
Stages<S> makeStages(int n) noexcept {
  return makeMany<S, kStages>(n);
}

/// One trial of h from y at t. k[0] holds the rate there. Returns the estimated error over `unit(i, y_i)`, where 1 is the most allowed. The
/// error is infinite when the result is not finite. Costs eleven right-hand sides.
template <int S, class Rate, class Unit>
double attempt(const Rate& rate, const Unit& unit, double t, double h, const Numbers<S>& y, Stages<S>& k, Numbers<S>& next) noexcept {
  const int n = y.size();
  Numbers<S> at(n);
  for (int stage = 1; stage < kStages; ++stage) {
    for (int i = 0; i < n; ++i) {
      double sum = 0;
      for (int j = 0; j < stage; ++j) sum += kA[stage][j] * k[j][i];
      at[i] = y[i] + h * sum;
    }
    rate(t + kC[stage] * h, at, k[stage]);
  }
  double fifth = 0, third = 0;
  for (int i = 0; i < n; ++i) {
    double sum = 0, e3 = 0, e5 = 0;
    for (int j = 0; j < kStages; ++j) {
      sum += kB[j] * k[j][i];
      e3 += kError3[j] * k[j][i];
      e5 += kError5[j] * k[j][i];
    }
    next[i] = y[i] + h * sum;
    const double size = unit(i, y[i]);
    fifth += e5 / size * (e5 / size) + next[i] * 0.0;
    third += e3 / size * (e3 / size);
  }
  if (fifth == 0) return 0;
  const double error = h * fifth / std::sqrt((fifth + 0.01 * third) * n);
  return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

/// The ratio of the next step's size to this one's, for an estimated error of order 8.
inline double growth(double error, double most) noexcept {
  if (!std::isfinite(error)) return 0.1;
  return std::clamp(0.9 * elementary::pow(std::max(error, 1e-12), -0.125), 0.2, most);
}
}  // namespace dop853

}  // namespace reachlab::dynamics
