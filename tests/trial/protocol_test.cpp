#include "constraints/constraint.h"
#include "sim/experiment/experiment.h"
#include "sim/trial/protocol.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "base/fault.h"
#include "sim/experiment/experiment.h"
#include "tests/refusal.h"

namespace reachlab::trial {
namespace {

// A task of 1 s +- 0.2 s from x = -0.1 m to x = 0.1 m, driven tick by tick with the hands and two masses as told.
class Protocol : public ::testing::Test {
 protected:
  Protocol() {
    settings.start = {-0.1, 0, 0};
    settings.target = {0.1, 0, 0};
    settings.positionTolerance = 0.01;
    settings.velocityTolerance = 0.02;
    settings.earliest = 0.8;
    settings.earliestTick = 800;
    settings.latestTick = 1200;
    settings.timeoutTicks = 5000;
    for (dynamics::MassState& m : masses) m.r = settings.start;
    in.hips = {&hip, 1};
  }

  Phase tick(Command command = Command::None) {
    in.tick = ++now;
    in.command = command;
    in.masses = masses;
    advance(settings, in, state);
    in.missedTicks = 0;
    return state.phase;
  }
  Phase ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
    return state.phase;
  }
  Phase tickAfterGap(std::uint32_t missed) {
    in.missedTicks = missed;
    return tick();
  }
  Phase arm() {
    hip = settings.start;
    tick(Command::NextTrial);
    return tick();
  }
  // Onset at the latest tick: t = 0 is now.
  void leave() {
    arm();
    hip.x += 0.05;
    tick();
  }
  void arrive(double away = 0, double massSpeed = 0) {
    for (dynamics::MassState& m : masses) m.r = {settings.target.x - away, 0, 0}, m.v = {massSpeed, 0, 0};
  }
  void expectEnd(Outcome outcome, Reason reason) const {
    EXPECT_EQ(state.phase, Phase::Done);
    EXPECT_EQ(nameOf(state.result.outcome), nameOf(outcome));
    EXPECT_EQ(nameOf(state.result.reason), nameOf(reason));
    EXPECT_EQ(state.result.endTick, now);
  }

  ProtocolSettings settings;
  ProtocolInput in;
  ProtocolState state;
  std::vector<dynamics::MassState> masses{2};
  Vec3 hip{-0.1, 0, 0};
  std::uint64_t now = 0;
};

TEST_F(Protocol, StaysIdleUntilATrialIsQueuedAndIgnoresOrdersThatMeanNothingNow) {
  EXPECT_EQ(ticks(3), Phase::Idle);
  EXPECT_EQ(tick(Command::Abort), Phase::Idle);
  EXPECT_EQ(tick(Command::Interrupt), Phase::Idle);
  leave();
  EXPECT_EQ(tick(Command::NextTrial), Phase::Moving);
  EXPECT_EQ(state.trial, 1);
}

TEST_F(Protocol, ArmsOnlyWithTheHandWithinTheRadiusOfTheStart) {
  tick(Command::NextTrial);
  hip.x += 1.01 * settings.armRadius;
  EXPECT_EQ(ticks(100), Phase::Waiting);
  hip.x -= 0.02 * settings.armRadius;
  EXPECT_EQ(tick(), Phase::Armed);
  EXPECT_EQ(state.armedTick, now);
}

// A hand that comes back from the last reach passes the start, or reaches it with speed: no trial begins under it.
TEST_F(Protocol, ArmsOnceTheHandHasRestedAtTheStartWithoutABreak) {
  settings.restTicks = 300;
  settings.restSpeed = 0.02;
  const std::pair<std::function<void()>, std::function<void()>> breaks[] = {
      {[&] { in.hipSpeed = 0.021; }, [&] { in.hipSpeed = 0.019; }},
      {[&] { hip.x += 1.01 * settings.armRadius; }, [&] { hip = settings.start; }},
      {[&] { in.handValid = false; }, [&] { in.handValid = true; }}};
  for (const auto& [breakOff, restAgain] : breaks) {
    tick(Command::NextTrial);
    EXPECT_EQ(ticks(300), Phase::Waiting);
    breakOff();
    EXPECT_EQ(tick(), Phase::Waiting);
    restAgain();
    EXPECT_EQ(ticks(300), Phase::Waiting) << "the rest begins anew";
    EXPECT_EQ(tick(), Phase::Armed);
    tick(Command::Abort);
  }
}

TEST_F(Protocol, TimeRunsFromTheFirstTickBeyondTheOnsetFromWhereTheHandWasAtArming) {
  tick(Command::NextTrial);
  hip = settings.start + Vec3{0, 0.9 * settings.armRadius, 0};
  EXPECT_EQ(ticks(10), Phase::Armed);
  hip.x += 0.999 * settings.onset;
  EXPECT_EQ(ticks(50), Phase::Armed);
  hip.x += 0.002 * settings.onset;
  EXPECT_EQ(tick(), Phase::Moving);
  EXPECT_EQ(state.onsetTick, now);
}

TEST_F(Protocol, SucceedsAtTheFirstAndTheLastTickOfTheWindow) {
  for (const int when : {800, 1000, 1200}) {
    for (dynamics::MassState& m : masses) m.r = settings.start;
    leave();
    ASSERT_EQ(ticks(when - 1), Phase::Moving);
    arrive();
    tick();
    expectEnd(Outcome::Success, Reason::None);
    EXPECT_EQ(state.semaphore, Semaphore::Green);
    EXPECT_DOUBLE_EQ(state.result.movementTime, when * 1e-3);
  }
}

TEST_F(Protocol, AnArrivalBeforeTheWindowIsTooShortAtOnceAndSaysByHowMuch) {
  for (const int when : {799, 550}) {
    for (dynamics::MassState& m : masses) m.r = settings.start;
    leave();
    ticks(when - 1);
    arrive();
    tick();
    expectEnd(Outcome::Failure, Reason::TimeShort);
    EXPECT_EQ(state.result.mass, 0);
    EXPECT_NEAR(state.result.by, 0.8 - 1e-3 * when, 1e-12) << "rounding of decimal fractions";
    EXPECT_EQ(state.semaphore, Semaphore::Neutral);
  }
}

TEST_F(Protocol, AllMassesArriveAtOneTickOrNone) {
  leave();
  ticks(900);
  arrive();
  masses[1].r.y = 1.001 * settings.positionTolerance;
  EXPECT_EQ(ticks(10), Phase::Moving);
  masses[1].r.y = 0;
  masses[0].r.x -= 0.02;
  EXPECT_EQ(tick(), Phase::Moving);
  masses[0].r.x += 0.02;
  masses[0].v.z = 1.001 * settings.velocityTolerance;
  EXPECT_EQ(ticks(10), Phase::Moving);
  masses[0].v.z = settings.velocityTolerance;
  tick();
  expectEnd(Outcome::Success, Reason::None);
}

// The last mass goes from -0.1 to 0.1 m with 1 mm a tick.
TEST_F(Protocol, ArrivalNeedsThePlacesOnTheWayInTheirOrder) {
  const Vec3 first{-0.05, 0.03, 0}, second{0.05, 0, 0};
  settings.via = {first, second};
  settings.viaRadius = 1e-4;  // less than the way of one tick
  const auto reachPast = [&](std::initializer_list<Vec3> corners) {
    for (dynamics::MassState& m : masses) m = {}, m.r = settings.start;
    leave();
    for (const Vec3& corner : corners) {
      const Vec3 from = masses[1].r;
      constexpr int kTicks = 97;  // no position lies at a corner's side
      for (int i = 1; i <= kTicks; ++i) masses[1].r = from + (i / double{kTicks}) * (corner - from), tick();
    }
    ticks(850 - static_cast<int>(now - state.onsetTick));
    masses[0].r = masses[1].r;  // within the window
    tick();
  };
  const auto expectMiss = [&] {
    ticks(static_cast<int>(state.onsetTick + 1200 - now));
    expectEnd(Outcome::Failure, Reason::Via);
    EXPECT_EQ(state.semaphore, Semaphore::Red);
    EXPECT_EQ(state.result.mass, 0);
  };
  reachPast({first, second + Vec3{0, 0.01, 0}, second - Vec3{0, 0.01, 0}, settings.target});
  expectEnd(Outcome::Success, Reason::None);
  EXPECT_EQ(state.viaPassed, 2);
  reachPast({second, first, settings.target});
  EXPECT_EQ(state.viaPassed, 1) << "the second was passed before the first";
  expectMiss();
  reachPast({{-0.05, -0.002, 0}, settings.target});
  expectMiss();
  EXPECT_NEAR(state.result.by, 0.032 * std::cos(std::atan2(0.002, 0.05)) - 1e-4, 1e-12) << "from the way's first part, less the radius";
}

// Start and target of a full lap are one place, where all masses are at onset.
TEST_F(Protocol, AWayThatComesBackIsOverOnceTheLastMassHasBeenAway) {
  settings.target = settings.start;
  settings.comesBack = true;
  leave();
  ticks(900);
  EXPECT_EQ(state.phase, Phase::Moving) << "nothing has moved yet";
  arrive(settings.positionTolerance);
  tick();
  EXPECT_EQ(state.phase, Phase::Moving) << "no farther than dx";
  arrive(0.2);
  tick();
  arrive();
  tick();
  expectEnd(Outcome::Success, Reason::None);
  leave();
  arrive(0.004);
  ticks(1200);
  expectEnd(Outcome::Failure, Reason::Position);
  EXPECT_NEAR(state.result.by, 0.006, 1e-15) << "what was lacking";
}

TEST_F(Protocol, TheDeadlineBlamesTheWorstMassForItsPositionElseForItsVelocity) {
  leave();
  arrive();
  masses[0].r.x += 0.011;
  masses[1].r.x += 0.013;
  masses[0].v.x = 5;  // a mass that is not there is a position failure whatever its speed
  ticks(1200);
  expectEnd(Outcome::Failure, Reason::Position);
  EXPECT_EQ(state.result.mass, 2);
  EXPECT_NEAR(state.result.by, 0.003, 1e-12) << "rounding of the distance";
  EXPECT_DOUBLE_EQ(state.result.movementTime, 1.2);
  leave();
  arrive(0.005, 0.019);
  masses[0].v.y = 0.04;
  ticks(1200);
  expectEnd(Outcome::Failure, Reason::Velocity);
  EXPECT_EQ(state.result.mass, 1);
  EXPECT_NEAR(state.result.by, std::hypot(0.019, 0.04) - 0.02, 1e-12) << "rounding of the norm";
  leave();
  arrive();
  masses[1].r.x = std::numeric_limits<double>::quiet_NaN();
  ticks(1200);
  expectEnd(Outcome::Failure, Reason::Position);
  EXPECT_EQ(state.result.mass, 2) << "a mass that is not a number never arrives";
  leave();
  settings.target = {};
  masses[0] = {}, masses[1] = {};
  masses[0].r = {0.25, 0, 0}, masses[1].r = {0, 0.25, 0};
  ticks(1200);
  EXPECT_EQ(state.result.mass, 1) << "of equal excesses the first";
}

TEST_F(Protocol, TheSemaphoreFollowsTheWindow) {
  leave();
  ticks(799);
  EXPECT_EQ(state.semaphore, Semaphore::Neutral);
  tick();
  EXPECT_EQ(state.semaphore, Semaphore::Green);
  ticks(399);
  EXPECT_EQ(state.semaphore, Semaphore::Green);
  tick();
  EXPECT_EQ(state.semaphore, Semaphore::Red);
  tick(Command::NextTrial);
  EXPECT_EQ(state.semaphore, Semaphore::Neutral);
}

TEST_F(Protocol, ALostHandEndsTheTrialOnlyAfterTheGraceAndAWaitToo) {
  leave();
  in.handValid = false;
  ticks(kLostTicks);
  in.handValid = true;
  tick();
  in.handValid = false;
  EXPECT_EQ(ticks(kLostTicks), Phase::Moving);
  tick();
  expectEnd(Outcome::Interrupted, Reason::DeviceLost);
  tick(Command::NextTrial);
  EXPECT_EQ(ticks(kLostTicks), Phase::Waiting);
  tick();
  expectEnd(Outcome::Interrupted, Reason::DeviceLost);
}

TEST_F(Protocol, ALostHandDoesNotMoveAndOneThatIsNotANumberEndsTheTrialAtOnce) {
  arm();
  in.handValid = false;
  hip.x += 0.05;
  EXPECT_EQ(tick(), Phase::Armed);
  in.handValid = true;
  in.handBroken = true;
  tick();
  expectEnd(Outcome::Interrupted, Reason::DeviceLost);
}

TEST_F(Protocol, WhatHappensToTheObjectEndsATrialWhileForcesAct) {
  using dynamics::StepStatus;
  const std::pair<StepStatus, std::pair<Outcome, Reason>> cases[] = {{StepStatus::NotFinite, {Outcome::Aborted, Reason::Computation}},
                                                                     {StepStatus::Capped, {Outcome::Aborted, Reason::Computation}},
                                                                     {StepStatus::NoContinuation, {Outcome::Aborted, Reason::Computation}},
                                                                     {StepStatus::AtEnd, {Outcome::Failure, Reason::EndOfConstraint}},
                                                                     {StepStatus::PeerLost, {Outcome::Interrupted, Reason::PeerLost}}};
  for (const auto& [fault, end] : cases) {
    in.status = StepStatus::Ok;
    tick(Command::NextTrial);
    hip = {};
    in.status = fault;
    EXPECT_EQ(tick(), Phase::Waiting) << "no force acts yet";
    in.status = StepStatus::HandLost;
    hip = settings.start;
    tick();
    hip.x += 0.05;
    EXPECT_EQ(tick(), Phase::Moving) << "a hand that is lost for a tick has its own grace";
    in.status = fault;
    tick();
    expectEnd(end.first, end.second);
  }
}

TEST_F(Protocol, AClampEndsTheTrialOnlyIfTheExperimentSaysSo) {
  leave();
  in.clamped = true;
  EXPECT_EQ(tick(), Phase::Moving);
  settings.forceLimitEndsTrial = true;
  tick();
  expectEnd(Outcome::Failure, Reason::ForceLimit);
  hip = {};
  tick(Command::NextTrial);
  EXPECT_EQ(tick(), Phase::Waiting);
}

TEST_F(Protocol, AbortAndInterruptEndAnyTrialUnderWay) {
  tick(Command::NextTrial);
  tick(Command::Abort);
  expectEnd(Outcome::Aborted, Reason::Experimenter);
  leave();
  tick(Command::Interrupt);
  expectEnd(Outcome::Interrupted, Reason::Experimenter);
  EXPECT_EQ(state.trial, 2);
}

TEST_F(Protocol, MovingBeforeTheGoSignalIsAFalseStart) {
  in.planned.foreperiodTicks = 300;
  arm();
  EXPECT_EQ(ticks(200), Phase::Armed);
  hip.x += 0.01;
  tick();
  expectEnd(Outcome::Failure, Reason::Early);
  EXPECT_EQ(state.result.onsetTick, now);
  arm();
  ticks(299);
  EXPECT_FALSE(state.gone);
  tick();
  EXPECT_TRUE(state.gone);
  hip.x += 0.01;
  EXPECT_EQ(tick(), Phase::Moving);
}

TEST_F(Protocol, ACatchTrialIsWonByNotMovingAndLostByMoving) {
  in.planned.catchTrial = true;
  in.planned.foreperiodTicks = 100;
  arm();
  EXPECT_EQ(ticks(1299), Phase::Armed);
  EXPECT_FALSE(state.gone);
  tick();
  expectEnd(Outcome::Success, Reason::None);
  arm();
  hip.y += 0.01;
  tick();
  expectEnd(Outcome::Failure, Reason::Early);
}

TEST_F(Protocol, TheTimeoutRunsFromTheGoSignal) {
  settings.timeoutTicks = 50;
  for (const int foreperiod : {300, 0, -100}) {
    in.planned.foreperiodTicks = foreperiod;
    arm();
    EXPECT_EQ(state.gone, foreperiod <= 0);
    EXPECT_EQ(ticks(std::max(foreperiod, 0) + 49), Phase::Armed);
    tick();
    expectEnd(Outcome::Aborted, Reason::NoOnset);
    EXPECT_EQ(state.result.onsetTick, 0u);
  }
}

TEST_F(Protocol, OnlyAHandWithoutAPersonHasToBeAtTheStartInTime) {
  hip.x += 0.05;
  tick(Command::NextTrial);
  EXPECT_EQ(ticks(100'000), Phase::Waiting) << "a person may take any time";
  tick(Command::Abort);
  settings.startTimeoutTicks = 5000;
  tick(Command::NextTrial);
  EXPECT_EQ(ticks(4999), Phase::Waiting);
  tick();
  expectEnd(Outcome::Aborted, Reason::NoStart);
}

TEST_F(Protocol, AMovementThatMissedMoreTicksThanAllowedIsInterrupted) {
  settings.maxMissedTicks = 5;
  settings.maxGapTicks = 300;
  arm();
  EXPECT_EQ(tickAfterGap(290), Phase::Armed) << "what is missed before the movement does not count";
  hip.x += 0.05;
  tick();
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(tickAfterGap(1), Phase::Moving) << "five are allowed";
    ticks(10);
  }
  arrive();
  tickAfterGap(1);
  expectEnd(Outcome::Interrupted, Reason::Timing);
  EXPECT_EQ(state.result.movementTime, 0.056) << "of 1 ms ticks, as everywhere";
  masses.assign(2, {});
  leave();
  EXPECT_EQ(tickAfterGap(5), Phase::Moving) << "nor does what the trial before has missed";
}

TEST_F(Protocol, OneGapThatIsTooLongInterruptsTheMovement) {
  settings.maxGapTicks = 20;
  leave();
  EXPECT_EQ(tickAfterGap(19), Phase::Moving) << "20 ms between two ticks";
  tickAfterGap(20);
  expectEnd(Outcome::Interrupted, Reason::Timing);
}

// A false start in it is the machine's fault, not the subject's.
TEST_F(Protocol, AMovementThatBeginsInAGapHasMissedIt) {
  settings.maxMissedTicks = 5;
  for (const int foreperiod : {0, 300}) {
    in.planned.foreperiodTicks = foreperiod;
    arm();
    hip.x += 0.05;
    tickAfterGap(6);
    expectEnd(Outcome::Interrupted, Reason::Timing);
  }
  in.planned.foreperiodTicks = 0;
  arm();
  hip.x += 0.05;
  EXPECT_EQ(tickAfterGap(5), Phase::Moving);
  tickAfterGap(1);
  expectEnd(Outcome::Interrupted, Reason::Timing);
}

TEST_F(Protocol, BoundsAreReachedWhenTheyAreMet) {
  settings.start = settings.target = {};
  settings.armRadius = 0.125, settings.onset = 0.25, settings.positionTolerance = 0.5, settings.velocityTolerance = 0.25;
  settings.restSpeed = 0.0625;
  for (dynamics::MassState& m : masses) m.r = {2, 0, 0};
  tick(Command::NextTrial);
  hip = {0, 0.125, 0};
  in.hipSpeed = 0.0625;
  EXPECT_EQ(tick(), Phase::Armed) << "on the circle around the start, at the speed that is allowed";
  hip.y += 0.25;
  EXPECT_EQ(tick(), Phase::Armed) << "the onset must be passed";
  hip.y += 0.0625;
  EXPECT_EQ(tick(), Phase::Moving);
  ticks(799);
  for (dynamics::MassState& m : masses) m.r = {0.5, 0, 0}, m.v = {0, 0, -0.25};
  tick();
  expectEnd(Outcome::Success, Reason::None);
}

// Each hand at the start; the one that moves first makes the onset, wherever it was at arming.
TEST_F(Protocol, SeveralHandsAreEachAtTheStartAndTheFirstToMoveMoves) {
  std::vector<Vec3> hips{settings.start, settings.start, settings.start + Vec3{0, 1.01 * settings.armRadius, 0}};
  in.hips = hips;
  EXPECT_EQ(arm(), Phase::Waiting) << "the third is not at the start";
  hips[2].y -= 0.02 * settings.armRadius;
  EXPECT_EQ(ticks(10), Phase::Armed);
  hips[2].y -= 1.01 * settings.onset;
  EXPECT_EQ(tick(), Phase::Moving);
}

TEST_F(Protocol, ATrialThatEndsBeforeItsMovementHasNoTimeAndNoOnset) {
  leave();
  tick(Command::Abort);
  EXPECT_DOUBLE_EQ(state.result.movementTime, 0.001);
  EXPECT_EQ(state.result.onsetTick, now - 1);
  arm();
  EXPECT_EQ(state.result.outcome, Outcome::None) << "the next trial forgets the last";
  ticks(5);
  tick(Command::Abort);
  EXPECT_EQ(state.result.movementTime, 0);
  EXPECT_EQ(state.result.onsetTick, 0u);
}

// Of a chain the ends are computed at every tick, the rest when the verdict may hang on them.
TEST_F(Protocol, NeedsEveryMassWhereTheVerdictMayHangOnIt) {
  const auto needed = [&](std::uint64_t tick) { return needsEveryMass(settings, state, tick, masses); };
  arrive();
  EXPECT_FALSE(needed(5)) << "nothing moves";
  leave();
  EXPECT_TRUE(needed(now + 1)) << "both ends have arrived";
  masses[0].r.x += 0.02;
  EXPECT_FALSE(needed(now + 1));
  masses[0].r.x -= 0.02;
  masses[1].v.x = 0.03;
  EXPECT_FALSE(needed(now + 1199));
  EXPECT_TRUE(needed(now + 1200)) << "the deadline names the worst of all";
  masses.clear();
  EXPECT_FALSE(needed(now + 1200));
}

TEST(ProtocolPhase, IsEngagedWhileForcesAct) {
  for (const Phase phase : {Phase::Idle, Phase::Waiting, Phase::Done}) EXPECT_FALSE(isEngaged(phase));
  for (const Phase phase : {Phase::Armed, Phase::Moving}) EXPECT_TRUE(isEngaged(phase));
}

TEST(TrialResult, TheRunEndsWithWhatSomebodyBrokeOffAndGoesOnAfterWhatTheComputerSpoilt) {
  const auto result = [](Outcome outcome, Reason reason) { return TrialResult{.outcome = outcome, .reason = reason}; };
  for (const Reason reason : {Reason::Experimenter, Reason::Program}) {
    const TrialResult brokenOff = result(Outcome::Interrupted, reason);
    EXPECT_TRUE(endsRun(brokenOff) && !isPutUpAgain(brokenOff));
  }
  for (const TrialResult& r : {result(Outcome::Interrupted, Reason::Timing), result(Outcome::Interrupted, Reason::DeviceLost),
                               result(Outcome::Aborted, Reason::Experimenter)})
    EXPECT_TRUE(!endsRun(r) && isPutUpAgain(r));
  for (const TrialResult& r : {result(Outcome::Failure, Reason::Position), result(Outcome::Success, Reason::None)})
    EXPECT_TRUE(!endsRun(r) && !isPutUpAgain(r));
}

TEST(TrialResult, HasNamesThatFilesKnow) {
  const std::string_view outcomes[] = {"none", "success", "failure", "aborted", "interrupted"};
  for (int i = 0; i < 5; ++i) EXPECT_EQ(nameOf(static_cast<Outcome>(i)), outcomes[i]);
  const std::string_view reasons[] = {"none",        "position", "velocity",     "time_short",        "none",        "force_limit",
                                      "device_lost", "no_onset", "experimenter", "end_of_constraint", "computation", "program",
                                      "early",       "timing",   "no_start",     "peer_lost",         "via"};
  for (int i = 0; i < 17; ++i) EXPECT_EQ(nameOf(static_cast<Reason>(i)), reasons[i]);
  EXPECT_EQ(kLastReason, static_cast<Reason>(16));
}

experiment::Experiment withTask(double start, double target) {
  experiment::Experiment experiment;
  experiment.task = experiment::Task{};
  experiment.task->start = {start}, experiment.task->target = {target};
  return experiment;
}
const constraints::Constraint& line() {
  static const constraints::Constraint made = constraints::makeConstraint({"line", {}, {}, {{"length_m", 0.2}}});
  return made;
}

// 1.35 s and 0.5 s have no exact binary form; the window's ends are whole ticks all the same.
TEST(ProtocolSettings, WindowInTicksIsExactForDecimalTimes) {
  experiment::Experiment experiment = withTask(0, 6.283185307179586);
  const double cases[][2] = {{1.35, 0.5}, {2.26, 0.5}, {0.68, 0.5}, {2.5, 0.3}, {0.1, 0.07}};
  for (const auto& [duration, tolerance] : cases) {
    experiment.task->duration = duration;
    experiment.task->tolerance.time = tolerance;
    const ProtocolSettings s = makeProtocolSettings(experiment, line());
    EXPECT_EQ(s.earliestTick, std::llround(1000 * (duration - tolerance)));
    EXPECT_EQ(s.latestTick, std::llround(1000 * (duration + tolerance)));
  }
  experiment.task->duration = 1.4996, experiment.task->tolerance.time = 0.2499;  // 1249.7 to 1749.5 ticks: the whole ones inside
  EXPECT_EQ(makeProtocolSettings(experiment, line()).earliestTick, 1250);
  EXPECT_EQ(makeProtocolSettings(experiment, line()).latestTick, 1749);
}

TEST(ProtocolSettings, AreTheTasksInTicks) {
  experiment::Experiment experiment = withTask(0, 3.141592653589793);
  experiment::Task& task = *experiment.task;
  task.armRadius = 0.015, task.onset = 0.002, task.rest = {0.25, 0.03};
  task.tolerance = {0.011, 0.013, 0.25};
  task.duration = 1.5, task.timeout = 7;
  experiment.timing = {4, 0.0305};
  experiment.forceLimitEndsTrial = true;
  const ProtocolSettings s = makeProtocolSettings(experiment, line());
  EXPECT_TRUE(s.armRadius == 0.015 && s.onset == 0.002 && s.restTicks == 250 && s.restSpeed == 0.03);
  EXPECT_TRUE(s.positionTolerance == 0.011 && s.velocityTolerance == 0.013);
  EXPECT_TRUE(s.earliest == 1.25 && s.earliestTick == 1250 && s.latestTick == 1750 && s.timeoutTicks == 7000);
  EXPECT_TRUE(s.maxMissedTicks == 4 && s.maxGapTicks == 30 && s.forceLimitEndsTrial && s.startTimeoutTicks == kNoLimit);
  EXPECT_NEAR(s.start.x, -0.1, 1e-15);
  EXPECT_NEAR(s.target.x, 0, 1e-15);
}

TEST(ProtocolSettings, RefuseATaskThatIsMissingOrWhereTheFormulaHasNoValue) {
  EXPECT_THROW(makeProtocolSettings(experiment::Experiment{}, constraints::Constraint{}), FaultError);
  constraints::ConstraintSpec spec;
  spec.name.clear();
  spec.curve = {"phi", "sqrt(phi)", "0"};
  const auto refusal = [&](double start, double target) -> std::string {
    return refusalOf([&] { makeProtocolSettings(withTask(start, target), constraints::makeConstraint(spec)); });
  };
  EXPECT_TRUE(holds(refusal(-1, 1), "task.start"));
  EXPECT_TRUE(holds(refusal(1, -1), "task.target"));
  EXPECT_EQ(refusal(0.5, 1), "");
}

}  // namespace
}  // namespace reachlab::trial
