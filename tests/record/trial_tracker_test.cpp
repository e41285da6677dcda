#include "sim/record/log/trial_tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "sim/record/log/trial_measures.h"

namespace reachlab::record {
namespace {

using trial::Phase;

constexpr std::int64_t kPeriodNs = 1'000'300;  // of a clock that is a little slow

// A run that is made tick by tick; what is set stays until it is changed, but for the missed ticks.
struct Made {
  explicit Made(int firstTrial = 1) : tracker(firstTrial) {}
  TrialTracker::Step next() {
    tick.measuredNs = static_cast<std::int64_t>(tick.tick) * kPeriodNs;
    const TrialTracker::Step step = tracker.add(tick, facts, events);
    ++tick.tick;
    tick.missedTicks = 0;
    return step;
  }
  // To this tick, which is not yet given.
  void until(std::uint64_t end) {
    while (tick.tick < end) next();
  }
  void put(Phase phase, std::int32_t trial = 1) { facts.phase = phase, facts.trial = trial; }
  std::vector<RecordedEvent> of(EventKind kind) const {
    std::vector<RecordedEvent> found;
    for (const RecordedEvent& event : events)
      if (event.kind == kind) found.push_back(event);
    return found;
  }

  TrialTracker tracker;
  TickStamp tick;
  TickFacts facts;
  std::vector<RecordedEvent> events;
};

// Each as "tick kind trial value text".
std::string toldOf(const std::vector<RecordedEvent>& events) {
  std::ostringstream told;
  for (const RecordedEvent& e : events)
    told << (told.tellp() > 0 ? "; " : "") << e.tick << ' ' << nameOf(e.kind) << ' ' << e.trial << ' ' << e.value
         << (e.text.empty() ? "" : " ") << e.text;
  return told.str();
}

TEST(TrialTracker, FollowsATrialFromWhereItIsPutUpToItsEnd) {
  Made run(4);
  run.tracker.announce({4, {2, 30, false}});
  run.until(100);
  EXPECT_EQ(run.tracker.trial().trial, 0) << "before the first";
  EXPECT_FALSE(run.tracker.underWay());
  run.put(Phase::Waiting);
  run.facts.couplingForce = {100, 0, 0};  // not of the movement
  run.facts.hip.velocity = {9, 0, 0};
  TrialTracker::Step step = run.next();
  EXPECT_TRUE(step.started);
  EXPECT_FALSE(step.finished);
  EXPECT_TRUE(run.tracker.underWay());
  EXPECT_FALSE(run.next().started);
  run.until(110);
  run.put(Phase::Armed);
  run.until(190);
  run.put(Phase::Moving);
  double forces = 0;
  for (int k = 0; k <= 10; ++k) {  // a hand that sets off 5 m away, and forces of 3-4-5 triangles
    run.facts.hip.position = {5, 0.01 * k * k, 0};
    run.facts.hip.velocity = {0, 0.3 - 0.01 * std::abs(k - 4), 0.4};
    const double size = 1 + std::abs(k - 7);
    run.facts.couplingForce = {0.6 * size, 0, -0.8 * size};
    forces += size;
    if (k == 10) {
      run.facts.phase = Phase::Done;
      run.facts.result = {trial::Outcome::Failure, trial::Reason::TimeShort, 3, 0.5, 0.01, 190, 200};
    }
    step = run.next();
  }
  EXPECT_TRUE(step.finished);
  EXPECT_FALSE(run.tracker.underWay());
  const RecordedTrial& t = run.tracker.trial();
  EXPECT_EQ(t.trial, 4);
  EXPECT_EQ(t.planned.index, 2);
  EXPECT_EQ(t.planned.foreperiodTicks, 30);
  EXPECT_EQ(t.startTick, 100u);
  EXPECT_EQ(t.armedTick, 110u);
  EXPECT_EQ(t.goTick, 140u);
  EXPECT_EQ(t.lastTick, 200u);
  EXPECT_EQ(t.result.reason, trial::Reason::TimeShort);
  EXPECT_EQ(t.result.mass, 3);
  EXPECT_NEAR(t.handPathLength, 1.0, 1e-12);
  EXPECT_DOUBLE_EQ(t.peakHandSpeed, 0.5);
  EXPECT_NEAR(t.peakForce, 8, 1e-12);
  EXPECT_NEAR(t.meanForce, forces / 11, 1e-12);
  EXPECT_NEAR(t.elapsed, 60 * 1.0003e-3, 1e-12) << "from the go signal by the computer's clock";
  EXPECT_TRUE(t.complete);
  EXPECT_EQ(t.droppedTicks + t.missedTicks + t.clampedTicks, 0u);
  EXPECT_EQ(toldOf(run.events), "100 trial_start 4 2; 110 armed 4 0; 140 go 4 0; 190 onset 4 0; 200 trial_end 4 2");
  run.until(260);
  EXPECT_EQ(run.tracker.trial().lastTick, 200u) << "what comes after the end is not of the trial";
  EXPECT_EQ(run.events.size(), 5u);
}

TEST(TrialTracker, NothingOfATrialIsInTheNext) {
  Made run;
  run.put(Phase::Moving);
  run.facts.couplingForce = {50, 0, 0};
  run.facts.hip.velocity = {7, 0, 0};
  run.facts.clamped = true;
  run.until(20);
  run.tick.tick += 5;
  run.facts.phase = Phase::Done;
  run.facts.result.onsetTick = 3;
  run.next();
  EXPECT_EQ(run.tracker.trial().peakForce, 50);
  run.facts = {};
  run.put(Phase::Moving, 2);
  run.facts.couplingForce = {0, 2, 0};
  run.facts.hip.position = {1, 1, 1};
  for (int k = 0; k < 4; ++k) {
    run.next();
    run.facts.couplingForce.y += 2;
  }
  const RecordedTrial t = run.tracker.brokenOff();
  EXPECT_EQ(t.trial, 2);
  EXPECT_EQ(t.startTick, 26u);
  EXPECT_EQ(t.result.onsetTick, 26u) << "of its own movement";
  EXPECT_EQ(t.peakHandSpeed, 0);
  EXPECT_EQ(t.handPathLength, 0) << "not from where the last one ended";
  EXPECT_EQ(t.peakForce, 8);
  EXPECT_EQ(t.meanForce, 5);
  EXPECT_EQ(t.clampedTicks, 0u);
  EXPECT_EQ(t.droppedTicks, 0u);
  EXPECT_EQ(t.armedTick, 0u);
  EXPECT_EQ(run.of(EventKind::Onset).size(), 2u);
}

TEST(TrialTracker, AHandThatNeverSetOffHasNoMeasures) {
  Made run;
  run.put(Phase::Armed);
  run.facts.couplingForce = {50, 0, 0};
  run.facts.hip.velocity = {7, 0, 0};
  run.until(30);
  run.facts.phase = Phase::Done;
  run.facts.result = {trial::Outcome::Aborted, trial::Reason::NoOnset, 0, 0, 0, 0, 30};
  run.next();
  const RecordedTrial& t = run.tracker.trial();
  EXPECT_EQ(t.peakHandSpeed + t.peakForce + t.meanForce + t.handPathLength, 0);
  EXPECT_TRUE(run.of(EventKind::Onset).empty());
}

TEST(TrialTracker, TheEndIsMeasuredWhereTheMovementCountsAsOne) {
  for (const bool moved : {false, true}) {
    Made run;
    run.tick.tick = 1;
    run.put(Phase::Moving);
    run.until(21);
    run.facts.phase = Phase::Done;
    run.facts.couplingForce = {21, 0, 0};
    run.facts.result.onsetTick = moved ? 1 : 0;
    run.next();
    EXPECT_EQ(run.tracker.trial().peakForce, moved ? 21 : 0);
    if (!moved) continue;
    EXPECT_NEAR(run.tracker.trial().meanForce, 1, 1e-12) << "21 ticks, of which 20 without a force";
  }
}

TEST(TrialTracker, TheGoSignalComesAForeperiodAfterTheArming) {
  struct Case {
    int foreperiod;
    std::uint64_t go;
  };
  for (const auto& [foreperiod, go] : {Case{0, 50}, Case{1, 51}, Case{25, 75}, Case{-7, 50}}) {
    SCOPED_TRACE(foreperiod);
    Made run;
    run.tracker.announce({1, {0, foreperiod, false}});
    run.put(Phase::Waiting);
    run.until(50);
    run.put(Phase::Armed);
    run.until(60);
    run.put(Phase::Moving);  // also where the hand moves before it
    run.until(100);
    EXPECT_EQ(run.tracker.trial().goTick, go);
    ASSERT_EQ(run.of(EventKind::Go).size(), 1u);
    EXPECT_EQ(run.of(EventKind::Go)[0].tick, go);
  }
}

TEST(TrialTracker, ATrialMayBeArmedWithTheFirstTicksOfARun) {
  Made run;
  run.tick.tick = 1;
  run.put(Phase::Armed);
  run.next();
  EXPECT_EQ(run.tracker.trial().goTick, 1u);
}

TEST(TrialTracker, ACatchTrialHasNoGoSignalAndNoElapsedTime) {
  Made run;
  run.tracker.announce({1, {0, 5, true}});
  run.tick.tick = 10;
  run.put(Phase::Armed);
  run.until(100);
  run.put(Phase::Done);
  run.next();
  EXPECT_EQ(run.tracker.trial().goTick, 0u);
  EXPECT_TRUE(std::isnan(run.tracker.trial().elapsed));
  EXPECT_TRUE(run.of(EventKind::Go).empty());
}

TEST(TrialTracker, AHandThatLeavesTheStartIsArmedAnew) {
  Made run;
  run.tracker.announce({1, {0, 40, false}});
  run.tick.tick = 10;
  run.put(Phase::Armed);
  run.until(30);
  run.put(Phase::Waiting);
  run.until(60);
  EXPECT_EQ(run.tracker.trial().goTick, 0u) << "none while it is away";
  run.put(Phase::Armed);
  run.until(200);
  EXPECT_EQ(run.tracker.trial().armedTick, 60u);
  EXPECT_EQ(run.tracker.trial().goTick, 100u);
  EXPECT_EQ(run.of(EventKind::Armed).size(), 2u);
}

TEST(TrialTracker, OfSeveralAnnouncementsTheLastOfTheTrialsNumberCounts) {
  Made run;
  for (const TrialSetup& setup : {TrialSetup{1, {5, 0, false}}, {1, {6, 0, false}}, {2, {7, 0, false}}}) run.tracker.announce(setup);
  run.put(Phase::Waiting);
  run.next();
  EXPECT_EQ(run.tracker.trial().planned.index, 6);
  run.put(Phase::Waiting, 2);
  run.next();
  EXPECT_EQ(run.tracker.trial().planned.index, 1) << "forgotten: what was announced is of the next trial alone";
}

TEST(TrialTracker, NoTrialBeginsInIdleOrWithoutANumber) {
  Made run(3);
  run.put(Phase::Idle, 1);
  EXPECT_FALSE(run.next().started);
  run.put(Phase::Waiting, 0);
  run.tick.missedTicks = 2;
  EXPECT_FALSE(run.next().started);
  EXPECT_FALSE(run.tracker.underWay());
  EXPECT_EQ(toldOf(run.events), "1 ticks_missed 0 2") << "of no trial";
}

TEST(TrialTracker, CountsDroppedMissedAndClampedTicks) {
  Made run;
  run.put(Phase::Waiting);
  run.until(10);
  run.tick.tick = 14;  // 10 to 13 are not there
  run.tick.missedTicks = 3;
  run.next();
  run.facts.clamped = true;
  run.until(20);
  run.tick.missedTicks = 4;
  run.next();
  run.facts.clamped = false;
  run.until(30);
  const RecordedTrial& t = run.tracker.trial();
  EXPECT_EQ(t.droppedTicks, 4u);
  EXPECT_EQ(t.missedTicks, 7u);
  EXPECT_EQ(t.clampedTicks, 6u);
  EXPECT_EQ(t.lastTick, 29u);
  EXPECT_EQ(toldOf(run.events), "0 trial_start 1 0; 14 ticks_missed 1 3; 15 clamp_begin 1 0; 20 ticks_missed 1 4; 21 clamp_end 1 0");
}

TEST(TrialTracker, TellsWhenTheDeviceIsLostAndBack) {
  Made run;
  run.until(3);
  run.facts.deviceValid = false;
  run.until(6);
  run.facts.deviceValid = true;
  run.until(9);
  EXPECT_EQ(toldOf(run.events), "3 device_lost 0 0; 6 device_back 0 0");
}

TEST(TrialTracker, TellsEachWayInWhichAStepDidNotEndWellWhereItBegins) {
  using dynamics::StepStatus;
  const auto number = [](StepStatus status) { return std::to_string(static_cast<int>(status)); };
  Made run;
  for (const StepStatus status : {StepStatus::Ok, StepStatus::Capped, StepStatus::Capped, StepStatus::NotFinite, StepStatus::Ok,
                                  StepStatus::Ok, StepStatus::Capped}) {
    run.facts.status = status;
    run.next();
  }
  EXPECT_EQ(toldOf(run.events), std::string("1 step_fault 0 ") + number(StepStatus::Capped) + "; 3 step_fault 0 " +
                                    number(StepStatus::NotFinite) + "; 6 step_fault 0 " + number(StepStatus::Capped));
}

// An intervention has ended when it has been away for 100 ticks.
TEST(TrialTracker, AnInterventionThatComesAndGoesIsOne) {
  Made run;
  run.tick.tick = 1;
  const auto at = [&](std::uint64_t tick, std::uint8_t bits) {
    run.until(tick);
    run.facts.interventions = bits;
  };
  at(10, haptics::intervention::kHeat);
  at(20, haptics::intervention::kHeat | haptics::intervention::kHeldBack);
  at(30, 0);  // both last set at 29
  at(129, haptics::intervention::kHeldBack);
  at(130, 0);
  run.until(500);
  EXPECT_EQ(toldOf(run.events),
            "10 intervention 0 1 heat; 20 intervention 0 1 held_back; 130 intervention 0 0 heat; 230 intervention 0 0 held_back");
  at(600, haptics::intervention::kHeat);
  at(602, 0);
  run.until(604);
  EXPECT_EQ(toldOf(std::vector<RecordedEvent>{run.events.back()}), "600 intervention 0 1 heat") << "and begins again";
}

TEST(TrialTracker, ATrialThatBreaksOffIsInterruptedByTheProgramWhereItStands) {
  Made run(2);
  run.tick.tick = 100;
  run.put(Phase::Armed);
  run.until(150);
  RecordedTrial t = run.tracker.brokenOff();
  EXPECT_EQ(t.trial, 2);
  EXPECT_EQ(t.result.outcome, trial::Outcome::Interrupted);
  EXPECT_EQ(t.result.reason, trial::Reason::Program);
  EXPECT_EQ(t.result.onsetTick, 0u);
  EXPECT_EQ(t.result.endTick, 149u);
  EXPECT_EQ(t.result.movementTime, 0) << "there was no movement";
  EXPECT_FALSE(t.complete);
  run.put(Phase::Moving);
  run.until(400);
  t = run.tracker.brokenOff();
  EXPECT_EQ(t.result.onsetTick, 150u);
  EXPECT_EQ(t.result.endTick, 399u);
  EXPECT_EQ(t.result.movementTime, 0.249);
  EXPECT_TRUE(run.tracker.underWay());
  EXPECT_TRUE(run.tracker.trial().complete) << "the trial itself goes on";
}

class Facts : public testing::Test {
 protected:
  std::unique_ptr<haptics::TickState> state_ = std::make_unique<haptics::TickState>();  // large
};

TEST_F(Facts, AreThoseOfTheOnlyHand) {
  haptics::TickState& s = *state_;
  s.phase = Phase::Done;
  s.status = dynamics::StepStatus::AtEnd;
  s.trial = 6;
  s.hands[0].hip.position = {1, 2, 3};
  s.hands[0].couplingForce = {4, 5, 6};
  s.result.mass = 7;
  s.hands[0].deviceState = haptics::DeviceState::Engaged;
  s.hands[0].interventions = 5;
  s.hands[0].clamped = true;
  TickFacts facts = factsOf(s);
  EXPECT_EQ(facts.phase, Phase::Done);
  EXPECT_EQ(facts.status, dynamics::StepStatus::AtEnd);
  EXPECT_EQ(facts.trial, 6);
  EXPECT_EQ(facts.hip.position, (Vec3{1, 2, 3}));
  EXPECT_EQ(facts.couplingForce, (Vec3{4, 5, 6}));
  EXPECT_EQ(facts.result.mass, 7);
  EXPECT_TRUE(facts.clamped);
  EXPECT_EQ(facts.deviceState, haptics::DeviceState::Off) << "a device without force has no state";
  EXPECT_EQ(facts.interventions, 0);
  s.hands[0].rendersForce = true;
  s.hands[0].device.valid = false;
  s.hands[1].clamped = true;  // is not there
  facts = factsOf(s);
  EXPECT_FALSE(facts.clamped) << "a lost device is held back by nobody";
  EXPECT_EQ(facts.deviceState, haptics::DeviceState::Engaged);
  EXPECT_EQ(facts.interventions, 5);
}

TEST_F(Facts, OfSeveralHandsAreWhatActsOnAnyOfThem) {
  haptics::TickState& s = *state_;
  s.handCount = 3;
  s.hands[0].rendersForce = s.hands[2].rendersForce = true;
  s.hands[0].interventions = haptics::intervention::kLimit;
  s.hands[1].interventions = haptics::intervention::kRamp;  // renders no force
  s.hands[2].interventions = haptics::intervention::kWall;
  s.hands[0].deviceState = haptics::DeviceState::Homed;
  s.hands[1].deviceState = haptics::DeviceState::Fault;
  s.hands[2].deviceState = haptics::DeviceState::Armed;
  TickFacts facts = factsOf(s);
  EXPECT_FALSE(facts.clamped);
  EXPECT_EQ(facts.interventions, haptics::intervention::kLimit | haptics::intervention::kWall);
  EXPECT_EQ(facts.deviceState, haptics::DeviceState::Armed);
  s.hands[2].clamped = true;
  EXPECT_TRUE(factsOf(s).clamped);
  s.hands[2].device.valid = false;
  EXPECT_FALSE(factsOf(s).clamped);
  s.hands[0].clamped = true;
  EXPECT_TRUE(factsOf(s).clamped);
}

TEST(TrialTimes, AreSecondsSinceTheFirstSampleAndNoNumbersWhereSomethingNeverCame) {
  RecordedTrial t;
  t.lastTick = 4000;
  TrialTimes times = timesOf(t, 0);
  EXPECT_EQ(times.start, 0) << "a trial may start with the run";
  EXPECT_EQ(times.end, 4) << "where no end is known, its last tick";
  const auto reaction = [&] { return tickMeasure("task_reaction_time_s").of(t); };
  const auto movement = [&] { return tickMeasure("movement_time_s").of(t); };
  for (const double never : {times.armed, times.go, times.onset, reaction(), movement()}) EXPECT_TRUE(std::isnan(never));
  t.startTick = 250, t.armedTick = 500, t.goTick = 1250, t.result.onsetTick = 1500, t.result.endTick = 3000;
  t.result.movementTime = 1.4;
  times = timesOf(t, 10);
  EXPECT_EQ(times.start, 0.24);
  EXPECT_EQ(times.armed, 0.49);
  EXPECT_EQ(times.go, 1.24);
  EXPECT_EQ(times.onset, 1.49);
  EXPECT_EQ(times.end, 2.99);
  EXPECT_EQ(reaction(), 0.25);
  EXPECT_EQ(movement(), 1.4);
  t.result.onsetTick = 1200;
  EXPECT_EQ(reaction(), -0.05) << "off before the signal";
  t.goTick = 0;
  EXPECT_TRUE(std::isnan(reaction()));
  t.goTick = 1, t.result.onsetTick = 0;
  EXPECT_TRUE(std::isnan(reaction()));
}

}  // namespace
}  // namespace reachlab::record
