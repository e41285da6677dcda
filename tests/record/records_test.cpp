// The records' payloads byte by byte as docs/recording.md has them, and what no writer of ours made.
#include "sim/record/log/records.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "base/fault.h"
#include "sim/experiment/experiment.h"
#include "sim/record/log/run_log.h"
#include "tests/refusal.h"

namespace reachlab::record {
namespace {

using Bytes = std::vector<std::uint8_t>;

// These numbers one after the other as they lie in memory, which is little-endian.
template <typename... Numbers>
Bytes bytesOf(Numbers... numbers) {
  Bytes bytes;
  const auto add = [&](auto number) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(&number);
    bytes.insert(bytes.end(), first, first + sizeof number);
  };
  (add(numbers), ...);
  return bytes;
}

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Bytes copyOf(std::span<const std::uint8_t> bytes) { return {bytes.begin(), bytes.end()}; }

template <typename Decode>
void expectRefused(const Bytes& bytes, const std::string& what, const Decode& decode) {
  EXPECT_EQ(refusalOf([&] { decode(bytes); }), what + " record of an unknown form");
}

// Whole it is read; a byte more or any number of bytes less is refused.
template <typename Decode>
void expectReadOnlyWhole(const Bytes& bytes, const std::string& what, const Decode& decode) {
  EXPECT_NO_THROW(decode(bytes));
  expectRefused(bytes + Bytes{0}, what, decode);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    expectRefused(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)), what, decode);
}

std::vector<RecordedTick> ticksOf(const Bytes& bytes) {
  std::vector<RecordedTick> ticks;
  decodeTicks(bytes, ticks);
  return ticks;
}

void add(TickBlock& block, const RecordedTick& tick) { block.add(tick, tick.device); }

RecordedTick tickAt(std::uint64_t number, std::int64_t ns, const Vec3& place) {
  RecordedTick tick;
  tick.tick = number;
  tick.measuredNs = ns;
  tick.device.position = place;
  return tick;
}

// Once more, from what was read. The bytes themselves are held against the numbers that were given.
Bytes again(const std::vector<RecordedTick>& ticks) {
  TickBlock block;
  for (const RecordedTick& tick : ticks) add(block, tick);
  return copyOf(block.payload());
}

TEST(TickRecord, HasOfEachTickOnlyWhatItsFlagsAskFor) {
  TickBlock block;
  EXPECT_TRUE(block.empty());
  std::vector<RecordedTick> ticks{tickAt(7, 5'000'000'123, {1.5, -2.5, 3.25}), tickAt(8, 5'001'000'125, {1.5, -2.5, 3.25}),
                                  tickAt(9, 5'002'000'000, {1.5, -2.5, 4.25})};
  ticks[1].device.valid = false;
  ticks[2].device.hasVelocity = true;
  ticks[2].device.velocity = {0.5, 0.25, -0.125};
  ticks[2].device.buttons = 6;
  ticks[2].command = trial::Command::Abort;
  ticks[2].missedTicks = 3;
  for (const RecordedTick& tick : ticks) add(block, tick);
  EXPECT_FALSE(block.empty());
  EXPECT_EQ(block.count(), 3u);
  const Bytes expected = bytesOf(std::uint32_t{3}) +
                         bytesOf(std::uint8_t{64 | 128 | 1}, std::uint64_t{7}, std::int64_t{5'000'000'123}, 1.5, -2.5, 3.25) +
                         bytesOf(std::uint8_t{8}, std::uint32_t{1'000'002}) +
                         bytesOf(std::uint8_t{2 | 4 | 16 | 32 | 1}, std::uint32_t{999'875}, 1.5, -2.5, 4.25, 0.5, 0.25, -0.125,
                                 std::uint32_t{6}, std::uint8_t{2}, std::uint32_t{3});
  EXPECT_EQ(copyOf(block.payload()), expected);
  EXPECT_EQ(again(ticksOf(expected)), expected);
  expectReadOnlyWhole(expected, "tick", ticksOf);
}

// Earlier programs never wrote buttons of which none is pressed; the mark before them is an open dead-man switch.
TEST(TickRecord, TellsAnOpenDeadManSwitchWithAndWithoutButtons) {
  for (const std::uint32_t buttons : {0u, 6u}) {
    const haptics::DeviceSample sample{.buttons = buttons, .valid = false, .released = true};
    RecordedTick tick = tickAt(1, 0, {});
    tick.device = sample;
    TickBlock ticks;
    add(ticks, tick);
    add(ticks, tickAt(2, 1'000'000, {}));
    HandBlock hands(2);
    hands.add(sample);
    hands.add({});
    const std::vector<RecordedTick> read = ticksOf(copyOf(ticks.payload()));
    const HandTicks other = decodeHandTicks(hands.payload());
    for (const haptics::DeviceSample& back : {read.at(0).device, other.samples.at(0)}) {
      EXPECT_TRUE(back.released);
      EXPECT_EQ(back.buttons, buttons);
    }
    EXPECT_FALSE(read.at(1).device.released);
    EXPECT_FALSE(other.samples.at(1).released);
  }
}

TEST(TickRecord, TellsATickOrATimeAnewWhereItDoesNotFollowTheLast) {
  constexpr std::int64_t kMost = 4'294'967'295;  // [ns] what 32 bits hold
  const Vec3 place{0, 0, 0};
  std::vector<RecordedTick> ticks{tickAt(0, 100, place)};
  const auto then = [&](std::uint64_t tick, std::int64_t later) { ticks.push_back(tickAt(tick, ticks.back().measuredNs + later, place)); };
  then(1, kMost);
  then(2, kMost + 1);
  then(3, -1);
  then(5, 10);
  then(5, 10);
  then(4, 0);
  const std::uint8_t same = 8 | 1;
  Bytes expected = bytesOf(std::uint32_t{7}) + bytesOf(std::uint8_t{64 | 128 | 1}, std::uint64_t{0}, std::int64_t{100}, 0.0, 0.0, 0.0);
  expected = expected + bytesOf(same, static_cast<std::uint32_t>(kMost));
  expected = expected + bytesOf(std::uint8_t(same | 128), ticks[2].measuredNs);
  expected = expected + bytesOf(std::uint8_t(same | 128), ticks[3].measuredNs);
  for (const auto& [tick, later] : {std::pair{5, 10u}, std::pair{5, 10u}, std::pair{4, 0u}})
    expected = expected + bytesOf(std::uint8_t(same | 64), static_cast<std::uint64_t>(tick), later);
  EXPECT_EQ(again(ticks), expected);
  EXPECT_EQ(again(ticksOf(expected)), expected);
}

TEST(TickRecord, TwoPlacesOfTheSameBitsAreOneAndZerosOfTwoSignsAreTwo) {
  TickBlock block;
  const double nan = std::nan("");
  add(block, tickAt(0, 0, {nan, 0, 0}));
  add(block, tickAt(1, 0, {nan, 0, 0}));
  add(block, tickAt(2, 0, {nan, -0.0, 0}));
  EXPECT_EQ(block.payload().size(), 4u + (1 + 8 + 8 + 24) + (1 + 4) + (1 + 4 + 24));
  EXPECT_TRUE(std::signbit(ticksOf(copyOf(block.payload()))[2].device.position.y));
}

TEST(TickRecord, ABlockThatWasClearedBeginsAnew) {
  TickBlock block, fresh;
  add(block, tickAt(3, 30, {1, 2, 3}));
  block.clear();
  EXPECT_TRUE(block.empty());
  EXPECT_EQ(block.count(), 0u);
  for (TickBlock* b : {&block, &fresh}) add(*b, tickAt(4, 40, {1, 2, 3}));
  EXPECT_EQ(copyOf(block.payload()), copyOf(fresh.payload())) << "it can be read without the one before";
}

TEST(TickRecord, OfACommandThatIsNoneIsRefused) {
  const auto withCommand = [](std::uint8_t command) {
    return bytesOf(std::uint32_t{1}, std::uint8_t{64 | 128 | 16}, std::uint64_t{0}, std::int64_t{0}, 0.0, 0.0, 0.0, command);
  };
  EXPECT_EQ(ticksOf(withCommand(3)).at(0).command, trial::Command::Interrupt);
  expectRefused(withCommand(4), "tick", ticksOf);
}

TEST(HandRecord, HasTheHandAndOfEachSampleWhatItsFlagsAskFor) {
  HandBlock block(3);
  EXPECT_TRUE(block.empty());
  const haptics::DeviceSample first{.position = {0.5, 1.5, 2.5}}, second{.position = first.position, .buttons = 9, .valid = false},
      third{.position = {0.5, 1.5, -2.5}, .velocity = {4, 5, 6}, .hasVelocity = true};
  for (const auto& sample : {first, second, third}) block.add(sample);
  EXPECT_FALSE(block.empty());
  const Bytes expected = bytesOf(std::uint32_t{3}, std::uint8_t{3}) + bytesOf(std::uint8_t{1}, 0.5, 1.5, 2.5) +
                         bytesOf(std::uint8_t{8 | 4}, std::uint32_t{9}) + bytesOf(std::uint8_t{2 | 1}, 0.5, 1.5, -2.5, 4.0, 5.0, 6.0);
  EXPECT_EQ(copyOf(block.payload()), expected);
  const HandTicks read = decodeHandTicks(expected);
  EXPECT_EQ(read.hand, 3);
  HandBlock again(3);
  for (const haptics::DeviceSample& sample : read.samples) again.add(sample);
  EXPECT_EQ(copyOf(again.payload()), expected);
  for (std::size_t size = 0; size < expected.size(); ++size)
    EXPECT_THROW(decodeHandTicks(std::span(expected).first(size)), FaultError) << size;
  expectRefused(expected + Bytes{0}, "hand", decodeHandTicks);
  block.clear();
  EXPECT_TRUE(block.empty());
  block.add(first);
  EXPECT_EQ(copyOf(block.payload()), bytesOf(std::uint32_t{1}, std::uint8_t{3}) + bytesOf(std::uint8_t{1}, 0.5, 1.5, 2.5))
      << "it can be read without the one before, whose last place it has";
}

TEST(HandRecord, IsOfTheSecondHandToTheLast) {
  for (int hand = 0; hand < 256; ++hand) {
    const Bytes bytes = bytesOf(std::uint32_t{0}, static_cast<std::uint8_t>(hand));
    if (hand >= 2 && hand <= experiment::kMaxHands) EXPECT_EQ(decodeHandTicks(bytes).hand, hand);
    else expectRefused(bytes, "hand", decodeHandTicks);
  }
}

SampleRows rowsOf(const Bytes& bytes, std::uint64_t first, std::uint64_t last) {
  SampleRows rows;
  rows.columns = 2;
  decodeSamples(bytes, first, last, rows);
  return rows;
}

TEST(SampleRecord, GivesTheRowsBetweenTwoTicksBothIncluded) {
  SampleBlock block(2);
  EXPECT_TRUE(block.empty());
  for (const double tick : {10, 20, 30, 40}) {
    const double row[2] = {tick / 4, -tick};
    block.add(static_cast<std::uint64_t>(tick), row);
  }
  EXPECT_FALSE(block.empty());
  Bytes expected = bytesOf(std::uint32_t{4}, std::uint32_t{2});
  for (const double tick : {10, 20, 30, 40}) expected = expected + bytesOf(static_cast<std::uint64_t>(tick), tick / 4, -tick);
  EXPECT_EQ(copyOf(block.payload()), expected);
  EXPECT_EQ(firstTickOf(expected), 10u);
  EXPECT_EQ(rowsOf(expected, 0, 100).ticks, (std::vector<std::uint64_t>{10, 20, 30, 40}));
  SampleRows rows = rowsOf(expected, 20, 30);
  EXPECT_EQ(rows.ticks, (std::vector<std::uint64_t>{20, 30}));
  EXPECT_EQ(rows.values, (std::vector<double>{5, -20, 7.5, -30}));
  EXPECT_EQ(rows.at(1, 0), 7.5);
  EXPECT_EQ(rowsOf(expected, 21, 29).size(), 0u);
  decodeSamples(expected, 40, 40, rows);
  EXPECT_EQ(rows.ticks.back(), 40u) << "behind the rows that are there";
  EXPECT_EQ(rows.at(2, 1), -40);
  expectReadOnlyWhole(expected, "sample", [](const Bytes& bytes) { return rowsOf(bytes, 0, 100); });
  block.clear();
  EXPECT_TRUE(block.empty());
  const double row[2] = {1, 2};
  block.add(50, row);
  EXPECT_EQ(copyOf(block.payload()), bytesOf(std::uint32_t{1}, std::uint32_t{2}, std::uint64_t{50}, 1.0, 2.0));
}

TEST(EventRecord, IsTickKindTrialValueAndText) {
  const RecordedEvent event{123, EventKind::Note, 4, 0.5, "coffee"};
  ByteWriter out;
  encode(event, out);
  Bytes expected = bytesOf(std::uint64_t{123}, std::uint8_t{12}, std::int32_t{4}, 0.5, std::uint32_t{6});
  for (const char c : event.text) expected.push_back(static_cast<std::uint8_t>(c));
  EXPECT_EQ(copyOf(out.bytes()), expected);
  ByteWriter again;
  encode(decodeEvent(expected), again);
  EXPECT_EQ(copyOf(again.bytes()), expected);
  expectReadOnlyWhole(expected, "event", decodeEvent);
  expected[8] = 15;
  EXPECT_EQ(decodeEvent(expected).kind, EventKind::Instrument);
  expected[8] = 16;
  EXPECT_EQ(decodeEvent(expected).kind, EventKind::ChannelBroken);
  expected[8] = 17;
  expectRefused(expected, "event", decodeEvent);
}

TEST(EventRecord, EveryKindHasTheNumberAndTheNameThatAreWrittenDown) {
  const char* names[] = {"trial_start",  "armed",        "go",          "onset",         "trial_end",  "clamp_begin",
                         "clamp_end",    "device_lost",  "device_back", "ticks_missed",  "step_fault", "note",
                         "device_state", "intervention", "instrument",  "channel_broken"};
  for (int kind = 1; kind <= 16; ++kind) EXPECT_EQ(nameOf(static_cast<EventKind>(kind)), names[kind - 1]) << kind;
}

TEST(SetupRecord, IsTrialPlaceForeperiodAndWhetherItIsACatchTrial) {
  for (const bool catchTrial : {false, true}) {
    ByteWriter out;
    encode(TrialSetup{5, {3, 700, catchTrial}}, out);
    const Bytes expected = bytesOf(std::int32_t{5}, std::int32_t{3}, std::int32_t{700}, std::uint8_t{catchTrial});
    EXPECT_EQ(copyOf(out.bytes()), expected);
    ByteWriter again;
    encode(decodeSetup(expected), again);
    EXPECT_EQ(copyOf(again.bytes()), expected);
    expectReadOnlyWhole(expected, "trial setup", decodeSetup);
  }
}

// Every number another one.
RecordedTrial wholeTrial() {
  RecordedTrial t;
  t.trial = 5;
  t.planned = {3, 700, true};
  t.result = {trial::Outcome::Failure, trial::Reason::TimeShort, 2, 0.25, 1.75, 1300, 3050};
  t.startTick = 100, t.armedTick = 200, t.goTick = 900, t.lastTick = 3051;
  t.peakHandSpeed = 0.5, t.handPathLength = 0.75, t.peakForce = 8.5, t.meanForce = 4.5;
  t.clampedTicks = 11, t.missedTicks = 12, t.droppedTicks = 13;
  t.elapsed = 2.125;
  t.offset = 4000;
  t.sequence = 41;
  return t;
}

RecordedTrial trialOf(const Bytes& bytes) {
  TrialLink ignored;
  return decodeTrial(bytes, ignored);
}

TEST(TrialRecord, HasItsFieldsInTheDocumentedOrder) {
  const RecordedTrial t = wholeTrial();
  ByteWriter out;
  encode(t, {3000, 31}, out);
  const Bytes expected =
      bytesOf(std::int32_t{5}, std::int32_t{3}, std::int32_t{700}, std::uint8_t{1}) +
      bytesOf(std::uint8_t{2}, std::uint8_t{3}, std::int32_t{2}, 0.25, 1.75) +
      bytesOf(std::uint64_t{100}, std::uint64_t{200}, std::uint64_t{900}, std::uint64_t{1300}, std::uint64_t{3050}, std::uint64_t{3051}) +
      bytesOf(0.5, 0.75, 8.5, 4.5, std::uint64_t{11}, std::uint64_t{12}) +
      bytesOf(std::uint64_t{4000}, std::uint32_t{41}, std::uint64_t{3000}, std::uint32_t{31}, 2.125, std::uint64_t{13});
  EXPECT_EQ(copyOf(out.bytes()), expected);
  TrialLink previous;
  const RecordedTrial read = decodeTrial(expected, previous);
  EXPECT_EQ(previous.offset, 3000u);
  EXPECT_EQ(previous.sequence, 31u);
  ByteWriter again;
  encode(read, previous, again);
  EXPECT_EQ(copyOf(again.bytes()), expected);
  EXPECT_TRUE(read.complete);
  EXPECT_EQ(read.result.onsetTick, 1300u);
  EXPECT_EQ(read.elapsed, 2.125);
}

TEST(TrialRecord, MarksACatchTrialAndABrokenChannelApart) {
  for (const bool isCatch : {false, true})
    for (const bool broken : {false, true}) {
      RecordedTrial t = wholeTrial();
      t.planned.catchTrial = isCatch;
      t.channelBroken = broken;
      ByteWriter out;
      encode(t, {}, out);
      EXPECT_EQ(trialOf(copyOf(out.bytes())).planned.catchTrial, isCatch);
      EXPECT_EQ(trialOf(copyOf(out.bytes())).channelBroken, broken);
    }
}

TEST(TrialRecord, HasAnOutcomeAReasonAndAnEndThatIsNotBeforeItsStart) {
  ByteWriter out;
  encode(wholeTrial(), {}, out);
  const auto with = [&](std::size_t at, std::uint8_t value) {
    Bytes bytes = copyOf(out.bytes());
    bytes[at] = value;
    return bytes;
  };
  EXPECT_EQ(trialOf(with(13, 4)).result.outcome, trial::Outcome::Interrupted);
  expectRefused(with(13, 5), "trial", trialOf);
  EXPECT_EQ(trialOf(with(14, 15)).result.reason, trial::Reason::PeerLost);
  expectRefused(with(14, 17), "trial", trialOf);
  Bytes shorter = copyOf(out.bytes());
  shorter.resize(shorter.size() - 3);
  expectRefused(shorter, "trial", trialOf);
  RecordedTrial t = wholeTrial();
  t.startTick = t.lastTick;
  ByteWriter one, none;
  encode(t, {}, one);
  EXPECT_EQ(trialOf(copyOf(one.bytes())).startTick, t.lastTick);
  ++t.startTick;
  encode(t, {}, none);
  expectRefused(copyOf(none.bytes()), "trial", trialOf);
}

TEST(EndRecord, IsTheOffsetAndTheNumberOfTheLastTrialsRecord) {
  ByteWriter out;
  encode(TrialLink{12345678901, 77}, out);
  const Bytes expected = bytesOf(std::uint64_t{12345678901}, std::uint32_t{77});
  EXPECT_EQ(copyOf(out.bytes()), expected);
  EXPECT_EQ(expected.size(), kEndPayloadBytes);
  EXPECT_EQ(decodeEnd(expected).offset, 12345678901u);
  EXPECT_EQ(decodeEnd(expected).sequence, 77u);
  expectReadOnlyWhole(expected, "closing", decodeEnd);
}

}  // namespace
}  // namespace reachlab::record
