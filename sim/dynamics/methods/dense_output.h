#pragma once
#include "sim/dynamics/methods/dop853.h"

namespace reachlab::dynamics::dop853 {

/// The state within an accepted step, of order 7 (Hairer, Norsett, Wanner I, II.6: continuous extension of the pair of order 8).
template <int S>
struct DenseOutput {
  static constexpr int kTerms = 7;
  Numbers<S> start;
  Many<S, kTerms> terms;

  /// At `share` of the step, 0 to 1.
  void at(double share, Numbers<S>& y) const noexcept {
    for (int i = 0; i < start.size(); ++i) {
      double sum = 0;
      for (int j = kTerms - 1; j >= 0; --j) sum = (sum + terms[j][i]) * (j % 2 == 0 ? share : 1 - share);
      y[i] = start[i] + sum;
    }
  }
};

/// From the stages of an accepted step of h from y at t to `next`. Costs four right-hand sides.
template <int S, class Rate>
DenseOutput<S> makeDenseOutput(const Rate& rate, double t, double h, const Numbers<S>& y, const Stages<S>& k,
                               const Numbers<S>& next) noexcept {
  constexpr int kMore = 4, kAll = kStages + kMore;  // the slope at the end, and three stages
  constexpr double kPlace[kMore] = {1.0, 0.1, 0.2, 0.7777777777777778};
  constexpr double kWeight[kMore][kAll] = {
      {},
      {0.056167502283047954, 0, 0, 0, 0, 0, 0.25350021021662483, -0.2462390374708025, -0.12419142326381637, 0.15329179827876568,
       0.00820105229563469, 0.007567897660545699, -0.008298},
      {0.03183464816350214, 0, 0, 0, 0, 0.028300909672366776, 0.053541988307438566, -0.05492374857139099, 0, 0, -0.00010834732869724932,
       0.0003825710908356584, -0.00034046500868740456, 0.1413124436746325},
      {-0.42889630158379194, 0, 0, 0, 0, -4.697621415361164, 7.683421196062599, 4.06898981839711, 0.3567271874552811, 0, 0, 0,
       -0.0013990241651590145, 2.9475147891527724, -9.15095847217987}};
  constexpr double kTerm[4][kAll] = {
      {-8.428938276109013, 0, 0, 0, 0, 0.5667149535193777, -3.0689499459498917, 2.38466765651207, 2.117034582445028, -0.871391583777973,
       2.2404374302607883, 0.6315787787694688, -0.08899033645133331, 18.148505520854727, -9.194632392478356, -4.436036387594894},
      {10.427508642579134, 0, 0, 0, 0, 242.28349177525817, 165.20045171727028, -374.5467547226902, -22.113666853125306, 7.733432668472264,
       -30.674084731089398, -9.332130526430229, 15.697238121770845, -31.139403219565178, -9.35292435884448, 35.81684148639408},
      {19.985053242002433, 0, 0, 0, 0, -387.0373087493518, -189.17813819516758, 527.8081592054236, -11.57390253995963, 6.8812326946963,
       -1.0006050966910838, 0.7777137798053443, -2.778205752353508, -60.19669523126412, 84.32040550667716, 11.99229113618279},
      {-25.69393346270375, 0, 0, 0, 0, -154.18974869023643, -231.5293791760455, 357.6391179106141, 93.40532418362432, -37.45832313645163,
       104.0996495089623, 29.8402934266605, -43.53345659001114, 96.32455395918828, -39.17726167561544, -149.72683625798564}};

  const int n = y.size();
  auto more = makeMany<S, kMore>(n);
  const auto slope = [&](int j) -> const Numbers<S>& { return j < kStages ? k[j] : more[j - kStages]; };
  Numbers<S> at = next;
  for (int stage = 0; stage < kMore; ++stage) {
    for (int i = 0; i < n && stage > 0; ++i) {
      double sum = 0;
      for (int j = 0; j < kStages + stage; ++j) sum += kWeight[stage][j] * slope(j)[i];
      at[i] = y[i] + h * sum;
    }
    rate(t + kPlace[stage] * h, at, more[stage]);
  }
  DenseOutput<S> dense{y, makeMany<S, DenseOutput<S>::kTerms>(n)};
  for (int i = 0; i < n; ++i) {
    const double change = next[i] - y[i];
    dense.terms[0][i] = change;
    dense.terms[1][i] = h * k[0][i] - change;
    dense.terms[2][i] = 2 * change - h * (more[0][i] + k[0][i]);
    for (int term = 0; term < 4; ++term) {
      double sum = 0;
      for (int j = 0; j < kAll; ++j) sum += kTerm[term][j] * slope(j)[i];
      dense.terms[3 + term][i] = h * sum;
    }
  }
  return dense;
}

}  // namespace reachlab::dynamics::dop853
