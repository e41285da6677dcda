#include "sim/predict/sweep/parameter_sweep.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>
#include <tuple>

#include "base/fault.h"
#include "tests/predict/objects.h"
#include "tests/refusal.h"

namespace reachlab::predict {
namespace {

TEST(Shape, CountsTheRisesThatAreFollowedByAFall) {
  const auto wave = [](double t) { return std::sin(std::numbers::pi * t) * (1 + 0.5 * std::sin(6 * std::numbers::pi * t)); };
  EXPECT_EQ(computeShape(MadePrediction(1, [](double t) { return std::sin(std::numbers::pi * t); })).velocityPeaks, 1);
  EXPECT_EQ(computeShape(MadePrediction(1, wave)).velocityPeaks, 3);
  EXPECT_FALSE(computeShape(MadePrediction(1, wave)).reverses);
  EXPECT_EQ(computeShape(MadePrediction(2, [](double t) { return 1 - t / 2; })).velocityPeaks, 0) << "it only falls";
  EXPECT_EQ(computeShape(MadePrediction(2, [](double t) { return t / 2; })).velocityPeaks, 0) << "the end is no turn";
  EXPECT_EQ(computeShape(MadePrediction(2, [](double t) { return 0.3 + std::cos(2 * std::numbers::pi * t); })).velocityPeaks, 1)
      << "the one inside";
}

TEST(Shape, RipplesBelowABillionthOfThePeakDoNotCount) {
  for (const double ripple : {0.4e-9, 2e-9}) {
    const auto flat = [=](double t) { return 0.5 + ripple * std::sin(10 * std::numbers::pi * t); };
    EXPECT_EQ(computeShape(MadePrediction(1, flat)).velocityPeaks, ripple < 1e-9 ? 0 : 5) << ripple;
    EXPECT_EQ(computeShape(MadePrediction(1, [=](double t) { return std::sin(std::numbers::pi * t) - 0.6 * ripple; })).reverses,
              ripple > 1e-9);
  }
}

TEST(Shape, AHandThatBeginsOrEndsBackwardsReverses) {
  EXPECT_TRUE(computeShape(MadePrediction(1, [](double t) { return t - 0.001; })).reverses) << "at its first instant alone";
  EXPECT_TRUE(computeShape(MadePrediction(1, [](double t) { return 0.999 - t; })).reverses) << "at its last";
  EXPECT_FALSE(computeShape(MadePrediction(1, [](double t) { return t * (1 - t); })).reverses);
}

// Waves of 40 Hz within two seconds: 80 of them, one maximum each.
TEST(Shape, SeesEveryWaveOfTheFastestFrequency) {
  const double fastest = 2 * std::numbers::pi * 40;
  EXPECT_EQ(computeShape(MadePrediction(
                             2, [=](double t) { return 1 - std::cos(fastest * t); }, fastest))
                .velocityPeaks,
            80);
}

TEST(Sweep, HasBothEndsWhereTheStepsMeetThem) {
  EXPECT_EQ((Sweep{"n", 1, 3, 1}.values()), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ((Sweep{"n", 2, 2, 0.5}.values()), std::vector<double>{2});
  EXPECT_EQ((Sweep{"n", 1, 2.4, 1}.values()), (std::vector<double>{1, 2}));
  EXPECT_EQ((Sweep{"n", 1, 2.6, 1}.values()), (std::vector<double>{1, 2})) << "never beyond";
  const auto tenths = Sweep{"duration_s", 0.5, 1.5, 0.1}.values();
  ASSERT_EQ(tenths.size(), 11u);
  for (std::size_t i = 0; i < 11; ++i) EXPECT_DOUBLE_EQ(tenths[i], 0.5 + 0.1 * static_cast<double>(i));
}

TEST(Sweep, IsReadFromKeyFromToAndStep) {
  const Sweep sweep = parseSweep("duration_s=0.5:2e0:0.25");
  EXPECT_EQ(sweep.key, "duration_s");
  EXPECT_EQ(sweep.from, 0.5);
  EXPECT_EQ(sweep.to, 2);
  EXPECT_EQ(sweep.step, 0.25);
  EXPECT_EQ(parseSweep("hand_mass_kg=0:0:1").values(), std::vector<double>{0});
}

TEST(Sweep, SaysWhatIsWrongWithOneThatCannotBeRead) {
  for (const char* broken : {"n", "n=1", "n=1:2", "1:2:3", ""})
    EXPECT_TRUE(holds(refusalOf([&] { parseSweep(broken); }), "KEY=FROM:TO:STEP")) << broken;
  EXPECT_TRUE(holds(refusalOf([] { parseSweep("colour=1:2:1"); }), "'colour', which is no key"));
  EXPECT_TRUE(holds(refusalOf([] { parseSweep("colour=1:2:1"); }), "hand_mass_kg, hand_damping_n_s_per_m"));
  for (const auto& [text, number] :
       {std::pair{"n=x:2:1", "'x'"}, {"n=1:2y:1", "'2y'"}, {"n=1:2:", "''"}, {"n=1:inf:1", "'inf'"}, {"n=1:2:1:1", "'1:1'"}})
    EXPECT_TRUE(holds(refusalOf([text = text] { parseSweep(text); }), std::string("where ") + number + " is no number")) << text;
  for (const char* way : {"n=1:2:0", "n=1:2:-1", "n=2:1:1", "n=1:100002:1"})
    EXPECT_TRUE(holds(refusalOf([&] { parseSweep(way); }), "FROM <= TO, STEP > 0, at most 100000 values")) << way;
  EXPECT_NO_THROW(parseSweep("n=1:100001:1"));
}

// A chain of three whose numbers all differ, so that what is changed and what is not can be told.
experiment::Experiment chainToSweep() {
  experiment::Experiment e = makeChain(3, 1, 100, 1.5);
  e.object.masses = {0.5, 1, 2.5};
  e.object.stiffness = {100, 300};
  e.object.damping = {2, 5};
  e.coupling = experiment::Coupling{700, 9};
  return e;
}

struct Applied {
  experiment::Experiment experiment = chainToSweep();
  PredictOptions options;
};
Applied applied(const std::string& key, double value, Applied to = {}) {
  applySweepValue(key, value, to.experiment, to.options);
  return to;
}

TEST(SweepKeys, EachChangesWhatItNames) {
  using Numbers = std::vector<double>;
  const Applied all = applied("stiffness_n_per_m", 42), object = applied("object.stiffness_n_per_m", 42),
                coupling = applied("coupling.stiffness_n_per_m", 42);
  EXPECT_EQ(all.experiment.object.stiffness, (Numbers{42, 42}));
  EXPECT_EQ(all.experiment.coupling->stiffness, 42);
  EXPECT_EQ(object.experiment.object.stiffness, (Numbers{42, 42}));
  EXPECT_EQ(object.experiment.coupling->stiffness, 700);
  EXPECT_EQ(coupling.experiment.object.stiffness, (Numbers{100, 300}));
  EXPECT_EQ(coupling.experiment.coupling->stiffness, 42);
  const Applied dampers = applied("damping_n_s_per_m", 4);
  EXPECT_EQ(dampers.experiment.object.damping, (Numbers{4, 4}));
  EXPECT_EQ(dampers.experiment.coupling->damping, 4);
  EXPECT_EQ(dampers.experiment.object.viscosity, 0);
  EXPECT_EQ(applied("viscosity_n_s_per_m", 4).experiment.object.viscosity, 4);
  EXPECT_EQ(applied("mass_kg", 7).experiment.object.masses, (Numbers{7, 7, 7}));
  EXPECT_EQ(applied("total_mass_kg", 8).experiment.object.masses, (Numbers{1, 2, 5}));
  EXPECT_EQ(applied("duration_s", 3).options.duration, 3);
  EXPECT_EQ(applied("duration_s", 3).options.handMass, std::nullopt);
  EXPECT_EQ(applied("hand_mass_kg", 3).options.handMass, 3);
  EXPECT_EQ(applied("hand_damping_n_s_per_m", 3).options.handDamping, 3);
  EXPECT_EQ(applied("hand_damping_n_s_per_m", 3).options.handMass, std::nullopt);
}

TEST(SweepKeys, TheNumberOfMassesKeepsTheirSumOrTheFirst) {
  using Numbers = std::vector<double>;
  const Applied shared = applied("n", 5), each = applied("n_each", 5), one = applied("n", 1);
  EXPECT_EQ(shared.experiment.object.masses, Numbers(5, 0.8));
  EXPECT_EQ(each.experiment.object.masses, Numbers(5, 0.5));
  for (const Applied& a : {shared, each}) {
    EXPECT_EQ(a.experiment.object.stiffness, Numbers(4, 100));
    EXPECT_EQ(a.experiment.object.damping, Numbers(4, 2));
    EXPECT_EQ(a.experiment.object.kind, experiment::ObjectKind::Chain);
    EXPECT_EQ(a.experiment.coupling->stiffness, 700);
  }
  EXPECT_EQ(one.experiment.object.masses, Numbers{4});
  EXPECT_TRUE(one.experiment.object.stiffness.empty());
  EXPECT_EQ(one.experiment.object.kind, experiment::ObjectKind::Point);
  const Applied again = applied("n_each", 3, one);  // of a point, whose one spring is the coupling
  EXPECT_EQ(again.experiment.object.kind, experiment::ObjectKind::Chain);
  EXPECT_EQ(again.experiment.object.stiffness, Numbers(2, 700));
  EXPECT_EQ(again.experiment.object.damping, Numbers(2, 0));
  EXPECT_EQ(again.experiment.object.masses, Numbers(3, 4));
  Applied parallel;
  parallel.experiment = parallelPair();
  EXPECT_EQ(applied("n", 4, parallel).experiment.object.stiffness, Numbers(4, 50));
  EXPECT_EQ(applied("n", 1, parallel).experiment.object.stiffness, Numbers(1, 50));
  EXPECT_EQ(applied("n", 1, parallel).experiment.object.kind, experiment::ObjectKind::Parallel);
  EXPECT_EQ(applied("n", 512).experiment.object.masses.size(), 512u);
  for (const double n : {0.5, 1.5, 513.0})
    EXPECT_TRUE(holds(refusalOf([=] { applied("n", n); }), "whole numbers of masses from 1 to 512")) << n;
}

TEST(SweepKeys, TakeValuesThatMakeSenseAlone) {
  for (const SweepKey& key : sweepKeys()) {
    const std::string name(key.name);
    const bool zero =
        name == "damping_n_s_per_m" || name == "viscosity_n_s_per_m" || name == "hand_mass_kg" || name == "hand_damping_n_s_per_m";
    EXPECT_EQ(refusalOf([&] { applied(name, 0); }).find("above 0") == std::string::npos, zero) << name;
    EXPECT_TRUE(holds(refusalOf([&] { applied(name, -1); }), "above 0")) << name;
    EXPECT_NE(refusalOf([&] { applied(name, std::nan("")); }), "") << name;
    EXPECT_EQ(refusalOf([&] { applied(name, 2); }), "") << name;
    EXPECT_FALSE(key.meaning.empty());
  }
  EXPECT_EQ(sweepKeys().size(), 12u);
  EXPECT_EQ(refusalOf([] { applied("duration_s", 3600); }), "");
  EXPECT_TRUE(holds(refusalOf([] { applied("duration_s", 3601); }), "0.001 to 3600 s"));
  for (const auto& [key, value, allowed] : {std::tuple{"mass_kg", 1e7, "1e-06 to 1e+06 kg"},
                                            {"coupling.stiffness_n_per_m", 1e10, "0 to 1e+09 N/m"},
                                            {"viscosity_n_s_per_m", 1e10, "0 to 1e+09 N s/m"}})
    EXPECT_TRUE(holds(refusalOf([&, key = key, value = value] { applied(key, value); }), allowed)) << key;
  EXPECT_TRUE(holds(refusalOf([] { applied("colour", 1); }), "'colour', which is no key"));
  Applied parallel;
  parallel.experiment = parallelPair();
  EXPECT_TRUE(holds(refusalOf([&] { applied("coupling.stiffness_n_per_m", 1, parallel); }), "has no coupling"));
  EXPECT_EQ(applied("stiffness_n_per_m", 9, parallel).experiment.object.stiffness, (std::vector<double>{9, 9}));
  EXPECT_EQ(applied("damping_n_s_per_m", 9, parallel).experiment.object.damping, (std::vector<double>{9, 9}));
  Applied bare;
  bare.experiment.object.stiffness.clear(), bare.experiment.object.masses.clear();
  EXPECT_TRUE(holds(refusalOf([&] { applied("object.stiffness_n_per_m", 1, bare); }), "no springs of its own"));
  EXPECT_EQ(refusalOf([&] { applied("stiffness_n_per_m", 1, bare); }), "") << "there is the coupling";
  EXPECT_TRUE(holds(refusalOf([&] { applied("mass_kg", 1, bare); }), "no masses"));
}

TEST(Sweep, HasARowForEachValueInOrderWithItsPredictionOrItsRefusal) {
  std::atomic<int> calls{0};
  std::vector<int> done;
  const auto rows = computeSweep(experiment::CompiledExperiment(makeChain(10, 0.3, 60, 1.35)), Criterion::MinHandJerk, {},
                                 {"duration_s", 0.25, 2.25, 1}, [&](int count, int total) {
                                   ++calls;
                                   done.push_back(count);
                                   EXPECT_EQ(total, 3);
                                 });
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(calls, 3);
  EXPECT_EQ(done, (std::vector<int>{1, 2, 3}));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(rows[i].value, 0.25 + static_cast<double>(i));
  EXPECT_EQ(rows[0].prediction, nullptr);
  EXPECT_TRUE(holds(rows[0].refusal, "allow more time"));
  for (const std::size_t i : {1, 2}) {
    ASSERT_NE(rows[i].prediction, nullptr);
    EXPECT_EQ(rows[i].prediction->duration, rows[i].value);
    EXPECT_EQ(rows[i].refusal, "");
    EXPECT_EQ(rows[i].shape.velocityPeaks, computeShape(*rows[i].prediction).velocityPeaks);
    EXPECT_EQ(rows[i].shape.reverses, computeShape(*rows[i].prediction).reverses);
    EXPECT_EQ(rows[i].prediction->cost, predict(makeChain(10, 0.3, 60, 1.35), Criterion::MinHandJerk, {.duration = rows[i].value})->cost);
  }
}

TEST(Sweep, AFaultOfAValueIsTheWholeSweeps) {
  const experiment::CompiledExperiment compiled(dingwell());
  EXPECT_TRUE(holds(refusalOf([&] { computeSweep(compiled, Criterion::MinHandJerk, {}, {"mass_kg", -1, 1, 1}); }), "above 0"));
  EXPECT_EQ(computeSweep(compiled, Criterion::MinHandJerk, {}, {"mass_kg", 1, 3, 1}).size(), 3u) << "nobody asks how far it is";
}

}  // namespace
}  // namespace reachlab::predict
