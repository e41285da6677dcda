#include "network/link_check/link_check.h"

#include <gtest/gtest.h>

#include "constraints/constraint.h"

#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"
#include "tests/refusal.h"

namespace reachlab::network {
namespace {

constexpr MeasuredLink kLan{0.0005, 0.0001, 0}, kFar{0.1, 0.003, 0.05};

TEST(LinkCheck, EveryShippedObjectComesToRestAsItIs) {
  const auto expectRest = [](const std::string& name, const MeasuredLink& link) {
    const experiment::Experiment e = experiment::readExperiment(name);
    const LinkCheck check = checkLink(e, link);
    EXPECT_TRUE(check.stable) << name << ": " << check.sentence;
    EXPECT_EQ(check.frequency, copySettingsFor(e).frequency) << name << ": " << check.sentence;
  };
  for (const std::string& name : experiment::shippedForTwoHands())
    for (const MeasuredLink& link : {kLan, MeasuredLink{0.05, 0.0015, 0.4}}) expectRest(name, link);
  for (const char* name : {"chain-two-hands", "parallel-two-hands"}) expectRest(name, kFar);
}

// Copies that are not drawn together let a chain ring up over 100 ms: the study's row of dead reckoning alone.
TEST(LinkCheck, SynchronisesMoreWhereTheMotionWouldGrow) {
  const experiment::Experiment e = experiment::readExperiment("chain-two-hands");
  CopySettings weak = copySettingsFor(e);
  weak.frequency = 0, weak.ledger = false;
  const LinkCheck check = checkLink(e, constraints::makeConstraint(e.constraint), kFar, weak);
  EXPECT_TRUE(check.stable) << check.sentence;
  EXPECT_GT(check.frequency, 0) << check.sentence;
  EXPECT_LT(check.frequency, 3) << check.sentence;
}

// A stiff rod of 1 kg: as far as the design's study of chains and parallel masses allows, it does not go.
TEST(LinkCheck, RefusesWithTheNumbersWhatNoSynchronisationHolds) {
  const LinkCheck check = checkLink(experiment::readExperiment("body-two-hands"), kFar);
  EXPECT_FALSE(check.stable) << check.sentence;
  EXPECT_TRUE(holds(check.sentence, "round trip 100.0 ms, jitter 3.0 ms, loss 5 %"));
  EXPECT_TRUE(holds(check.sentence, "does not come to rest"));
}

// A check may take several seconds, which is too long for who ends the program. The chain comes to rest as it is, and more could be tried.
TEST(LinkCheck, EndsAtOnceWhenItIsAskedToAndTriesNothingMore) {
  const experiment::Experiment e = experiment::readExperiment("chain-two-hands");
  std::stop_source ended;
  ended.request_stop();
  const LinkCheck check = checkLink(e, kLan, ended.get_token());
  EXPECT_FALSE(check.stable) << check.sentence;
  EXPECT_EQ(check.frequency, copySettingsFor(e).frequency) << "the first that is tried";
  EXPECT_TRUE(holds(check.sentence, "may come to rest or not: ended before it was known"));
}

// The hands are pushed along the way to the target, wherever in the room that is.
TEST(LinkCheck, IsTheSameForAnObjectThatStandsElsewhere) {
  const auto growthAt = [](const char* y) {
    experiment::Experiment e = experiment::readExperiment("chain-two-hands");
    e.constraint = {};
    e.constraint.curve = {"phi/10", y, "0"};
    e.task->start = {-1}, e.task->target = {1};
    return checkLink(e, kLan).growth;
  };
  EXPECT_GT(growthAt("0"), 0);
  EXPECT_NEAR(growthAt("0.5") / growthAt("0"), 1, 1e-6);
}

}  // namespace
}  // namespace reachlab::network
