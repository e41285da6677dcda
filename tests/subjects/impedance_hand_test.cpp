// The way of a reach, and the hand that is pulled along it, each against its law written out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/fault.h"
#include "sim/subjects/feedback_hand.h"
#include "sim/subjects/impedance_subject.h"
#include "sim/subjects/subject_parameters.h"
#include "tests/subjects/conducted.h"
#include "tests/subjects/short_reach.h"

namespace reachlab::subjects {
namespace {

TEST(ReachWay, OfAChordIsMetresAlongIt) {
  const ReachWay way{experiment::CompiledExperiment(shortReach())};
  const Vec3 start{-0.05, 0.02, 0.01}, along = Vec3{0.12, 0.09, -0.04} / way.length();
  for (const double s : {-0.3, 0.0, 0.07, 0.5}) {
    EXPECT_LT(norm(way.at(s).position - (start + s * along)), 1e-15);
    EXPECT_LT(norm(way.at(s).along - along), 1e-15);
    dynamics::MassState mass;
    mass.r = start + s * along + 0.2 * cross(along, {1, 0, 0});
    EXPECT_NEAR(way.placeOf(mass), s, 1e-15) << "beside it counts as much";
  }
}

// A circle: arc length is radius times angle, both ways round, and beyond the ends as well.
TEST(ReachWay, OfACurveIsItsArc) {
  constexpr double kRadius = 0.15;
  for (const double to : {1.7, -0.9}) {
    experiment::Experiment e = experiment::readExperiment("ellipse");
    e.constraint = {.name = {}, .curve = {"R*cos(phi)", "R*sin(phi)", "0"}, .surface = {}, .shape = {{"R", kRadius}}};
    e.task->start = {0.4};
    e.task->target = {to};
    const ReachWay way{experiment::CompiledExperiment(e)};
    const double sense = to > 0.4 ? 1 : -1;
    EXPECT_NEAR(way.length(), kRadius * std::abs(to - 0.4), 1e-12);
    for (const double s : {-0.05, 0.0, 0.0333, 0.1, way.length(), way.length() + 0.04}) {
      const double phi = 0.4 + sense * s / kRadius;
      EXPECT_LT(norm(way.at(s).position - kRadius * Vec3{std::cos(phi), std::sin(phi), 0}), 1e-9) << s;
      EXPECT_LT(norm(way.at(s).along - sense * Vec3{-std::sin(phi), std::cos(phi), 0}), 1e-8) << s;
      dynamics::MassState mass;
      mass.q[0] = phi;
      EXPECT_NEAR(way.placeOf(mass), s, 1e-9) << s;
    }
  }
}

// Where the pace along the curve changes, the table and the arc say the same.
TEST(ReachWay, PlacesOnACurveAreEachOthersInverse) {
  for (const auto& [from, to] : {std::pair{0.2, 2.6}, {2.6, 0.2}}) {
    experiment::Experiment e = experiment::readExperiment("ellipse");
    e.constraint = {.name = {}, .curve = {"0.3*cos(phi)", "0.1*sin(phi)", "0.02*phi"}, .surface = {}, .shape = {}};
    e.task->start = {from};
    e.task->target = {to};
    const ReachWay way{experiment::CompiledExperiment(e)};
    const double least = std::min(from, to), most = std::max(from, to);
    for (double phi = least - 0.2; phi < most + 0.2; phi += 0.0137) {
      dynamics::MassState mass;
      mass.q[0] = phi;
      const Vec3 place = way.at(way.placeOf(mass)).position;
      ASSERT_LT(norm(place - Vec3{0.3 * std::cos(phi), 0.1 * std::sin(phi), 0.02 * phi}), 2e-7) << phi;
    }
    EXPECT_LT(norm(way.at(0).position - Vec3{0.3 * std::cos(from), 0.1 * std::sin(from), 0.02 * from}), 1e-9);
  }
}

TEST(ReachWay, NoWayIsRefused) {
  experiment::Experiment still = shortReach();
  still.task->target = still.task->start;
  EXPECT_THROW(ReachWay{experiment::CompiledExperiment(still)}, FaultError);
  EXPECT_THROW(ReachWay{experiment::CompiledExperiment(experiment::readExperiment("torus"))}, RefusedError);
}

// A hand on its own, told these forces tick by tick from the signal on.
std::vector<haptics::DeviceSample> carriedOut(const std::string& options, const std::function<Vec3(int)>& force, int ticks = 900,
                                              int trial = 0) {
  const experiment::CompiledExperiment experiment(shortReach());
  std::shared_ptr<void> learnt;
  const auto hand =
      prepareImpedanceSubjects(experiment, parseImpedanceSubject("kind=impedance,reaction=0,time-sd=0" + options))(3, 0, learnt);
  hand->prepareTrial(trial);
  hand->cue(haptics::Cue::Place);
  EXPECT_LT(norm(hand->read().position - Vec3{-0.05, 0.02, 0.01}), 1e-12) << "at its start until the signal";
  hand->cue(haptics::Cue::Go);
  std::vector<haptics::DeviceSample> samples;
  for (int tick = 0; tick < ticks; ++tick) {
    hand->write(force(tick));
    samples.push_back(hand->read());
  }
  return samples;
}
const auto kNoForce = [](int) { return Vec3{}; };

// What a push changes is linear: arm, impedance at once, and the delayed correction through the muscle's two stages, on each axis alike.
TEST(ImpedanceHand, GivesWayToAPushAsItsArmItsImpedanceAndItsReflexSay) {
  for (const int delay : {0, 37}) {
    const std::string options =
        ",noise=0,arm-mass=1.1,arm-damping=6,muscle=0.03,stiffness=210,damping=25,feedback-stiffness=140,feedback-damping=9,delay=" +
        std::to_string(1e-3 * delay);
    const auto push = [](int tick) { return tick < 300 ? Vec3{2, -1, 0.5} : tick < 600 ? Vec3{0, 1, 0} : Vec3{}; };
    const auto free = carriedOut(options, kNoForce), pushed = carriedOut(options, push);
    const SteppedArm arm = stepArm({1.1, 6, 0.03}, 1e-3);
    const double keep = std::exp(-1e-3 / 0.03);
    Vec3 place, speed, stage, correction;
    std::vector<std::pair<Vec3, Vec3>> off;
    for (int tick = 0; tick < 900; ++tick) {
      off.emplace_back(-1.0 * place, -1.0 * speed);
      const auto [late, lateSpeed] = tick >= delay ? off[static_cast<std::size_t>(tick - delay)] : std::pair<Vec3, Vec3>{};
      stage = keep * stage + (1 - keep) * (140 * late + 9 * lateSpeed);
      correction = keep * correction + (1 - keep) * stage;
      const Vec3 force = push(tick) + correction + 210 * off.back().first + 25 * off.back().second;
      place += arm.a(0, 1) * speed + arm.force(0) * force;
      speed = arm.a(1, 1) * speed + arm.force(1) * force;
      const auto at = static_cast<std::size_t>(tick);
      ASSERT_LT(norm(pushed[at].position - free[at].position - place), 1e-12) << delay << " tick " << tick;
      ASSERT_LT(norm(pushed[at].velocity - free[at].velocity - speed), 1e-10) << delay << " tick " << tick;
      ASSERT_TRUE(pushed[at].hasVelocity);
    }
  }
}

TEST(ImpedanceHand, AtRestAPushIsHeldByBothStiffnesses) {
  const std::string options = ",noise=0,stiffness=200,feedback-stiffness=50,damping=60";
  const auto last = [&](const Vec3& force) {
    return carriedOut(
               options, [=](int) { return force; }, 4000)
        .back()
        .position;
  };
  EXPECT_LT(norm(last({1, 2, -2}) - last({}) - Vec3{1, 2, -2} / 250), 1e-7);
}

// Its noise is linear in what it is asked to be, and along the way where it is added: draws are the same for the same seed and trial.
TEST(ImpedanceHand, ItsNoiseIsAsLargeAsItIsAskedToBe) {
  const auto off = [](const std::string& options, int trial = 0) {
    const auto quiet = carriedOut(",noise=0", kNoForce, 500), noisy = carriedOut(options, kNoForce, 500, trial);
    std::vector<Vec3> difference;
    for (std::size_t i = 0; i < quiet.size(); ++i) difference.push_back(noisy[i].position - quiet[i].position);
    return difference;
  };
  const auto motor = off(",motor-noise=0.1,force-noise=0"), added = off(",motor-noise=0,force-noise=0.3");
  const auto both = off(",motor-noise=0.1,force-noise=0.3"), twice = off(",motor-noise=0.2,force-noise=0"),
             doubled = off(",noise=2,motor-noise=0.1,force-noise=0");
  const auto other = off(",motor-noise=0.1,force-noise=0", 1);
  double most = 0, apart = 0;
  for (std::size_t i = 0; i < motor.size(); ++i) {
    EXPECT_LT(norm(both[i] - motor[i] - added[i]), 1e-12) << i;
    EXPECT_LT(norm(twice[i] - 2 * motor[i]), 1e-12) << i;
    EXPECT_LT(norm(doubled[i] - 2 * motor[i]), 1e-12) << i;
    most = std::max({most, norm(motor[i]), norm(added[i])});
    apart = std::max(apart, norm(other[i] - motor[i]));
  }
  EXPECT_GT(most, 1e-5);
  EXPECT_GT(apart, 1e-5) << "another trial's draws are others";
  for (const Vec3& v : off(",motor-noise=0,force-noise=0")) EXPECT_EQ(v, Vec3{});
}

// With the right model of the object and nothing else it is where the plan is.
TEST(ImpedanceHand, CarriesItsPlanOutWhereItKnowsTheObject) {
  const experiment::CompiledExperiment experiment(experiment::readExperiment("chain-slow"));
  std::shared_ptr<void> learnt;
  const auto hand = prepareImpedanceSubjects(experiment, parseImpedanceSubject("kind=impedance,noise=0,reaction=0"))(1, 0, learnt);
  const auto plan = prepareSubjects(experiment, SubjectSpec{.noise = 0, .reaction = 0.001})(1, 0, learnt);
  haptics::TickEngine engine(experiment, haptics::engineOptions(*hand));
  hand->prepareTrial(0), plan->prepareTrial(0);
  double worst = 0;
  int since = -1;
  reachTickByTick(engine, *hand, [&](const haptics::DeviceSample& sample, std::optional<haptics::Cue> cue) {
    const Vec3 meant = plan->read().position;
    if (since >= 0) ++since, worst = std::max(worst, norm(sample.position - meant));
    if (cue) plan->cue(*cue), since = *cue == haptics::Cue::Go ? 0 : since;
    return since < 1500;
  });
  EXPECT_EQ(since, 1500);
  EXPECT_LT(worst, 5e-4) << worst;
}

}  // namespace
}  // namespace reachlab::subjects
