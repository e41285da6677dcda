// Free motion on random formulas of the whole language: energy is kept and nothing jumps, or the run ends in words. Every second formula is
// of operations that are smooth everywhere, so that enough are proved smooth. REACHLAB_RANDOM_FORMULAS sets how many
// (tests/long/random_formulas.sh: 10,000; REACHLAB_RANDOM_FIRST the first seed).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <random>

#include "base/error.h"
#include "constraints/regularity/places.h"
#include "constraints/regularity/surface_branches.h"
#include "sim/experiment/experiment.h"
#include "tests/dynamics/make_experiment.h"

namespace reachlab::dynamics {
namespace {

constexpr double kKept = 1e-9;            // of the energy, over 2 s
constexpr double kMostStopped = 0.05;     // of those proved smooth
constexpr double kPlaceRounding = 1e-13;  // of a place: some formulas lie 1e6 m away
constexpr double kSpeed = 0.3;            // [m/s]
constexpr int kTicks = 2000;
constexpr double kBox = 1;  // about the start, where a surface is to be proved smooth

class Writer {
 public:
  /// `plain`: of operations that are smooth everywhere alone, but for the arguments that happen to reach an end.
  Writer(std::uint64_t seed, bool surface, bool plain) : random_(seed), surface_(surface), plain_(plain) {}
  double uniform(double lo, double hi) { return lo + (hi - lo) * static_cast<double>(random_() >> 11) * 0x1p-53; }
  std::string coordinate() { return fmt::format("{:.3f}*({})", uniform(0.02, 0.2), sum(3)); }

 private:
  int pick(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
  std::string variable() { return !surface_ ? "phi" : pick(2) == 0 ? "u" : "v"; }
  std::string atom() {
    switch (pick(8)) {
      case 0: return fmt::format("{:.2f}", uniform(0.1, 3));
      case 1: return pick(2) == 0 ? "pi" : "e";
      default: return variable();
    }
  }
  std::string sum(int depth) {
    if (depth == 0) return atom();
    if (plain_) return plainSum(depth);
    static constexpr const char* kFunctions[] = {"sin",  "cos",  "tan", "asin", "acos", "atan", "sinh",
                                                 "cosh", "tanh", "exp", "log",  "sqrt", "abs",  "sign"};
    switch (pick(11)) {
      case 0: return "(" + sum(depth - 1) + " + " + sum(depth - 1) + ")";
      case 1: return "(" + sum(depth - 1) + " - " + sum(depth - 1) + ")";
      case 2: return sum(depth - 1) + "*" + sum(depth - 1);
      case 3: return "(" + sum(depth - 1) + ")/(" + sum(depth - 1) + ")";
      case 4: return "(" + sum(depth - 1) + ")^" + std::to_string(2 + pick(3));
      case 5: return "(" + sum(depth - 1) + ")^" + fmt::format("{:.1f}", uniform(0.3, 3));
      case 6: return "atan2(" + sum(depth - 1) + ", " + sum(depth - 1) + ")";
      case 7: return atom();
      case 8: return std::string(pick(2) == 0 ? "sin(" : "cos(") + sum(depth - 1) + ")";
      default: return std::string(kFunctions[pick(14)]) + "(" + sum(depth - 1) + ")";
    }
  }
  std::string plainSum(int depth) {
    static constexpr const char* kFunctions[] = {"sin", "cos", "sin", "cos", "atan", "tanh", "exp", "sinh", "cosh"};
    const auto sub = [&] { return sum(depth - 1); };
    switch (pick(12)) {
      case 0:
      case 1: return "(" + sub() + " + " + sub() + ")";
      case 2: return "(" + sub() + " - " + sub() + ")";
      case 3: return sub() + "*" + sub();
      case 4: return "(" + sub() + ")/(1.5 + sin(" + sub() + "))";
      case 5: return "(" + sub() + ")/(1 + (" + sub() + ")^2)";
      case 6: return "(" + sub() + ")^" + std::to_string(2 + pick(2));
      case 7: return "sqrt(0.5 + (" + sub() + ")^2)";
      case 8: return "log(2 + cos(" + sub() + "))";
      case 9: return "atan2(" + sub() + ", 1 + (" + sub() + ")^2)";
      default: return std::string(kFunctions[pick(9)]) + "(" + sub() + ")";
    }
  }
  std::mt19937_64 random_;
  bool surface_, plain_;
};

struct Tally {
  int refused = 0, ran = 0, stopped = 0, smooth = 0, smoothStopped = 0;
};

void tryOne(std::uint64_t seed, Tally& tally) {
  const bool surface = seed % 3 == 0;
  Writer writer(seed, surface, seed % 2 == 0);
  experiment::Experiment e = makePoint();
  std::vector<std::string>& lines = surface ? e.constraint.surface : e.constraint.curve;
  e.constraint.name.clear();
  for (int k = 0; k < 3; ++k) lines.push_back(writer.coordinate());
  SCOPED_TRACE(fmt::format("seed {}: {}, {}, {}", seed, lines[0], lines[1], lines[2]));
  std::vector<double> start;
  for (int k = 0; k < (surface ? 2 : 1); ++k) start.push_back(writer.uniform(-1.5, 1.5));
  e = from(e, start, start);
  Scene scene;
  bool smooth = false;
  std::array<constraints::Domain, 2> box;  // where a surface was proved smooth
  std::vector<double> rate;
  try {
    scene = compileScene(e);
    const constraints::Constraint& c = *scene.constraint;
    if (surface) {
      for (std::size_t k = 0; k < 2; ++k) box[k].lo = start[k] - kBox, box[k].hi = start[k] + kBox;
      smooth = constraints::isProvedRegular(c, box);
      const constraints::SurfacePoint p = constraints::evaluate(c.surface, start[0], start[1]);
      const double angle = writer.uniform(0, 6.28);
      const double speed = norm(std::cos(angle) * p.rU + std::sin(angle) * p.rV);
      rate = {kSpeed * std::cos(angle) / speed, kSpeed * std::sin(angle) / speed};
    } else {
      const constraints::CurveRegularity regularity = constraints::computeRegularity(c, start[0]);
      smooth = regularity.smooth && std::isinf(regularity.lo) && std::isinf(regularity.hi);  // narrow places may be pieces of their own
      rate = {kSpeed / norm(constraints::evaluate(c.curve, start[0]).rPhi)};
    }
  } catch (const Error& refusal) {
    EXPECT_STRNE(refusal.what(), "");
    ++tally.refused;
    return;
  }
  if (!std::isfinite(rate[0]) || !std::isfinite(rate.back())) {  // r does not move there
    ++tally.refused;
    return;
  }
  scene.plant->setCoupled(false);
  scene.plant->place(start, rate);
  const double before = scene.plant->energy({});
  ++tally.ran;
  tally.smooth += smooth;
  std::array<MassState, 1> masses;
  scene.plant->observe({}, masses);
  for (int i = 0; i < kTicks; ++i) {
    const StepStatus status = scene.plant->step({}, kTick);
    if (const double drift = std::abs(scene.plant->energy({}) / before - 1); !(drift <= kKept)) {
      ADD_FAILURE() << "energy off by " << drift << " after " << i + 1 << " ms, " << scene.choice.form << ", " << describe(status);
      return;
    }
    const Vec3 last = masses[0].r;
    scene.plant->observe({}, masses);
    if (const double way = norm(masses[0].r - last); !(way <= kSpeed * kTick * (1 + 1e-6) + kPlaceRounding * norm(last))) {
      ADD_FAILURE() << "jumped by " << way << " m after " << i + 1 << " ms, " << scene.choice.form << ", " << describe(status);
      return;
    }
    if (surface) {
      for (std::size_t k = 0; k < 2; ++k) smooth = smooth && masses[0].q[k] >= box[k].lo && masses[0].q[k] <= box[k].hi;
    }
    if (status == StepStatus::Ok) continue;
    EXPECT_FALSE(describe(status).empty());
    ++tally.stopped;
    tally.smoothStopped += smooth;
    return;
  }
}

}  // namespace

// Each once lost energy or jumped without a word: a mass stood on the cut of atan2(u, u), whose value there is no limit (375, 1299, 1521,
// 2517, 3429, 3729, 4173, 6873, 8415, 9165); parameters were not known well enough beside an end or where a unit of them is many metres
// (1269, 1797, 2037, 2166, 3297, 4158, 5067, 9543, 9750, 9915); a jump of 0.1 m was none beside 1e8 m (4397); a
// rounding of phi was a tenth of a millimetre (7409); a chart about a pole was left for a jump, and its numbers were read as u and v (1257);
// phi was known to 1e-14 where a unit of it is many metres, beside the end of an arc or a power (2747, 4543, 5015, 5105).
TEST(RandomFormulas, ThatOnceFailed) {
  Tally tally;
  for (const std::uint64_t seed : {375,  1257, 1269, 1299, 1521, 1797, 2037, 2166, 2517, 2747, 3297, 3429, 3729, 4158,
                                   4173, 4397, 4543, 5015, 5067, 5105, 6873, 7409, 8415, 9165, 9543, 9750, 9915})
    tryOne(seed, tally);
  EXPECT_EQ(tally.refused + tally.ran, 27);
  EXPECT_GT(tally.ran, 24);
}

TEST(RandomFormulas, KeepTheEnergyOfAFreeMassOrStop) {
  const char* asked = std::getenv("REACHLAB_RANDOM_FORMULAS");
  const int count = asked != nullptr ? std::atoi(asked) : 60;
  const char* from = std::getenv("REACHLAB_RANDOM_FIRST");
  const int first = from != nullptr ? std::atoi(from) : 1;
  Tally tally;
  for (int seed = first; seed < first + count; ++seed) tryOne(static_cast<std::uint64_t>(seed), tally);
  std::cout << fmt::format("measured: {} formulas, {} refused, {} ran, {} of them stopped; {} proved smooth, {} of them stopped\n", count,
                           tally.refused, tally.ran, tally.stopped, tally.smooth, tally.smoothStopped);
  EXPECT_GT(tally.ran, count / 2);
  EXPECT_GT(tally.smooth, count / 5);
  EXPECT_LE(tally.smoothStopped, kMostStopped * tally.smooth + 1);
}

}  // namespace reachlab::dynamics
