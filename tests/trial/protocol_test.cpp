#include "sim/trial/protocol.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "base/fault.h"

namespace reachlab::trial {
namespace {

// A task of 1 s +- 0.2 s from x = -0.1 m to x = 0.1 m, driven tick by tick with the hand and two masses as told.
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
    hip = settings.start;
  }

  void tick(Command command = Command::None) {
    ProtocolInput in;
    in.tick = ++now;
    in.command = command;
    in.planned = planned;
    in.hip = hip;
    in.hipSpeed = speed;
    in.handValid = handValid;
    in.handBroken = handBroken;
    in.clamped = clamped;
    in.status = status;
    in.masses = masses;
    in.missedTicks = std::exchange(missed, 0u);
    advance(settings, in, state);
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
  }
  void arm() {
    tick(Command::NextTrial);
    tick();
  }
  // Onset at the latest tick: t = 0 is now.
  void leave() {
    arm();
    hip.x += 0.05;
    tick();
  }
  void arrive(double away = 0, double speed = 0) {
    for (dynamics::MassState& m : masses) m.r = {settings.target.x - away, 0, 0}, m.v = {speed, 0, 0};
  }
  void expectEnd(Outcome outcome, Reason reason) const {
    EXPECT_EQ(state.phase, Phase::Done);
    EXPECT_EQ(nameOf(state.result.outcome), nameOf(outcome));
    EXPECT_EQ(nameOf(state.result.reason), nameOf(reason));
    EXPECT_EQ(state.result.endTick, now);
  }

  ProtocolSettings settings;
  ProtocolState state;
  PlannedTrial planned;
  std::vector<dynamics::MassState> masses{2};
  Vec3 hip;
  double speed = 0;  // [m/s] of the hand, as estimated
  bool handValid = true, handBroken = false, clamped = false;
  dynamics::StepStatus status = dynamics::StepStatus::Ok;
  std::uint64_t now = 0;
  std::uint32_t missed = 0;  // before the next tick
};

TEST_F(Protocol, StaysIdleUntilATrialIsPutUp) {
  ticks(3);
  EXPECT_EQ(state.phase, Phase::Idle);
  tick(Command::NextTrial);
  EXPECT_EQ(state.phase, Phase::Waiting);
  EXPECT_EQ(state.trial, 1);
}

TEST_F(Protocol, IgnoresOrdersThatMeanNothingNow) {
  tick(Command::Abort);
  tick(Command::Interrupt);
  EXPECT_EQ(state.phase, Phase::Idle);
  leave();
  tick(Command::NextTrial);
  EXPECT_EQ(state.phase, Phase::Moving);
  EXPECT_EQ(state.trial, 1);
}

TEST_F(Protocol, ArmsOnlyWithTheHandWithinTheRadiusOfTheStart) {
  hip.x += 1.01 * settings.armRadius;
  tick(Command::NextTrial);
  ticks(100);
  EXPECT_EQ(state.phase, Phase::Waiting);
  hip.x -= 0.02 * settings.armRadius;
  tick();
  EXPECT_EQ(state.phase, Phase::Armed);
  EXPECT_EQ(state.armedTick, now);
}

// A hand that comes back from the last reach passes the start, or reaches it with speed: no trial begins under it.
TEST_F(Protocol, ArmsOnceTheHandHasRestedAtTheStart) {
  settings.restTicks = 300;
  settings.restSpeed = 0.02;
  hip = settings.start + Vec3{0.05, 0, 0};
  speed = 0.3;
  tick(Command::NextTrial);
  while (hip.x > settings.start.x) {
    hip.x -= 0.3e-3;
    tick();
    ASSERT_EQ(state.phase, Phase::Waiting);
  }
  ticks(1000);
  EXPECT_EQ(state.phase, Phase::Waiting) << "at the start, but moving";
  speed = 0.019;
  ticks(200);
  speed = 0.021;  // a twitch begins the rest anew
  tick();
  speed = 0;
  ticks(300);
  EXPECT_EQ(state.phase, Phase::Waiting);
  tick();
  EXPECT_EQ(state.phase, Phase::Armed);
  EXPECT_EQ(state.armedTick, now);
}

TEST_F(Protocol, AHandThatPassesTheStartRestsAnew) {
  settings.restTicks = 300;
  tick(Command::NextTrial);
  ticks(299);
  hip.x += 1.01 * settings.armRadius;
  tick();
  hip = settings.start;
  ticks(300);
  EXPECT_EQ(state.phase, Phase::Waiting);
  tick();
  EXPECT_EQ(state.phase, Phase::Armed);
}

TEST_F(Protocol, ALostHandDoesNotRest) {
  settings.restTicks = 10;
  tick(Command::NextTrial);
  ticks(10);
  handValid = false;
  tick();
  handValid = true;
  ticks(10);
  EXPECT_EQ(state.phase, Phase::Waiting);
  tick();
  EXPECT_EQ(state.phase, Phase::Armed);
}

TEST_F(Protocol, DoesNotArmOnALostHand) {
  handValid = false;
  tick(Command::NextTrial);
  tick();
  EXPECT_EQ(state.phase, Phase::Waiting);
}

TEST_F(Protocol, TimeRunsFromTheFirstTickBeyondTheOnset) {
  arm();
  hip.x += 0.999 * settings.onset;
  ticks(50);
  EXPECT_EQ(state.phase, Phase::Armed);
  hip.x += 0.002 * settings.onset;
  tick();
  EXPECT_EQ(state.phase, Phase::Moving);
  EXPECT_EQ(state.onsetTick, now);
}

TEST_F(Protocol, OnsetIsMeasuredFromWhereTheHandWasAtArming) {
  hip = settings.start + Vec3{0, 0.9 * settings.armRadius, 0};
  arm();
  ticks(10);
  EXPECT_EQ(state.phase, Phase::Armed);
}

TEST_F(Protocol, AbortsWithoutOnsetWithinTheTimeout) {
  arm();
  ticks(4999);
  EXPECT_EQ(state.phase, Phase::Armed);
  tick();
  expectEnd(Outcome::Aborted, Reason::NoOnset);
  EXPECT_EQ(state.result.onsetTick, 0u);
}

TEST_F(Protocol, SucceedsAtTheFirstAndTheLastTickOfTheWindow) {
  for (const int when : {800, 1000, 1200}) {
    state = {};
    for (dynamics::MassState& m : masses) m.r = settings.start;
    hip = settings.start;
    leave();
    ticks(when - 1);
    ASSERT_EQ(state.phase, Phase::Moving);
    arrive();
    tick();
    expectEnd(Outcome::Success, Reason::None);
    EXPECT_DOUBLE_EQ(state.result.movementTime, when * 1e-3);
  }
}

TEST_F(Protocol, AnArrivalBeforeTheWindowIsTooShortAtOnce) {
  leave();
  ticks(798);
  arrive();
  tick();
  expectEnd(Outcome::Failure, Reason::TimeShort);
  EXPECT_EQ(state.result.mass, 0);
  EXPECT_NEAR(state.result.by, 0.001, 1e-12) << "one tick before T - dT; rounding of 0.8 - 0.799";
}

TEST_F(Protocol, OneMassOutsideIsNoArrival) {
  leave();
  ticks(900);
  arrive();
  masses[1].r.y = 1.001 * settings.positionTolerance;
  ticks(10);
  EXPECT_EQ(state.phase, Phase::Moving);
  masses[1].r.y = 0;
  masses[0].v.z = 1.001 * settings.velocityTolerance;
  ticks(10);
  EXPECT_EQ(state.phase, Phase::Moving);
  masses[0].v.z = settings.velocityTolerance;
  tick();
  expectEnd(Outcome::Success, Reason::None);
}

TEST_F(Protocol, MassesInsideAtDifferentTimesAreNoArrival) {
  leave();
  ticks(900);
  arrive();
  masses[0].r.x -= 0.02;
  tick();
  masses[0].r.x += 0.02;
  masses[1].r.x -= 0.02;
  tick();
  EXPECT_EQ(state.phase, Phase::Moving);
}

TEST_F(Protocol, TheDeadlineBlamesPositionWithTheWorstMass) {
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
}

TEST_F(Protocol, TheDeadlineBlamesVelocityWhenAllAreAtTheTarget) {
  leave();
  arrive(0.005, 0.019);
  masses[0].v.y = 0.04;
  ticks(1200);
  expectEnd(Outcome::Failure, Reason::Velocity);
  EXPECT_EQ(state.result.mass, 1);
  EXPECT_NEAR(state.result.by, std::hypot(0.019, 0.04) - 0.02, 1e-12) << "rounding of the norm";
}

TEST_F(Protocol, AMassThatIsNotANumberNeverArrives) {
  leave();
  arrive();
  masses[1].r.x = std::numeric_limits<double>::quiet_NaN();
  ticks(1200);
  expectEnd(Outcome::Failure, Reason::Position);
  EXPECT_EQ(state.result.mass, 2);
}

TEST_F(Protocol, TheSemaphoreFollowsTheWindow) {
  leave();
  EXPECT_EQ(state.semaphore, Semaphore::Neutral);
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

TEST_F(Protocol, ALostHandEndsTheTrialOnlyAfterTheGrace) {
  leave();
  handValid = false;
  ticks(kLostTicks);
  handValid = true;
  tick();
  handValid = false;
  ticks(kLostTicks);
  EXPECT_EQ(state.phase, Phase::Moving);
  tick();
  expectEnd(Outcome::Interrupted, Reason::DeviceLost);
}

TEST_F(Protocol, AHandThatIsNotANumberEndsTheTrialAtOnce) {
  leave();
  handBroken = true;
  tick();
  expectEnd(Outcome::Interrupted, Reason::DeviceLost);
}

TEST_F(Protocol, AFailedStepEndsTheTrial) {
  const std::pair<dynamics::StepStatus, std::pair<Outcome, Reason>> cases[] = {
      {dynamics::StepStatus::NotFinite, {Outcome::Aborted, Reason::Computation}},
      {dynamics::StepStatus::Capped, {Outcome::Aborted, Reason::Computation}},
      {dynamics::StepStatus::NoContinuation, {Outcome::Aborted, Reason::Computation}},
      {dynamics::StepStatus::AtEnd, {Outcome::Failure, Reason::EndOfConstraint}}};
  for (const auto& [fault, end] : cases) {
    state = {};
    status = dynamics::StepStatus::Ok;
    hip = settings.start;
    leave();
    status = fault;
    tick();
    expectEnd(end.first, end.second);
  }
}

TEST_F(Protocol, AClampEndsTheTrialOnlyIfTheExperimentSaysSo) {
  leave();
  clamped = true;
  tick();
  EXPECT_EQ(state.phase, Phase::Moving);
  settings.forceLimitEndsTrial = true;
  tick();
  expectEnd(Outcome::Failure, Reason::ForceLimit);
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

TEST_F(Protocol, AForeperiodDelaysTheGoSignal) {
  planned.foreperiodTicks = 300;
  arm();
  ticks(299);
  EXPECT_FALSE(state.gone);
  tick();
  EXPECT_TRUE(state.gone);
  hip.x += 0.01;
  tick();
  EXPECT_EQ(state.phase, Phase::Moving);
}

TEST_F(Protocol, MovingBeforeTheGoSignalIsAFalseStart) {
  planned.foreperiodTicks = 300;
  arm();
  ticks(200);
  hip.x += 0.01;
  tick();
  expectEnd(Outcome::Failure, Reason::Early);
  EXPECT_EQ(state.result.onsetTick, now);
}

TEST_F(Protocol, ACatchTrialIsWonByNotMoving) {
  planned.catchTrial = true;
  planned.foreperiodTicks = 100;
  arm();
  ticks(1299);
  EXPECT_EQ(state.phase, Phase::Armed);
  EXPECT_FALSE(state.gone);
  tick();
  expectEnd(Outcome::Success, Reason::None);
}

TEST_F(Protocol, ACatchTrialIsLostByMoving) {
  planned.catchTrial = true;
  arm();
  hip.y += 0.01;
  tick();
  expectEnd(Outcome::Failure, Reason::Early);
}

TEST_F(Protocol, TheNextTrialForgetsTheLast) {
  leave();
  tick(Command::Abort);
  tick(Command::NextTrial);
  EXPECT_EQ(state.result.outcome, Outcome::None);
  EXPECT_EQ(state.phase, Phase::Waiting);
  EXPECT_EQ(state.trial, 2);
}

// 1.35 s and 0.5 s have no exact binary form; the window's ends are whole ticks all the same.
TEST(ProtocolSettings, WindowInTicksIsExactForDecimalTimes) {
  experiment::Experiment experiment;
  experiment.task = experiment::Task{};
  experiment.task->start = {0};
  experiment.task->target = {6.283185307179586};
  const constraints::Constraint line = constraints::makeConstraint({"line", {}, {}, {{"length_m", 0.2}}});
  const double cases[][2] = {{1.35, 0.5}, {2.26, 0.5}, {0.68, 0.5}, {2.5, 0.3}, {0.1, 0.07}};
  for (const auto& [duration, tolerance] : cases) {
    experiment.task->duration = duration;
    experiment.task->tolerance.time = tolerance;
    const ProtocolSettings s = makeProtocolSettings(experiment, line);
    EXPECT_EQ(s.earliestTick, std::llround(1000 * (duration - tolerance)));
    EXPECT_EQ(s.latestTick, std::llround(1000 * (duration + tolerance)));
  }
  const ProtocolSettings s = makeProtocolSettings(experiment, line);
  EXPECT_NEAR(s.start.x, -0.1, 1e-15);
  EXPECT_NEAR(s.target.x, 0.1, 1e-15);
}

TEST(ProtocolSettings, RefusesAnExperimentWithoutATask) {
  EXPECT_THROW(makeProtocolSettings(experiment::Experiment{}, constraints::Constraint{}), FaultError);
}

TEST_F(Protocol, AMovementThatMissedMoreTicksThanAllowedIsInterrupted) {
  settings.maxMissedTicks = 5;
  leave();
  for (int i = 0; i < 5; ++i) {
    missed = 1;
    tick();
    ticks(10);
  }
  EXPECT_EQ(state.phase, Phase::Moving) << "five are allowed";
  missed = 1;
  tick();
  expectEnd(Outcome::Interrupted, Reason::Timing);
  EXPECT_EQ(state.result.movementTime, 0.056) << "of 1 ms ticks, as everywhere";
}

TEST_F(Protocol, OneGapThatIsTooLongInterruptsTheMovement) {
  settings.maxGapTicks = 20;
  leave();
  missed = 19;  // 20 ms between two ticks
  tick();
  EXPECT_EQ(state.phase, Phase::Moving);
  missed = 20;
  tick();
  expectEnd(Outcome::Interrupted, Reason::Timing);
}

TEST_F(Protocol, WhatIsMissedBeforeTheMovementOrInTheTrialBeforeDoesNotCount) {
  settings.maxMissedTicks = 5;
  settings.maxGapTicks = 20;
  arm();
  missed = 300;
  tick();
  EXPECT_EQ(state.phase, Phase::Armed);
  hip.x += 0.05;
  tick();
  missed = 5;
  tick();
  EXPECT_EQ(state.phase, Phase::Moving);
  tick(Command::Abort);
  hip = settings.start;
  leave();
  missed = 5;
  tick();
  EXPECT_EQ(state.phase, Phase::Moving);
}

TEST_F(Protocol, AMovementThatBeginsInAGapHasMissedIt) {
  settings.maxMissedTicks = 5;
  for (const int gap : {5, 6}) {
    arm();
    hip.x += 0.05;
    missed = static_cast<std::uint32_t>(gap);
    tick();
    if (gap == 5) {
      EXPECT_EQ(state.phase, Phase::Moving);
      missed = 1;
      tick();
    }
    expectEnd(Outcome::Interrupted, Reason::Timing);
    hip = settings.start;
  }
}

TEST_F(Protocol, ASuccessAtATickThatCameTooLateIsNone) {
  settings.maxMissedTicks = 5;
  leave();
  ticks(999);
  arrive();
  missed = 6;
  tick();
  expectEnd(Outcome::Interrupted, Reason::Timing);
}

TEST_F(Protocol, OnlyAHandWithoutAPersonHasToBeAtTheStartInTime) {
  hip.x += 0.05;
  tick(Command::NextTrial);
  ticks(100'000);
  EXPECT_EQ(state.phase, Phase::Waiting) << "a person may take any time";
  tick(Command::Abort);
  settings.startTimeoutTicks = 5000;
  tick(Command::NextTrial);
  ticks(4999);
  EXPECT_EQ(state.phase, Phase::Waiting);
  tick();
  expectEnd(Outcome::Aborted, Reason::NoStart);
}

TEST(TrialResult, TheRunEndsWithWhatSomebodyBrokeOffAndGoesOnAfterWhatTheComputerSpoilt) {
  const auto result = [](Outcome outcome, Reason reason) {
    TrialResult r;
    r.outcome = outcome;
    r.reason = reason;
    return r;
  };
  const TrialResult person = result(Outcome::Interrupted, Reason::Experimenter), program = result(Outcome::Interrupted, Reason::Program);
  const TrialResult timing = result(Outcome::Interrupted, Reason::Timing), lost = result(Outcome::Interrupted, Reason::DeviceLost);
  const TrialResult aborted = result(Outcome::Aborted, Reason::Experimenter), failed = result(Outcome::Failure, Reason::Position);
  for (const TrialResult& r : {person, program}) EXPECT_TRUE(endsRun(r) && !isPutUpAgain(r));
  for (const TrialResult& r : {timing, lost, aborted}) EXPECT_TRUE(!endsRun(r) && isPutUpAgain(r));
  for (const TrialResult& r : {failed, result(Outcome::Success, Reason::None)}) EXPECT_TRUE(!endsRun(r) && !isPutUpAgain(r));
}

}  // namespace
}  // namespace reachlab::trial
