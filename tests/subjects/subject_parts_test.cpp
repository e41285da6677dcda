// What a subject with feedback is made of, each part against another way to compute it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <deque>
#include <functional>
#include <numbers>
#include <random>
#include <utility>

#include "sim/experiment/experiment.h"
#include "sim/predict/predict.h"
#include "sim/subjects/feedback_hand.h"
#include "tests/refusal.h"
#include "tests/subjects/short_reach.h"

namespace reachlab::subjects {
namespace {

using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr ArmSpec kArm{1.3, 7, 0.03};

predict::LineObject objectOf(bool parallel) {
  predict::LineObject object;
  object.parallel = parallel;
  object.masses = {0.7, 1.9};
  object.springs = {310, 170};
  object.dampers = {2, 5};
  object.viscosity = {0.3, 0.8};
  return object;
}

// The law of arm_world.h, written out number by number.
VectorXd rateOf(const ArmSpec& arm, const predict::LineObject& o, const VectorXd& x, double command) {
  const double h = x(0), hv = x(1), f = x(2), g = x(3);
  const double x1 = x(4), x2 = x(5), v1 = x(6), v2 = x(7);
  const double first = o.springs[0] * (h - x1) + o.dampers[0] * (hv - v1);
  const double second = o.springs[1] * ((o.parallel ? h : x1) - x2) + o.dampers[1] * ((o.parallel ? hv : v1) - v2);
  const double onHand = first + (o.parallel ? second : 0);
  VectorXd rate(8);
  rate << hv, (f - arm.damping * hv - onHand) / arm.mass, (g - f) / arm.muscle, (command - g) / arm.muscle, v1, v2,
      (first - (o.parallel ? 0 : second) - o.viscosity[0] * v1) / o.masses[0], (second - o.viscosity[1] * v2) / o.masses[1];
  return rate;
}

TEST(ArmWorld, IsTheLawOfArmMuscleAndObject) {
  std::mt19937 random(1);
  std::normal_distribution<double> any;
  for (const bool parallel : {false, true}) {
    const ArmWorld world = makeArmWorld(kArm, objectOf(parallel));
    ASSERT_EQ(world.masses, 2);
    ASSERT_EQ(world.states(), 8);
    for (int i = 0; i < 20; ++i) {
      VectorXd x(8);
      for (double& entry : x) entry = any(random);
      const double command = any(random);
      EXPECT_LT((world.a * x + world.b * command - rateOf(kArm, objectOf(parallel), x, command)).norm(), 1e-10);
      const double onHand = -kArm.mass * (rateOf(kArm, objectOf(parallel), x, command)(1) - (x(2) - kArm.damping * x(1)) / kArm.mass);
      EXPECT_NEAR(world.contact * x, onHand, 1e-10);
    }
  }
}

TEST(ArmWorld, AWrongModelScalesAllSpringsAndAllMasses) {
  predict::LineObject scaled = objectOf(false);
  for (double& k : scaled.springs) k *= 1.5;
  for (double& m : scaled.masses) m *= 0.8;
  const ArmWorld wrong = makeArmWorld(kArm, objectOf(false), {std::log(1.5), std::log(0.8)}), other = makeArmWorld(kArm, scaled);
  EXPECT_LT((wrong.a - other.a).norm(), 1e-9);
  EXPECT_LT((wrong.contact - other.contact).norm(), 1e-9);
}

// Runge and Kutta in steps of 10 us.
TEST(ArmWorld, AStepIsTheLawCarriedOut) {
  VectorXd x(8);
  x << -0.2, 0.3, 1.5, -0.7, -0.19, -0.21, 0.1, -0.2;
  const double command = 4, force = -2.5;
  const auto runge = [](VectorXd state, const std::function<VectorXd(const VectorXd&)>& rate) {
    constexpr double kStep = 1e-5;
    for (int i = 0; i < 1000; ++i) {
      const VectorXd a = rate(state), b = rate(state + kStep / 2 * a), c = rate(state + kStep / 2 * b), d = rate(state + kStep * c);
      state += kStep / 6 * (a + 2 * b + 2 * c + d);
    }
    return state;
  };
  const SteppedWorld stepped = stepWorld(makeArmWorld(kArm, objectOf(true)), 0.01);
  EXPECT_LT(
      (stepped.a * x + stepped.b * command - runge(x, [&](const VectorXd& s) { return rateOf(kArm, objectOf(true), s, command); })).norm(),
      1e-9);
  const SteppedArm arm = stepArm(kArm, 0.01);
  const Eigen::Vector4d body = x.head(4);
  const VectorXd alone = runge(VectorXd(body), [&](const VectorXd& s) {
    VectorXd rate(4);
    rate << s(1), (s(2) - kArm.damping * s(1) + force) / kArm.mass, (s(3) - s(2)) / kArm.muscle, (command - s(3)) / kArm.muscle;
    return rate;
  });
  EXPECT_LT((arm.a * body + arm.command * command + arm.force * force - alone).norm(), 1e-9);
}

CostSpec shortCost() {
  CostSpec cost;
  cost.distance = 0.15, cost.duration = 0.07, cost.hold = 0.05;
  cost.position = 0.013, cost.velocity = 0.021, cost.effort = 0.04;
  return cost;
}
SenseSpec someSenses() {
  SenseSpec senses;
  senses.position = 0.007, senses.velocity = 0.2, senses.force = 0.4, senses.seen = 0.003;
  senses.touchDelay = 2, senses.sightDelay = 3;
  return senses;
}
struct Kept {
  ArmWorld world = makeArmWorld(kArm, objectOf(false));
  SteppedWorld step = stepWorld(world, kControlStep);
  RowVectorXd gain(const FeedbackGains& gains, int i) const {
    return Eigen::Map<const RowVectorXd>(gains.control.data() + static_cast<std::ptrdiff_t>(i) * gains.states, gains.states);
  }
};

// Weights of the hold: each place and speed against its tolerance.
MatrixXd holdCost(const ArmWorld& world, const CostSpec& cost) {
  MatrixXd hold = MatrixXd::Zero(world.states(), world.states());
  for (const int place : {0, 4, 5}) hold(place, place) = kControlStep / std::pow(cost.position, 2);
  for (const int speed : {1, 6, 7}) hold(speed, speed) = kControlStep / std::pow(cost.velocity, 2);
  return hold;
}

// Without noise in proportion to the command the first command is that of the least cost of all together: a long hold, solved as one system.
TEST(FeedbackGains, AreThoseOfTheLeastCost) {
  const Kept kept;
  CostSpec cost = shortCost();
  cost.criterion = predict::Criterion::MinHandForceChange;
  cost.criterionWeight = 0.02;
  cost.hold = 6;  // what comes after it does not count any more
  const RowVectorXd row = criterionRow(kept.world, kArm, 1, *cost.criterion);
  const MatrixXd hold = holdCost(kept.world, cost), move = cost.criterionWeight * kControlStep * row.transpose() * row;
  const FeedbackGains gains = computeFeedbackGains(kept.world, kArm, cost, someSenses(), 0, 0.1);
  // The cost of x0 under the gains, carried out from the seventh step on and held for ever by the stationary ones.
  VectorXd x(8);
  x << -0.1, 0.2, 1, 2, -0.12, -0.09, 0.1, 0.15;
  const auto costOf = [&](int changed, double by) {
    VectorXd state = x;
    double sum = 0;
    for (int i = 0; i < 1500; ++i) {
      const double command = -kept.gain(gains, std::min(i, 20)) * state + (i == changed ? by : 0);
      // The cost at step i is of the state there; the hold's begins with the movement's end.
      sum += state.dot((i >= 7 ? MatrixXd(hold + move) : move) * state) + cost.effort * kControlStep * command * command;
      state = kept.step.a * state + kept.step.b * command;
    }
    return sum;
  };
  const double least = costOf(-1, 0);
  for (int i = 0; i < 20; ++i) {
    const double more = costOf(i, 0.1) - least, less = costOf(i, -0.1) - least;
    EXPECT_GT(more, 0) << i;
    EXPECT_NEAR(more, less, 1e-3 * (more + less)) << i << ": the middle of a parabola";
  }
}

// With it: the stationary gain costs least under its own noise, cost-to-go S = Q + K'(r + s^2 b'Sb)K + (A - bK)'S(A - bK).
TEST(FeedbackGains, CountOnNoiseInProportionToTheCommand) {
  const Kept kept;
  CostSpec cost = shortCost();
  cost.hold = 2;
  constexpr double kNoise = 0.8;
  const FeedbackGains gains = computeFeedbackGains(kept.world, kArm, cost, someSenses(), kNoise, 0.1);
  const RowVectorXd held = kept.gain(gains, 7);
  const auto costOf = [&](const RowVectorXd& gain) {
    MatrixXd s = MatrixXd::Zero(8, 8);
    const MatrixXd closed = kept.step.a - kept.step.b * gain;
    for (int i = 0; i < 3000; ++i) {
      const double spent = kept.step.b.dot(s * kept.step.b);
      s = holdCost(kept.world, cost) + (cost.effort * kControlStep + kNoise * kNoise * spent) * gain.transpose() * gain +
          closed.transpose() * s * closed;
    }
    return s.trace();
  };
  const double least = costOf(held);
  for (int k = 0; k < 8; ++k) {
    RowVectorXd more = held, less = held;
    more(k) *= 1.01, less(k) *= 0.99;
    EXPECT_GT(costOf(more), least) << k;
    EXPECT_GT(costOf(less), least) << k;
  }
}

// The estimator's error under its own gains, by Joseph's form: no gain of any step could be another without the estimate being worse.
TEST(FeedbackGains, NoOtherFilterKnowsMore) {
  const Kept kept;
  const CostSpec cost = shortCost();
  for (const Sight sight : {Sight::Ends, Sight::None}) {
    SenseSpec senses = someSenses();
    senses.sight = sight;
    constexpr double kMotorNoise = 0.5, kForceNoise = 0.3;
    const FeedbackGains gains = computeFeedbackGains(kept.world, kArm, cost, senses, kMotorNoise, kForceNoise);
    const int all = gains.estimate(), ny = gains.senses(), v = gains.sight, sightAt = 8 + 3 * 2;
    MatrixXd ahead = MatrixXd::Zero(all, all), look = MatrixXd::Zero(ny, all), noise = MatrixXd::Zero(ny, ny);
    ahead.topLeftCorner(8, 8) = kept.step.a;
    ahead(8, 0) = ahead(9, 1) = 1;
    ahead.block(10, 0, 1, 8) = kept.world.contact;
    for (int j = 0; j < 3; ++j) ahead(11 + j, 8 + j) = look(j, 11 + j) = 1;
    for (int j = 0; j < v; ++j) {
      ahead(sightAt + j, gains.seen[static_cast<std::size_t>(j)]) = 1;
      ahead(sightAt + v + j, sightAt + j) = ahead(sightAt + 2 * v + j, sightAt + v + j) = 1;
      look(3 + j, sightAt + 2 * v + j) = 1;
      noise(3 + j, 3 + j) = senses.seen * senses.seen;
    }
    noise(0, 0) = std::pow(senses.position, 2), noise(1, 1) = std::pow(senses.velocity, 2), noise(2, 2) = std::pow(senses.force, 2);
    const auto gainOf = [&](int i) {
      return MatrixXd(Eigen::Map<const MatrixXd>(gains.filter.data() + static_cast<std::ptrdiff_t>(i) * all * ny, all, ny));
    };
    const auto errorOf = [&](int changed, int row, int column, double by) {
      MatrixXd p = MatrixXd::Zero(all, all);
      p.topLeftCorner(8, 8).diagonal().setConstant(1e-8);
      VectorXd mean = VectorXd::Zero(8);
      for (const int place : {0, 4, 5}) mean(place) = -cost.distance;
      for (int i = 0; i < gains.steps; ++i) {
        MatrixXd gain = gainOf(i);
        if (i == changed) gain(row, column) += by;
        const MatrixXd left = ahead - gain * look;
        p = left * p * left.transpose() + gain * noise * gain.transpose();
        const double command = -kept.gain(gains, i) * mean;
        p.topLeftCorner(8, 8) += (std::pow(kMotorNoise * command, 2) + std::pow(kForceNoise, 2)) * kept.step.b * kept.step.b.transpose();
        mean = kept.step.a * mean + kept.step.b * command;
      }
      return p.trace();
    };
    const double least = errorOf(-1, 0, 0, 0);
    for (int i = 0; i < gains.steps; i += 3)
      for (int row = 0; row < all; row += 3)
        for (int column = 0; column < ny; ++column) {
          const double by = 1e-3, more = errorOf(i, row, column, by) - least, less = errorOf(i, row, column, -by) - least;
          ASSERT_GT(more, -1e-12) << i << ' ' << row << ' ' << column;
          ASSERT_NEAR(more, less, 1e-6 * (more + less) + 1e-11) << i << ' ' << row << ' ' << column;
        }
  }
}

TEST(FeedbackGains, ACriterionsRowIsItsIntegrand) {
  const ArmWorld world = makeArmWorld(kArm, objectOf(false));
  VectorXd x(8);
  x << -0.1, 0.2, 1, 2, -0.12, -0.09, 0.1, 0.15;
  const auto of = [&](predict::Criterion criterion) { return double(criterionRow(world, kArm, 2.5, criterion) * x); };
  const VectorXd rate = rateOf(kArm, objectOf(false), x, 0), second = rateOf(kArm, objectOf(false), rate, 0);
  EXPECT_NEAR(of(predict::Criterion::MinHandJerk), second(1), 1e-9);
  EXPECT_NEAR(of(predict::Criterion::MinHandForce), 1 - kArm.damping * 0.2, 1e-12);
  EXPECT_NEAR(of(predict::Criterion::MinHandForceChange), (2 - 1) / kArm.muscle, 1e-9);
  const predict::LineObject object = objectOf(false);
  double momentum = kArm.mass * rate(1);
  for (int i = 0; i < world.masses; ++i) momentum += object.masses[static_cast<std::size_t>(i)] * rate(world.speed(i));
  EXPECT_NEAR(of(predict::Criterion::MinComAcceleration), momentum / 2.5, 1e-12) << "of hand and object";
  for (const auto& [criterion, words] : {std::pair{predict::Criterion::MinTorqueChange, "needs an arm of two links"},
                                         {predict::Criterion::MinCrackle, "min-crackle: asks for a derivative"},
                                         {predict::Criterion::MinHandCrackle, "min-hand-crackle: asks for a derivative"}}) {
    EXPECT_TRUE(holds(refusalOf([&, asked = criterion] { of(asked); }), words));
  }
}

const std::string kShortDelays = "kind=ofc,delay-touch=0.03,delay-sight=0.05,time-sd=0.05,muscle=0.03,arm-damping=6";

TEST(FeedbackTask, IsWhatTheTaskSays) {
  const experiment::CompiledExperiment experiment(shortReach());
  FeedbackSpec spec = parseFeedbackSubject("kind=ofc,effort=0.07,criterion-effort=0.002,criterion-weight=0.3");
  const auto task = makeFeedbackTask(experiment, spec);
  EXPECT_NEAR(task->cost.distance, std::sqrt(0.12 * 0.12 + 0.09 * 0.09 + 0.04 * 0.04), 1e-15);
  EXPECT_EQ(task->cost.duration, 0.4);
  EXPECT_NEAR(task->cost.hold, 0.4, 1e-15) << "its time's tolerance, and 0.3 s";
  EXPECT_EQ(task->cost.position, 0.012);
  EXPECT_EQ(task->cost.velocity, 0.012);
  EXPECT_EQ(task->cost.effort, 0.07);
  EXPECT_FALSE(task->cost.criterion);
  EXPECT_EQ(task->cost.criterionWeight, 0);
  // The weight's unit is the least that the criterion can cost on a line as long.
  experiment::Experiment line = shortReach();
  line.constraint = {};
  line.constraint.name = "line";
  line.constraint.shape = {{"length_m", task->cost.distance}};
  line.task->start = {0};
  line.task->target = {2 * std::numbers::pi};
  predict::PredictOptions options;
  options.handMass = spec.arm.mass;
  for (const auto criterion : {predict::Criterion::MinHandForceChange, predict::Criterion::MinComAcceleration}) {
    spec.criterion = criterion;
    const auto by = makeFeedbackTask(experiment, spec);
    EXPECT_EQ(by->cost.effort, 0.002);
    EXPECT_EQ(by->cost.criterion, criterion);
    const double least = predict::predict(line, criterion, options)->cost, mass = spec.arm.mass + by->object.totalMass();
    EXPECT_NEAR(by->cost.criterionWeight * least / 0.3, criterion == predict::Criterion::MinComAcceleration ? 1 / (mass * mass) : 1, 1e-9);
  }
}

// Lengths that no line of the catalogue has are scaled: the cost of a reach goes with its square.
TEST(FeedbackTask, ALongWayIsWeighedAsOneOfAMetre) {
  const auto weightOf = [](double length) {
    experiment::Experiment e = shortReach();
    e.task->start = {0, 0, 0};
    e.task->target = {0, length, 0};
    return makeFeedbackTask(experiment::CompiledExperiment(e), parseFeedbackSubject("kind=ofc,criterion=min-hand-jerk"))
        ->cost.criterionWeight;
  };
  EXPECT_NEAR(weightOf(2) / weightOf(0.5), 1 / 16.0, 1e-6);
  EXPECT_NEAR(weightOf(0.005) / weightOf(0.5), 1e4, 1e-2);
}

/// What feedback_hand.h says, written another way: matrices, and queues for what comes later.
class Reference {
 public:
  Reference(const FeedbackTask& task, const FeedbackSpec& person, std::uint64_t seed, int trial, int before)
      : task_(task), person_(person), draws_(seed, static_cast<std::uint64_t>(trial)), arm_(stepArm(person.arm, 1e-3)) {
    const double sigma = person.noise * person.noiseScale * (1 + person.practice * std::exp(-before / person.practiceTrials));
    ModelError used = person.first;
    used.stiffness += sigma * person.planSd.stiffness * draws_.boundedNormal();
    used.mass += sigma * person.planSd.mass * draws_.boundedNormal();
    CostSpec cost = task.cost;
    cost.duration *= 1 + person.noise * person.timeSd * draws_.boundedNormal();
    reaction_ = static_cast<int>(std::lround(1000 * person.reaction * (1 + std::min(person.noise, 1.0) * 0.15 * draws_.boundedNormal())));
    g_ = computeFeedbackGains(makeArmWorld(person.arm, task.object, used), person.arm, cost, person.senses, person.motorNoise,
                              person.forceNoise);
    start_ = -task.cost.distance;
    body_ << start_, 0, 0, 0;
    x_ = VectorXd::Zero(g_.states);
    x_(0) = start_;
    for (int i = 4; i < 4 + (g_.states - 4) / 2; ++i) x_(i) = start_;
    const VectorXd touch = Eigen::Vector3d(start_, 0, 0), sight = VectorXd::Constant(g_.sight, start_);
    touched_.assign(static_cast<std::size_t>(g_.touchDelay), touch);
    expectedTouch_ = touched_;
    seen_.assign(static_cast<std::size_t>(g_.sightDelay), sight);
    expectedSight_ = seen_;
  }
  // `masses`: their places, as they were shown before this tick. Gives h and h'.
  Eigen::Vector2d tick(double along, double push, const VectorXd& masses) {
    if (ticks_ >= reaction_) {
      if ((ticks_ - reaction_) % 10 == 0) step(along, masses);
      body_ = (arm_.a * body_ + arm_.command * noisy_ + arm_.force * (along + push)).eval();
    }
    ++ticks_;
    return body_.head(2);
  }
  double command() const { return command_; }

 private:
  void step(double along, const VectorXd& masses) {
    const int ny = g_.senses(), v = g_.sight, n = g_.states;
    // Of every step its own draws, the last step's again and again when the gains have ended.
    if (steps_ < g_.steps) {
      drawn_ = VectorXd::Zero(ny + 2);
      for (double& draw : drawn_) draw = person_.noise * draws_.normal();
    }
    touched_.push_back(Eigen::Vector3d(body_(0), body_(1), -along));
    VectorXd sight(v);
    for (int j = 0; j < v; ++j)
      sight(j) = g_.seen[static_cast<std::size_t>(j)] == 0 ? body_(0) : masses(g_.seen[static_cast<std::size_t>(j)] - 4);
    seen_.push_back(sight);
    VectorXd sd(ny);
    sd << person_.senses.position, person_.senses.velocity, person_.senses.force, VectorXd::Constant(v, person_.senses.seen);
    VectorXd y(ny), expected(ny);
    y << touched_.front(), seen_.front();
    y += sd.cwiseProduct(drawn_.head(ny));
    expected << expectedTouch_.front(), expectedSight_.front();
    for (auto* queue : {&touched_, &seen_, &expectedTouch_, &expectedSight_}) queue->pop_front();
    const int at = std::min(steps_, g_.steps - 1);
    command_ = -Eigen::Map<const RowVectorXd>(g_.control.data() + static_cast<std::ptrdiff_t>(at) * n, n) * x_;
    const Eigen::Map<const MatrixXd> advance(g_.advance.data(), n, n);
    const Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>> felt(g_.felt.data(), 3, n);
    VectorXd look(v);
    for (int j = 0; j < v; ++j) look(j) = x_(g_.seen[static_cast<std::size_t>(j)]);
    expectedTouch_.push_back(felt * x_);
    expectedSight_.push_back(look);
    const VectorXd correction =
        Eigen::Map<const MatrixXd>(g_.filter.data() + static_cast<std::ptrdiff_t>(at) * g_.estimate() * ny, g_.estimate(), ny) *
        (y - expected);
    x_ = (advance * x_ + Eigen::Map<const VectorXd>(g_.command.data(), n) * command_ + correction.head(n)).eval();
    // Newest first in the estimate, oldest first in the queues.
    for (int d = 0; d < g_.touchDelay; ++d)
      expectedTouch_[static_cast<std::size_t>(g_.touchDelay - 1 - d)] += correction.segment(n + 3 * d, 3);
    for (int d = 0; d < g_.sightDelay; ++d)
      expectedSight_[static_cast<std::size_t>(g_.sightDelay - 1 - d)] += correction.segment(n + 3 * g_.touchDelay + v * d, v);
    noisy_ = command_ * (1 + person_.motorNoise * drawn_(ny)) + person_.forceNoise * drawn_(ny + 1);
    ++steps_;
  }

  const FeedbackTask& task_;
  FeedbackSpec person_;
  SubjectDraws draws_;
  SteppedArm arm_;
  FeedbackGains g_;
  int reaction_ = 0, ticks_ = 0, steps_ = 0;
  double start_ = 0, command_ = 0, noisy_ = 0;
  Eigen::Vector4d body_;
  VectorXd x_, drawn_;
  std::deque<VectorXd> touched_, seen_, expectedTouch_, expectedSight_;
};

TEST(FeedbackHand, MovesAsItsEstimatorAndControllerSay) {
  const experiment::CompiledExperiment experiment(shortReach());
  for (const char* options :
       {",noise=0,reaction=0.013", ",reaction=0.02,model-mass=0.2,model-stiffness=-0.1,practice=0.5,sight=all", ",noise=2,sight=none"}) {
    const auto task = makeFeedbackTask(experiment, parseFeedbackSubject(kShortDelays + options));
    const auto state = std::make_shared<SubjectState>();
    state->person = parseFeedbackSubject(kShortDelays + options);
    state->person.noiseScale = 1.2;
    state->model.first = state->person.first;
    FeedbackHand hand(task, state, 42);
    const Vec3 way = task->way.at(0).along;
    for (const int trial : {0, 3}) {
      Reference reference(*task, state->person, 42, trial, trial == 0 ? 0 : 1);  // trials that were made before
      hand.prepareTrial(trial);
      hand.cue(haptics::Cue::Place);
      EXPECT_LT(norm(hand.read().position - Vec3{-0.05, 0.02, 0.01}), 1e-15) << "at its start until the signal";
      hand.cue(haptics::Cue::Go);
      VectorXd masses = VectorXd::Constant(1, -task->cost.distance);
      for (int tick = 0; tick < 1100; ++tick) {
        const double along = -1.5 * std::sin(0.01 * tick), push = tick > 300 && tick < 400 ? 0.7 : 0;
        hand.write(along * way);
        hand.push(push);
        const haptics::DeviceSample sample = hand.read();
        const Eigen::Vector2d expected = reference.tick(along, push, masses);
        const double place = dot(sample.position - Vec3{-0.05, 0.02, 0.01}, way) - task->cost.distance;
        ASSERT_NEAR(place, expected(0), 1e-9) << options << " trial " << trial << " tick " << tick;
        ASSERT_NEAR(dot(sample.velocity, way), expected(1), 1e-8) << options << " tick " << tick;
        ASSERT_NEAR(hand.command(), reference.command(), 1e-7) << options << " tick " << tick;
        const double moved = task->cost.distance * (1 - std::cos(0.003 * tick));
        masses(0) = moved - task->cost.distance;
        dynamics::MassState mass;
        mass.r = Vec3{-0.05, 0.02, 0.01} + moved * way;
        hand.see({&mass, 1});
      }
    }
  }
}

// Across its way the arm is a critically damped spring of 300 N/m on its mass.
TEST(FeedbackHand, AcrossItsWayItIsASpring) {
  const experiment::CompiledExperiment experiment(shortReach());
  const auto task = makeFeedbackTask(experiment, parseFeedbackSubject(kShortDelays + ",noise=0,reaction=0,arm-mass=1.2"));
  const auto state = std::make_shared<SubjectState>();
  state->person = parseFeedbackSubject(kShortDelays + ",noise=0,reaction=0,arm-mass=1.2");
  FeedbackHand hand(task, state, 1);
  hand.cue(haptics::Cue::Place);
  hand.cue(haptics::Cue::Go);
  const Vec3 way = task->way.at(0).along, side = cross(way, {0, 0, 1}) / norm(cross(way, {0, 0, 1}));
  const double w = std::sqrt(300 / 1.2);
  for (int tick = 1; tick <= 600; ++tick) {
    hand.write(3 * side);
    const haptics::DeviceSample sample = hand.read();
    const double t = 1e-3 * tick;
    ASSERT_NEAR(dot(sample.position, side) - dot(Vec3{-0.05, 0.02, 0.01}, side), 3.0 / 300 * (1 - (1 + w * t) * std::exp(-w * t)), 1.5e-4)
        << tick;
    ASSERT_NEAR(dot(sample.velocity, side), 3.0 / 300 * w * w * t * std::exp(-w * t), 2e-3) << tick;
    EXPECT_TRUE(sample.hasVelocity);
  }
  hand.cue(haptics::Cue::Place);
  EXPECT_EQ(dot(hand.read().velocity, side), 0);
  EXPECT_LT(norm(hand.read().position - Vec3{-0.05, 0.02, 0.01}), 1e-15);
}

// A trace that another model made: the step leads towards it, and is that of Gauss and Newton in the one surprise that a single number can be.
TEST(ModelLearner, FindsTheModelThatMadeTheSenses) {
  const predict::LineObject object = objectOf(false);
  CostSpec cost = shortCost();
  cost.duration = 0.5, cost.hold = 0.3;
  const SenseSpec senses = someSenses();
  const FeedbackGains gains = computeFeedbackGains(makeArmWorld(kArm, object), kArm, cost, senses, 0.1, 0.1);
  // The senses of a world with this error under commands that do not know it, without noise.
  const auto traceOf = [&](const ModelError& truth) {
    const ArmWorld world = makeArmWorld(kArm, object, truth);
    const SteppedWorld step = stepWorld(world, kControlStep);
    TrialTrace trace;
    trace.steps = gains.steps;
    std::deque<VectorXd> touch, sight;
    VectorXd x = VectorXd::Zero(8);
    for (const int place : {0, 4, 5}) x(place) = -cost.distance;
    touch.assign(2, Eigen::Vector3d(-cost.distance, 0, 0));
    sight.assign(3, Eigen::Vector2d(-cost.distance, -cost.distance));
    for (int i = 0; i < gains.steps; ++i) {
      touch.push_back(Eigen::Vector3d(x(0), x(1), world.contact * x));
      sight.push_back(Eigen::Vector2d(x(0), x(5)));
      for (const double value : touch.front()) trace.sensed.push_back(value);
      for (const double value : sight.front()) trace.sensed.push_back(value);
      touch.pop_front(), sight.pop_front();
      const double command = 3 * std::sin(0.2 * i) + (i < 20 ? 2 : 0);
      trace.command.push_back(command);
      x = (step.a * x + step.b * command).eval();
    }
    return trace;
  };
  const auto stepFrom = [&](const ModelError& truth, const ModelError& used) {
    return computeModelStep(gains, traceOf(truth), used, kArm, object, senses, cost.distance);
  };
  const ModelError none = stepFrom({}, {});
  EXPECT_NEAR(none.stiffness, 0, 1e-9) << "nothing surprises";
  EXPECT_NEAR(none.mass, 0, 1e-9);
  // One step of a damped search falls short of the truth by the damping; carried on it arrives there.
  for (const ModelError& truth : {ModelError{0.08, -0.05}, ModelError{-0.06, 0.09}}) {
    ModelError used;
    for (int i = 0; i < 200; ++i) {
      const ModelError by = stepFrom(truth, used);
      used.stiffness += by.stiffness, used.mass += by.mass;
    }
    EXPECT_NEAR(used.stiffness, truth.stiffness, 2e-3);
    EXPECT_NEAR(used.mass, truth.mass, 2e-3);
  }
  const ModelError far = stepFrom({1.5, -1.5}, {});
  EXPECT_LE(std::abs(far.stiffness), 0.3);
  EXPECT_LE(std::abs(far.mass), 0.3);
  EXPECT_EQ(std::max(std::abs(far.stiffness), std::abs(far.mass)), 0.3) << "no step is longer";
  TrialTrace nothing;
  EXPECT_EQ(computeModelStep(gains, nothing, {}, kArm, object, senses, cost.distance).mass, 0);
}

TEST(ModelLearner, TwoProcessesKeepAndAddEachItsOwn) {
  LearntModel model;
  model.first = {1, 2}, model.fast = {10, 20}, model.slow = {100, 200};
  learn({0.1, 0.5, 0.01, 0.9}, {3, 7}, model);
  EXPECT_NEAR(model.fast.stiffness, 5.3, 1e-12);
  EXPECT_NEAR(model.fast.mass, 10.7, 1e-12);
  EXPECT_NEAR(model.slow.stiffness, 90.03, 1e-12);
  EXPECT_NEAR(model.slow.mass, 180.07, 1e-12);
  EXPECT_NEAR(model.current().stiffness, 1 + 5.3 + 90.03, 1e-12);
  EXPECT_NEAR(model.current().mass, 2 + 10.7 + 180.07, 1e-12);
}

// 20,000 draws: standard errors 0.002 of a mean of uniforms, 0.007 of the normals' mean, 0.005 of their SD; four of them.
TEST(SubjectDraws, AreUniformAndNormalAndTheSameAgain) {
  SubjectDraws draws(5, 2), again(5, 2), other(5, 3);
  EXPECT_EQ(draws.normal(), again.normal());
  EXPECT_NE(draws.uniform(), other.uniform());
  double sum = 0, squares = 0, uniform = 0, farthest = 0;
  constexpr int kDraws = 20'000;
  for (int i = 0; i < kDraws; ++i) {
    const double normal = draws.normal(), u = draws.uniform(), bounded = draws.boundedNormal();
    sum += normal, squares += normal * normal, uniform += u;
    EXPECT_TRUE(u >= 0 && u < 1);
    farthest = std::max(farthest, std::abs(bounded));
  }
  EXPECT_NEAR(sum / kDraws, 0, 0.028);
  EXPECT_NEAR(std::sqrt(squares / kDraws), 1, 0.02);
  EXPECT_NEAR(uniform / kDraws, 0.5, 0.0082);
  EXPECT_EQ(farthest, 3) << "0.3 % are held to three SDs";
}

TEST(FeedbackSubject, APersonsNoiseIsThatOfCommandAndSensesAlike) {
  const experiment::CompiledExperiment experiment(shortReach());
  std::shared_ptr<void> learnt;
  const auto hand = prepareFeedbackSubjects(experiment, parseFeedbackSubject(kShortDelays + ",subject=1"))(1, 4, learnt);
  const auto state = std::static_pointer_cast<SubjectState>(learnt);
  const FeedbackSpec usual = parseFeedbackSubject(kShortDelays + ",subject=1");
  EXPECT_NEAR(state->person.motorNoise, 1.35 * usual.motorNoise, 1e-15);
  EXPECT_NEAR(state->person.forceNoise, 1.35 * usual.forceNoise, 1e-15);
  EXPECT_NEAR(state->person.senses.position, 1.35 * usual.senses.position, 1e-15);
  EXPECT_NEAR(state->person.senses.velocity, 1.35 * usual.senses.velocity, 1e-15);
  EXPECT_NEAR(state->person.senses.force, 1.35 * usual.senses.force, 1e-15);
  EXPECT_NEAR(state->person.senses.seen, 1.35 * usual.senses.seen, 1e-15);
  EXPECT_EQ(state->model.first.stiffness, -0.51);
  EXPECT_EQ(state->model.day, 4);
  EXPECT_EQ(state->model.trials, 0);
}

// 120 people: standard errors of an SD 6.5 %, of a mean 9 % of the SD; four of them.
TEST(FeedbackSubject, DrawnPeopleVaryAsTheyAreSaidTo) {
  const experiment::CompiledExperiment experiment(shortReach());
  const auto task = parseFeedbackSubject("kind=ofc,subject=drawn,delay-touch=0.01,delay-sight=0.01,sight=none");
  const auto prepared = prepareFeedbackSubjects(experiment, task);
  std::array<double, 4> sum{}, squares{};
  constexpr int kPeople = 120;
  for (int i = 0; i < kPeople; ++i) {
    std::shared_ptr<void> learnt;
    (void)prepared(static_cast<std::uint64_t>(i), 0, learnt);
    const FeedbackSpec& person = std::static_pointer_cast<SubjectState>(learnt)->person;
    const std::array<double, 4> drawn{person.first.stiffness, person.first.mass, std::log(person.noiseScale),
                                      std::log(person.learning.learnFast / 0.03)};
    EXPECT_NEAR(person.learning.learnSlow / 0.008, person.learning.learnFast / 0.03, 1e-12) << "as quick in both";
    for (std::size_t k = 0; k < 4; ++k) sum[k] += drawn[k], squares[k] += drawn[k] * drawn[k];
  }
  const std::array<double, 4> sd{0.45, 0.28, 0.24, 0.15};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(sum[k] / kPeople / sd[k], 0, 0.37) << k;
    EXPECT_NEAR(std::sqrt(squares[k] / kPeople) / sd[k], 1, 0.26) << k;
  }
}

}  // namespace
}  // namespace reachlab::subjects
