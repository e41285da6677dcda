// Predictions against a second method in 160 digits: the plain Hamiltonian system of the paper's equations in raw coordinates, solved by
// one Taylor series over the whole movement. Nothing is shared with the program but the equations of motion.
#include <gtest/gtest.h>

#include "base/math/matrix.h"  // before Boost, which includes Eigen

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <cmath>
#include <numeric>

#include "sim/predict/predict.h"
#include "tests/predict/objects.h"

namespace reachlab::predict {
namespace {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<160>, boost::multiprecision::et_off>;
using RealRow = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

// Of the hand's and the masses' largest speed (or of the distance); the costs likewise. The table of docs/benchmarks/predictions.md has 1e-9.
constexpr double kOfThePeak = 1e-11;
// Below this the sum of Taylor terms no longer changes: e^(2 |A| T) < 1e75 of cancellation leaves 80 of the 160 digits.
const Real kNegligible("1e-85");

struct Reference {
  int n = 0;
  std::vector<RealRow> a;  // n rows of n + 1 coefficients, the last of u
  RealRow goal;
  std::vector<RealRow> output;  // positions of hand and masses, n + 1 coefficients
  double distance = 0.2, duration = 0;
};

// States x_i, v_i, then the hand as far as it has states of its own, then the force under criterion 5.
Reference makeReference(const experiment::Experiment& e, Criterion criterion, double handMass, double handDamping) {
  const experiment::Object& o = e.object;
  const int N = static_cast<int>(o.masses.size());
  const bool parallel = o.kind == experiment::ObjectKind::Parallel;
  std::vector<Real> k(o.stiffness.begin(), o.stiffness.end()), b(o.damping.begin(), o.damping.end()), m(o.masses.begin(), o.masses.end());
  if (!parallel) k.insert(k.begin(), e.coupling->stiffness), b.insert(b.begin(), e.coupling->damping);
  const Real viscosity = o.viscosity;
  const bool byHand = criterion == Criterion::MinHandJerk || criterion == Criterion::MinHandCrackle;
  const int order = criterion == Criterion::MinHandCrackle ? 5 : 3;
  Real hub = handDamping;
  Real stiffness = 0;
  for (int i = 0; i < (parallel ? N : 1); ++i) hub += b[i], stiffness += k[i];
  const bool slow = !byHand && handMass == 0 && hub > 0;
  const int handStates = byHand ? order : handMass > 0 ? 2 : slow ? 1 : 0;
  const bool forceState = criterion == Criterion::MinHandForceChange;

  Reference r;
  r.n = 2 * N + handStates + (forceState ? 1 : 0);
  r.duration = e.task->duration;
  r.a.assign(r.n, RealRow::Zero(r.n + 1));
  r.goal = RealRow::Zero(r.n);
  const auto state = [&](int i) -> RealRow { return RealRow::Unit(r.n + 1, i); };
  const auto x = [&](int i) { return state(i); };
  const auto v = [&](int i) { return state(N + i); };
  const RealRow control = state(r.n), none = RealRow::Zero(r.n + 1);
  Real total = handMass;
  for (const Real& mass : m) total += mass;

  RealRow h = none, hRate = none, force = none;
  if (handStates > 0) h = state(2 * N);
  if (byHand || handMass > 0) hRate = state(2 * N + 1);
  if (!byHand) {
    force = forceState ? state(r.n - 1) : control;
    if (criterion == Criterion::MinComAcceleration) {
      force = total * control + Real(handDamping) * hRate;
      for (int i = 0; i < N; ++i) force = force + viscosity * v(i);
    }
    if (handMass == 0) {  // F = sum k (h - x) + b (h' - v) + b_hand h'
      RealRow rest = force;
      for (int i = 0; i < (parallel ? N : 1); ++i) rest = rest + k[i] * x(i) + b[i] * v(i);
      if (slow) hRate = (Real(1) / hub) * (rest - stiffness * h);
      else h = (Real(1) / stiffness) * rest;
    }
  }
  std::vector<RealRow> push(N, none);  // on each mass
  RealRow contact = none;              // of the hand on the object
  for (int i = 0; i < N; ++i) {
    const bool toHand = parallel || i == 0;
    const RealRow pull = k[i] * ((toHand ? h : x(i - 1)) - x(i)) + b[i] * ((toHand ? hRate : v(i - 1)) - v(i));
    push[i] = push[i] + pull;
    if (toHand) contact = contact + pull;
    else push[i - 1] = push[i - 1] - pull;
  }
  for (int i = 0; i < N; ++i) {
    r.a[i] = v(i);
    r.a[N + i] = (Real(1) / m[i]) * (push[i] - viscosity * v(i));
    r.goal[i] = r.distance;
  }
  if (byHand) {
    for (int j = 0; j < order; ++j) r.a[2 * N + j] = j + 1 < order ? state(2 * N + j + 1) : control;
  } else if (handMass > 0) {
    r.a[2 * N] = hRate;
    r.a[2 * N + 1] = (Real(1) / Real(handMass)) * (force - contact - Real(handDamping) * hRate);
  } else if (slow) {
    r.a[2 * N] = hRate;
  }
  if (handStates > 0) r.goal[2 * N] = r.distance;
  if (forceState) r.a[r.n - 1] = control;
  r.output = {h};
  for (int i = 0; i < N; ++i) r.output.push_back(x(i));
  return r;
}

// Taylor coefficients of (x, p) from (0, p0): x' = A x + b u, p' = -A^T p, u = b^T p, in units of T.
struct TaylorSeries {
  std::vector<RealRow> x, p;
  std::vector<Real> u;
};

TaylorSeries expand(const Reference& r, const RealRow& p0) {
  struct Entry {
    int row, column;
    Real value;
  };
  std::vector<Entry> entries;
  for (int i = 0; i < r.n; ++i)
    for (int j = 0; j < r.n; ++j)
      if (r.a[i][j] != 0) entries.push_back({i, j, r.a[i][j]});
  TaylorSeries s;
  s.x = {RealRow::Zero(r.n)};
  s.p = {p0};
  Real biggest = 0;
  for (int k = 0;; ++k) {
    Real u = 0;
    for (int i = 0; i < r.n; ++i) u += r.a[i][r.n] * s.p[k][i];
    s.u.push_back(u);
    const Real factor = Real(r.duration) / (k + 1);
    RealRow x(r.n), p = RealRow::Zero(r.n);
    for (int i = 0; i < r.n; ++i) x[i] = r.a[i][r.n] * u;
    for (const Entry& e : entries) {
      x[e.row] += e.value * s.x[k][e.column];
      p[e.column] -= e.value * s.p[k][e.row];
    }
    Real size = 0;
    for (int i = 0; i < r.n; ++i) {
      x[i] *= factor, p[i] *= factor;
      size = std::max({size, Real(abs(x[i])), Real(abs(p[i]))});
    }
    s.x.push_back(x), s.p.push_back(p);
    biggest = std::max(biggest, size);
    if (size < kNegligible * std::min(biggest, Real(1)) && k > 40) break;
  }
  s.u.push_back(Real(0));
  return s;
}

RealRow atEnd(const std::vector<RealRow>& terms) { return std::accumulate(terms.begin() + 1, terms.end(), terms[0]); }

struct ReferenceProfile {
  Reference problem;
  TaylorSeries series;
  double cost = 0;

  // Position and velocity of output o (0 the hand) at s = t/T.
  std::pair<double, double> at(int o, const Real& s) const {
    Real x = 0, rate = 0;
    const RealRow& c = problem.output[o];
    for (size_t k = series.u.size(); k-- > 0;) {
      rate = rate * s + x;
      x = x * s + c[problem.n] * series.u[k] + c.head(problem.n).dot(series.x[k]);
    }
    return {static_cast<double>(x), static_cast<double>(rate / problem.duration)};
  }
};

ReferenceProfile computeReference(const experiment::Experiment& e, Criterion criterion, double handMass, double handDamping) {
  ReferenceProfile profile;
  Reference& r = profile.problem = makeReference(e, criterion, handMass, handDamping);
  RealMatrix reach(r.n, r.n);
  for (int j = 0; j < r.n; ++j) reach.col(j) = atEnd(expand(r, RealRow::Unit(r.n, j)).x);
  profile.series = expand(r, reach.partialPivLu().solve(r.goal));
  profile.cost = static_cast<double>(r.goal.dot(atEnd(profile.series.p)));
  return profile;
}

struct Case {
  std::string name;
  experiment::Experiment experiment;
  Criterion criterion;
  double handMass = 0, handDamping = 0;
};

// Four parallel masses whose modes are all double.
experiment::Experiment manyCriticallyDamped() {
  std::vector<double> masses, springs, dampers;
  for (int i = 0; i < 4; ++i) {
    masses.push_back(0.5);
    springs.push_back(20 + 30 * i);
    dampers.push_back(2 * std::sqrt(masses[i] * springs[i]));
  }
  experiment::Experiment e = makeParallel(masses, springs, 1.35);
  e.object.damping = dampers;
  return e;
}

std::vector<Case> cases() {
  using enum Criterion;
  const experiment::Experiment near = makeParallel({3, 3}, {50, 50.5}, 2.5), three = makeParallel({3, 2, 1}, {50, 250, 100}, 2);
  return {
      {"chain1Jerk", dingwell(), MinHandJerk},
      {"chain5Jerk", chainModerate(), MinHandJerk},
      {"chain5JerkFast", makeChain(5, 0.6, 600, 0.68), MinHandJerk},
      {"chain5JerkSlow", makeChain(5, 0.6, 600, 2.26), MinHandJerk},
      {"chain10Jerk", makeChain(10, 0.3, 600, 1.35), MinHandJerk},
      {"chain20Jerk", makeChain(20, 0.15, 600, 1.35), MinHandJerk},
      {"chain10BelowTravelTime", makeChain(10, 0.3, 60, 1.35), MinHandJerk},
      {"pairJerk", parallelPair(), MinHandJerk},
      {"threeJerk", three, MinHandJerk},
      {"nearJerk", near, MinHandJerk},
      {"nearerJerk", makeParallel({3, 3}, {50, 50.0005}, 2.5), MinHandJerk},
      {"chain5Crackle", chainModerate(), MinHandCrackle},
      {"pairCrackle", parallelPair(), MinHandCrackle},
      {"chain5Force", chainModerate(), MinHandForce},
      {"pairForce", parallelPair(), MinHandForce},
      {"threeForceHand", three, MinHandForce, 1},
      {"chain1ForceChange", dingwell(), MinHandForceChange},
      {"chain5ForceChange", chainModerate(), MinHandForceChange},
      {"chain5ForceChangeHand", chainModerate(), MinHandForceChange, 1},
      {"pairForceChange", parallelPair(), MinHandForceChange},
      {"pairForceChangeHand", parallelPair(), MinHandForceChange, 1},
      {"nearForceChangeHand", near, MinHandForceChange, 1},
      {"chain5Centre", chainModerate(), MinComAcceleration},
      {"threeCentreHand", three, MinComAcceleration, 1},
      {"chain5JerkDamped", damped(chainModerate(), 2, 5), MinHandJerk},
      {"chain5JerkViscous", damped(chainModerate(), 0, 0, 1.5), MinHandJerk},
      {"pairJerkDamped", damped(parallelPair(), 2, 0), MinHandJerk},
      {"criticallyDamped", damped(dingwell(), 0, 2 * std::sqrt(360.0)), MinHandJerk},
      {"chain5ForceDampedHand", damped(chainModerate(), 2, 5), MinHandForce, 1, 5},
      {"chain5ForceChangeDamped", damped(chainModerate(), 2, 0), MinHandForceChange},
      {"chain5ForceChangeDampedHand", damped(chainModerate(), 2, 5), MinHandForceChange, 1, 5},
      {"chain5ForceChangeHandDamping", chainModerate(), MinHandForceChange, 1, 5},
      {"pairForceSlowHand", damped(parallelPair(), 2, 0), MinHandForce},
      {"chain5ForceSlowHand", chainModerate(), MinHandForceChange, 0, 5},
      {"pairCentreDamped", damped(parallelPair(), 2, 0, 0.5), MinComAcceleration, 1, 5},
      {"chain10JerkDamped", damped(makeChain(10, 0.3, 600, 1.35), 2, 2), MinHandJerk},
      {"chain10JerkDampedShort", damped(makeChain(10, 0.3, 600, 0.7), 2, 2), MinHandJerk},
      {"chain10CrackleDamped", damped(makeChain(10, 0.3, 600, 1.35), 1, 5), MinHandCrackle},
      {"chain10ForceDamped", damped(makeChain(10, 0.3, 600, 1.35), 2, 0), MinHandForce},
      {"chain10ForceChangeDampedHand", damped(makeChain(10, 0.3, 600, 1.35), 2, 5), MinHandForceChange, 1, 5},
      {"chain20JerkLightlyDamped", damped(makeChain(20, 0.15, 600, 1.35), 0.5, 0.5), MinHandJerk},
      {"chain20JerkDamped", damped(makeChain(20, 0.15, 600, 1.35), 2, 2), MinHandJerk},
      {"chain20JerkViscous", damped(makeChain(20, 0.15, 600, 1.35), 2, 0, 0.5), MinHandJerk},
      {"chain20CentreDampedHand", damped(makeChain(20, 0.15, 600, 1.35), 2, 2), MinComAcceleration, 1, 5},
      {"chain10SoftDamped", damped(makeChain(10, 0.3, 60, 1.35), 1, 1), MinHandJerk},
      {"chain10SoftShort", damped(makeChain(10, 0.3, 60, 0.9), 0.2, 0.2), MinHandJerk},
      {"chain15StronglyDamped", damped(makeChain(15, 0.2, 600, 1.35), 4, 4), MinHandJerk},
      {"criticallyDampedShort", damped(makeChain(1, 3, 120, 0.2), 0, 2 * std::sqrt(360.0)), MinHandJerk},
      {"manyCriticallyDamped", manyCriticallyDamped(), MinHandJerk},
      {"threeForceChangeDampedHand", damped(three, 3, 0), MinHandForceChange, 1, 5},
      {"nearJerkDamped", damped(near, 0.3, 0), MinHandJerk},
      {"pairForceViscous", damped(parallelPair(), 0, 0, 0.7), MinHandForce},
  };
}

class AgainstReference : public testing::TestWithParam<Case> {};

TEST_P(AgainstReference, ProfilesAndCostAgree) {
  const Case& c = GetParam();
  const auto prediction = predict(c.experiment, c.criterion, {.handMass = c.handMass, .handDamping = c.handDamping});
  const ReferenceProfile reference = computeReference(c.experiment, c.criterion, c.handMass, c.handDamping);
  const int n = prediction->massCount();
  std::vector<double> x(n), v(n);
  double peak = 0, error = 0;
  constexpr int kTimes = 32;
  for (int i = 0; i <= kTimes; ++i) {
    const double t = prediction->duration * i / kTimes;
    const PredictedHand hand = prediction->handAt(t);
    prediction->massesAt(t, x, v);
    for (int o = 0; o <= n; ++o) {
      const auto [position, rate] = reference.at(o, Real(i) / kTimes);
      peak = std::max(peak, std::abs(rate));
      error = std::max(error, std::abs(rate - (o == 0 ? hand.velocity : v[o - 1])));
      // Positions are compared as the speed that would make up for them within the movement.
      error = std::max(error, std::abs(position - (o == 0 ? hand.position : x[o - 1])) / prediction->duration);
    }
  }
  EXPECT_LT(error, kOfThePeak * peak) << c.name << ", condition " << prediction->condition;
  EXPECT_NEAR(prediction->cost / reference.cost, 1, kOfThePeak);
}

INSTANTIATE_TEST_SUITE_P(Cases, AgainstReference, testing::ValuesIn(cases()),
                         [](const testing::TestParamInfo<Case>& parameter) { return parameter.param.name; });

// Criterion 3 by its boundary system: z a polynomial of degree 4N+5 in t/T, 2N+3 conditions at each end; the rest follows by
// differentiating it through the equations of motion.
using Polynomial = RealRow;

Polynomial derivative(const Polynomial& p, const Real& T) {
  Polynomial d = Polynomial::Zero(p.size());
  for (int i = 1; i < p.size(); ++i) d[i - 1] = p[i] * i / T;
  return d;
}

Real polynomialAt(const Polynomial& p, const Real& s) {
  Real value = 0;
  for (Eigen::Index i = p.size(); i-- > 0;) value = value * s + p[i];
  return value;
}

Polynomial solveBoundarySystem(int conditions, const Real& distance) {
  const int unknowns = 2 * conditions;
  RealMatrix matrix = RealMatrix::Zero(unknowns, unknowns);
  for (int order = 0; order < conditions; ++order)
    for (int power = order; power < unknowns; ++power) {
      Real c = 1;
      for (int i = 0; i < order; ++i) c *= power - i;
      if (power == order) matrix(order, power) = c;
      matrix(conditions + order, power) = c;
    }
  return matrix.partialPivLu().solve(distance * RealRow::Unit(unknowns, conditions));
}

TEST(ObjectCrackle, AgreesWithItsBoundarySystem) {
  for (const experiment::Experiment& e :
       {dingwell(), chainModerate(), makeChain(10, 0.3, 600, 1.35), parallelPair(), makeParallel({3, 2, 1}, {50, 250, 100}, 2)}) {
    const auto prediction = predict(e, Criterion::MinCrackle);
    const int n = prediction->massCount();
    const Real T = prediction->duration;
    const auto second = [&](const Polynomial& p) { return derivative(derivative(p, T), T); };
    const Polynomial z = solveBoundarySystem(2 * n + 3, Real(0.2));
    std::vector<Polynomial> node(n + 1, z);  // hand, masses
    if (e.object.kind == experiment::ObjectKind::Parallel) {
      for (int j = 0; j < n; ++j)
        for (int i = 0; i <= n; ++i)
          if (i != j + 1) node[i] = node[i] + Real(e.object.masses[j]) / Real(e.object.stiffness[j]) * second(node[i]);
    } else {
      for (int i = n; i > 0; --i) {
        Polynomial push = Real(e.object.masses[i - 1]) * second(node[i]);
        if (i < n) push = push + Real(e.object.stiffness[i - 1]) * (node[i] - node[i + 1]);
        node[i - 1] = node[i] + Real(1) / Real(i > 1 ? e.object.stiffness[i - 2] : e.coupling->stiffness) * push;
      }
    }
    Polynomial top = z;
    for (int i = 0; i < 2 * n + 3; ++i) top = derivative(top, T);
    Real cost = 0;
    for (int i = 0; i < top.size(); ++i)
      for (int j = 0; j < top.size(); ++j) cost += top[i] * top[j] * T / (i + j + 1);
    EXPECT_NEAR(prediction->cost / static_cast<double>(cost), 1, kOfThePeak);

    std::vector<double> x(n), v(n);
    for (int i = 0; i <= 32; ++i) {
      const double t = prediction->duration * i / 32;
      prediction->massesAt(t, x, v);
      const PredictedHand hand = prediction->handAt(t);
      const double tolerance = kOfThePeak * std::abs(prediction->handPeak);
      const Real s = Real(i) / 32;
      EXPECT_NEAR(hand.velocity, static_cast<double>(polynomialAt(derivative(node[0], T), s)), tolerance);
      EXPECT_NEAR(hand.position, static_cast<double>(polynomialAt(node[0], s)), tolerance);
      for (int m = 0; m < n; ++m) {
        EXPECT_NEAR(v[m], static_cast<double>(polynomialAt(derivative(node[m + 1], T), s)), tolerance);
        EXPECT_NEAR(x[m], static_cast<double>(polynomialAt(node[m + 1], s)), tolerance);
      }
    }
  }
}

}  // namespace
}  // namespace reachlab::predict
