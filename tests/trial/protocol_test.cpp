#include "sim/trial/protocol.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "base/fault.h"
#include "sim/experiment/experiment.h"

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
    in.otherHips = others;
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
  ProtocolState state;
  PlannedTrial planned;
  std::vector<dynamics::MassState> masses{2};
  Vec3 hip;
  std::vector<Vec3> others;  // of the second hand on
  double speed = 0;          // [m/s] of the hand, as estimated
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

TEST_F(Protocol, BoundsAreReachedWhenTheyAreMet) {
  settings.start = settings.target = {};
  settings.armRadius = 0.125, settings.onset = 0.25, settings.positionTolerance = 0.5, settings.velocityTolerance = 0.25;
  settings.restSpeed = 0.0625;
  for (dynamics::MassState& m : masses) m.r = {2, 0, 0};
  hip = {0, 0.125, 0};
  speed = 0.0625;
  arm();
  EXPECT_EQ(state.phase, Phase::Armed) << "on the circle around the start, at the speed that is allowed";
  hip.y += 0.25;
  tick();
  EXPECT_EQ(state.phase, Phase::Armed) << "the onset must be passed";
  hip.y += 0.0625;
  tick();
  EXPECT_EQ(state.phase, Phase::Moving);
  ticks(799);
  for (dynamics::MassState& m : masses) m.r = {0.5, 0, 0}, m.v = {0, 0, -0.25};
  tick();
  expectEnd(Outcome::Success, Reason::None);
}

// Each hand at the start; the one that moves first makes the onset, wherever it was at arming.
TEST_F(Protocol, SeveralHandsAreEachAtTheStartAndTheFirstToMoveMoves) {
  others = {settings.start, settings.start + Vec3{0, 1.01 * settings.armRadius, 0}};
  arm();
  EXPECT_EQ(state.phase, Phase::Waiting) << "the third is not at the start";
  others[1].y -= 0.02 * settings.armRadius;
  tick();
  EXPECT_EQ(state.phase, Phase::Armed);
  ticks(10);
  EXPECT_EQ(state.phase, Phase::Armed);
  others[1].y -= 1.01 * settings.onset;
  tick();
  EXPECT_EQ(state.phase, Phase::Moving);
}

TEST_F(Protocol, ALostHandDoesNotMove) {
  arm();
  handValid = false;
  hip.x += 0.05;
  tick();
  EXPECT_EQ(state.phase, Phase::Armed);
}

TEST_F(Protocol, TheTimeoutRunsFromTheGoSignal) {
  settings.timeoutTicks = 50;
  planned.foreperiodTicks = 300;
  arm();
  ticks(349);
  EXPECT_EQ(state.phase, Phase::Armed);
  tick();
  expectEnd(Outcome::Aborted, Reason::NoOnset);
  planned.foreperiodTicks = -100;  // none
  arm();
  EXPECT_TRUE(state.gone);
  ticks(49);
  EXPECT_EQ(state.phase, Phase::Armed);
  tick();
  expectEnd(Outcome::Aborted, Reason::NoOnset);
  planned.foreperiodTicks = 1;
  arm();
  EXPECT_FALSE(state.gone);
  tick();
  EXPECT_TRUE(state.gone);
}

TEST_F(Protocol, ATrialThatEndsBeforeItsMovementHasNoTimeAndNoOnset) {
  leave();
  tick(Command::Abort);
  EXPECT_DOUBLE_EQ(state.result.movementTime, 0.001);
  EXPECT_EQ(state.result.onsetTick, now - 1);
  hip = settings.start;
  arm();
  ticks(5);
  tick(Command::Abort);
  EXPECT_EQ(state.result.movementTime, 0);
  EXPECT_EQ(state.result.onsetTick, 0u);
  EXPECT_EQ(state.result.mass, 0);
  EXPECT_EQ(state.result.by, 0);
}

TEST_F(Protocol, ASuccessIsGreenAtItsFirstTick) {
  leave();
  ticks(799);
  arrive();
  tick();
  expectEnd(Outcome::Success, Reason::None);
  EXPECT_EQ(state.semaphore, Semaphore::Green);
}

TEST_F(Protocol, AnArrivalTooSoonSaysByHowMuch) {
  leave();
  ticks(549);
  arrive();
  tick();
  expectEnd(Outcome::Failure, Reason::TimeShort);
  EXPECT_NEAR(state.result.by, 0.25, 1e-12);
  EXPECT_EQ(state.semaphore, Semaphore::Neutral);
}

TEST_F(Protocol, OfEqualExcessesTheFirstMassIsToBlame) {
  leave();
  settings.target = {};
  masses[0].r = {0.25, 0, 0}, masses[1].r = {0, 0.25, 0};
  ticks(1200);
  expectEnd(Outcome::Failure, Reason::Position);
  EXPECT_EQ(state.result.mass, 1);
}

TEST_F(Protocol, WhatHappensToTheObjectEndsATrialOnlyWhileForcesAct) {
  tick(Command::NextTrial);
  hip.x += 0.05;
  status = dynamics::StepStatus::NotFinite;
  clamped = settings.forceLimitEndsTrial = true;
  tick();
  EXPECT_EQ(state.phase, Phase::Waiting);
  status = dynamics::StepStatus::HandLost;
  clamped = false;
  hip = settings.start;
  tick();
  hip.x += 0.05;
  tick();
  EXPECT_EQ(state.phase, Phase::Moving) << "a hand that is lost for a tick has a grace of its own";
  status = dynamics::StepStatus::PeerLost;
  tick();
  expectEnd(Outcome::Interrupted, Reason::PeerLost);
}

TEST_F(Protocol, ALostHandEndsAWaitToo) {
  tick(Command::NextTrial);
  handValid = false;
  ticks(20);
  EXPECT_EQ(state.phase, Phase::Waiting);
  tick();
  expectEnd(Outcome::Interrupted, Reason::DeviceLost);
}

// A false start at a tick that came too late is the machine's fault, not the subject's.
TEST_F(Protocol, AFalseStartInAGapIsTheGaps) {
  settings.maxMissedTicks = 5;
  planned.foreperiodTicks = 300;
  arm();
  hip.x += 0.05;
  missed = 6;
  tick();
  expectEnd(Outcome::Interrupted, Reason::Timing);
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
  EXPECT_EQ(kLostTicks, 20);
}

TEST(ProtocolSettings, AsTheyBeginLimitNothing) {
  const ProtocolSettings s;
  EXPECT_TRUE(s.armRadius == 0.01 && s.onset == 0.001 && s.restTicks == 0 && s.restSpeed == 1000);
  EXPECT_TRUE(s.positionTolerance == 0 && s.velocityTolerance == 0 && s.earliest == 0 && s.earliestTick == 0 && s.latestTick == 0);
  EXPECT_TRUE(s.timeoutTicks == 0 && s.startTimeoutTicks == kNoLimit && s.maxMissedTicks == kNoLimit && s.maxGapTicks == kNoLimit);
  EXPECT_FALSE(s.forceLimitEndsTrial);
  const ProtocolInput in;
  EXPECT_TRUE(in.tick == 0 && in.command == Command::None && in.hipSpeed == 0 && in.handValid && !in.handBroken && !in.clamped);
  EXPECT_TRUE(in.status == dynamics::StepStatus::Ok && in.missedTicks == 0 && in.planned.index == 0 && in.planned.foreperiodTicks == 0);
  EXPECT_FALSE(in.planned.catchTrial);
  const ProtocolState state;
  EXPECT_TRUE(state.phase == Phase::Idle && state.semaphore == Semaphore::Neutral && state.trial == 0 && !state.gone);
  EXPECT_TRUE(state.putUpTick == 0 && state.armedTick == 0 && state.onsetTick == 0 && state.restTicks == 0 && state.lostTicks == 0);
  EXPECT_TRUE(state.missedTicks == 0 && state.result.outcome == Outcome::None && state.result.reason == Reason::None);
  EXPECT_TRUE(state.result.mass == 0 && state.result.by == 0 && state.result.movementTime == 0);
  EXPECT_TRUE(state.result.onsetTick == 0 && state.result.endTick == 0);
}

TEST(ProtocolSettings, AreTheTasksInTicks) {
  experiment::Experiment experiment;
  experiment.task = experiment::Task{};
  experiment::Task& task = *experiment.task;
  task.start = {0}, task.target = {3.141592653589793};
  task.armRadius = 0.015, task.onset = 0.002, task.rest = {0.25, 0.03};
  task.tolerance = {0.011, 0.013, 0.25};
  task.duration = 1.5, task.timeout = 7;
  experiment.timing = {4, 0.0305};
  experiment.forceLimitEndsTrial = true;
  const constraints::Constraint line = constraints::makeConstraint({"line", {}, {}, {{"length_m", 0.2}}});
  const ProtocolSettings s = makeProtocolSettings(experiment, line);
  EXPECT_TRUE(s.armRadius == 0.015 && s.onset == 0.002 && s.restTicks == 250 && s.restSpeed == 0.03);
  EXPECT_TRUE(s.positionTolerance == 0.011 && s.velocityTolerance == 0.013);
  EXPECT_TRUE(s.earliest == 1.25 && s.earliestTick == 1250 && s.latestTick == 1750 && s.timeoutTicks == 7000);
  EXPECT_TRUE(s.maxMissedTicks == 4 && s.maxGapTicks == 30 && s.forceLimitEndsTrial && s.startTimeoutTicks == kNoLimit);
  EXPECT_NEAR(s.target.x, 0, 1e-15);
  task.duration = 1.4996, task.tolerance.time = 0.2499;  // 1249.7 to 1749.5 ticks: the whole ones inside
  EXPECT_EQ(makeProtocolSettings(experiment, line).earliestTick, 1250);
  EXPECT_EQ(makeProtocolSettings(experiment, line).latestTick, 1749);
}

TEST(ProtocolSettings, RefuseAPlaceWhereTheFormulaHasNoValue) {
  experiment::Experiment experiment;
  experiment.task = experiment::Task{};
  constraints::ConstraintSpec spec;
  spec.name.clear();
  spec.curve = {"phi", "sqrt(phi)", "0"};
  const auto refusal = [&](double start, double target) -> std::string {
    experiment.task->start = {start}, experiment.task->target = {target};
    try {
      makeProtocolSettings(experiment, constraints::makeConstraint(spec));
    } catch (const FaultError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(refusal(-1, 1).find("task.start"), std::string::npos);
  EXPECT_NE(refusal(1, -1).find("task.target"), std::string::npos);
  EXPECT_EQ(refusal(0.5, 1), "");
}

TEST(TrialResult, HasNamesThatFilesKnow) {
  const std::string_view outcomes[] = {"none", "success", "failure", "aborted", "interrupted"};
  for (int i = 0; i < 5; ++i) EXPECT_EQ(nameOf(static_cast<Outcome>(i)), outcomes[i]);
  const std::string_view reasons[] = {"none",        "position", "velocity",     "time_short",        "time_long",   "force_limit",
                                      "device_lost", "no_onset", "experimenter", "end_of_constraint", "computation", "program",
                                      "early",       "timing",   "no_start",     "peer_lost"};
  for (int i = 0; i < 16; ++i) EXPECT_EQ(nameOf(static_cast<Reason>(i)), reasons[i]);
  EXPECT_EQ(kLastReason, static_cast<Reason>(15));
  EXPECT_EQ(nameOf(static_cast<Outcome>(99)), "none");
  EXPECT_EQ(nameOf(static_cast<Reason>(99)), "none");
}

}  // namespace
}  // namespace reachlab::trial
