#include "network/station/trial_words.h"

#include <gtest/gtest.h>

namespace reachlab::network {
namespace {

using trial::Outcome;
using trial::Reason;

LinkEvent word(std::uint32_t station, std::int32_t trial, Outcome outcome, Reason reason = Reason::None) {
  LinkEvent event;
  event.station = station, event.kind = LinkEvent::Kind::Ended, event.trial = trial, event.outcome = outcome, event.reason = reason;
  return event;
}
bool second(std::uint32_t station) { return station == 2; }

TEST(TrialWords, TheConductorsOutcomeHoldsForAll) {
  TrialWords words;
  EXPECT_FALSE(words.verdictOn(1, second));
  words.add(word(1, 1, Outcome::Failure, Reason::Velocity));
  EXPECT_FALSE(words.verdictOn(1, second)) << "the conductor has said nothing yet";
  words.add(word(2, 1, Outcome::Success));
  ASSERT_TRUE(words.verdictOn(1, second));
  EXPECT_EQ(words.verdictOn(1, second)->word.outcome, Outcome::Success);
  EXPECT_FALSE(words.verdictOn(1, second)->brokenOff);
  EXPECT_FALSE(words.verdictOn(2, second)) << "of another trial";
}

// A station that stood still has broken off what may have come to a result at the conductor.
TEST(TrialWords, WhatOneStationBreaksOffIsBrokenOffForAll) {
  for (const auto& [outcome, reason] : {std::pair{Outcome::Interrupted, Reason::Timing},
                                        {Outcome::Interrupted, Reason::PeerLost},
                                        {Outcome::Aborted, Reason::Experimenter},
                                        {Outcome::Aborted, Reason::Computation}}) {
    TrialWords words;
    words.add(word(2, 1, Outcome::Success));
    words.add(word(3, 1, outcome, reason));
    EXPECT_TRUE(words.verdictOn(1, second)->brokenOff);
    EXPECT_EQ(words.verdictOn(1, second)->word.station, 3u);
    words.add(word(2, 1, Outcome::Interrupted, Reason::DeviceLost));
    EXPECT_EQ(words.verdictOn(1, second)->word.reason, Reason::DeviceLost) << "the conductor's own word, where it broke off too";
  }
  for (const Reason reason : {Reason::NoOnset, Reason::NoStart}) EXPECT_FALSE(isBrokenOff(word(1, 1, Outcome::Aborted, reason)));
  EXPECT_FALSE(isBrokenOff(word(1, 1, Outcome::Failure, Reason::Position)));
}

TEST(TrialWords, WhoHasSaidNothingIsNamed) {
  TrialWords words;
  words.add(word(1, 1, Outcome::Success));
  EXPECT_EQ(words.missing(1, 4, 1), "3, 4");
  EXPECT_EQ(words.missing(2, 3, 2), "1, 2") << "its word on the last trial is none on this one";
  EXPECT_TRUE(words.anyOn(1));
  EXPECT_FALSE(words.anyOn(2));
  EXPECT_FALSE(TrialWords{}.anyOn(0)) << "nobody has said anything";
}

}  // namespace
}  // namespace reachlab::network
