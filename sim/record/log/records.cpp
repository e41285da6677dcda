#include "sim/record/log/records.h"

#include <fmt/format.h>

#include <cstring>
#include <limits>

#include "base/fault.h"
#include "base/maybe_const.h"

namespace reachlab::record {
namespace {

constexpr std::uint8_t kValid = 1, kHasVelocity = 2, kButtons = 4, kSamePosition = 8, kCommand = 16, kMissed = 32, kTickJump = 64,
                       kTimeJump = 128;

bool sameBits(const Vec3& a, const Vec3& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void put(ByteWriter& out, const Vec3& v) {
  for (const double part : {v.x, v.y, v.z}) out.put(part);
}

Vec3 getVec3(ByteReader& in) {
  Vec3 v;
  for (double* part : {&v.x, &v.y, &v.z}) *part = in.get<double>();
  return v;
}

// The log holds a device's sample as flags, followed by the numbers that the flags announce.
std::uint8_t flagsOf(const haptics::DeviceSample& sample, bool samePosition) {
  return static_cast<std::uint8_t>((sample.valid ? kValid : 0) | (sample.hasVelocity ? kHasVelocity : 0) |
                                   (sample.buttons != 0 || sample.released ? kButtons : 0) | (samePosition ? kSamePosition : 0));
}

// Buttons, or an open dead-man switch, which is told by the mark before them: pressed buttons are never that number.
constexpr std::uint32_t kReleasedMark = 0;

void putSample(ByteWriter& out, std::uint8_t flags, const haptics::DeviceSample& sample) {
  if (!(flags & kSamePosition)) put(out, sample.position);
  if (flags & kHasVelocity) put(out, sample.velocity);
  if (!(flags & kButtons)) return;
  if (sample.released) out.put(kReleasedMark);
  out.put(sample.buttons);
}

// `sample`: the one before, whose position may be the same.
void getSample(ByteReader& in, std::uint8_t flags, haptics::DeviceSample& sample) {
  if (!(flags & kSamePosition)) sample.position = getVec3(in);
  sample.valid = flags & kValid;
  sample.hasVelocity = flags & kHasVelocity;
  sample.velocity = sample.hasVelocity ? getVec3(in) : Vec3{};
  sample.buttons = flags & kButtons ? in.get<std::uint32_t>() : 0;
  sample.released = flags & kButtons && sample.buttons == kReleasedMark;
  if (sample.released) sample.buttons = in.get<std::uint32_t>();
}

[[noreturn]] void refuse(const char* what) { throw FaultError(Fault{.what = fmt::format("{} record of an unknown form", what)}); }

void requireWhole(const ByteReader& in, const char* what) {
  if (!in.ok() || in.left() != 0) refuse(what);
}

// The members of each record, in the order of its bytes: the one list for writing and reading.
template <MaybeConst<RecordedEvent> T, class Visit>
void visitMembers(T& e, const Visit& visit) {
  visit(e.tick, e.kind, e.trial, e.value, e.text);
}

template <MaybeConst<TrialSetup> T, class Visit>
void visitMembers(T& s, const Visit& visit) {
  visit(s.trial, s.planned.index, s.planned.foreperiodTicks);
  visit.marks(s.planned.catchTrial);
}

template <MaybeConst<TrialLink> T, class Visit>
void visitMembers(T& l, const Visit& visit) {
  visit(l.offset, l.sequence);
}

template <MaybeConst<RecordedTrial> T, class Visit>
void visitMembers(T& t, MaybeConst<TrialLink> auto& previous, const Visit& visit) {
  visit(t.trial, t.planned.index, t.planned.foreperiodTicks);
  visit.marks(t.planned.catchTrial, t.channelBroken);
  visit(t.result.outcome, t.result.reason, t.result.mass, t.result.by, t.result.movementTime);
  visit(t.startTick, t.armedTick, t.goTick, t.result.onsetTick, t.result.endTick, t.lastTick);
  visit(t.peakHandSpeed, t.handPathLength, t.peakForce, t.meanForce, t.clampedTicks, t.missedTicks, t.offset, t.sequence);
  visit(previous.offset, previous.sequence, t.elapsed, t.droppedTicks);
}

template <class Record>
Record decodeWhole(std::span<const std::uint8_t> payload, const char* what) {
  ByteReader in(payload);
  Record record;
  visitMembers(record, GetMembers{in});
  requireWhole(in, what);
  return record;
}

}  // namespace

std::span<const std::uint8_t> Block::payload() {
  bytes_.overwrite(0, count_);
  return bytes_.bytes();
}

void Block::clear() {
  bytes_.clear();
  count_ = 0;
}

void TickBlock::add(const TickStamp& tick, const haptics::DeviceSample& device) {
  const bool first = count_ == 0;
  const std::int64_t passed = tick.measuredNs - last_.measuredNs;
  std::uint8_t flags = flagsOf(device, !first && sameBits(device.position, lastPosition_));
  if (tick.command != trial::Command::None) flags |= kCommand;
  if (tick.missedTicks != 0) flags |= kMissed;
  if (first || tick.tick != last_.tick + 1) flags |= kTickJump;
  if (first || passed < 0 || passed > std::numeric_limits<std::uint32_t>::max()) flags |= kTimeJump;
  if (first) bytes_.put(std::uint32_t{0});
  bytes_.put(flags);
  if (flags & kTickJump) bytes_.put(tick.tick);
  if (flags & kTimeJump) bytes_.put(tick.measuredNs);
  else bytes_.put(static_cast<std::uint32_t>(passed));
  putSample(bytes_, flags, device);
  if (flags & kCommand) bytes_.put(static_cast<std::uint8_t>(tick.command));
  if (flags & kMissed) bytes_.put(tick.missedTicks);
  last_ = tick;
  lastPosition_ = device.position;
  ++count_;
}

void decodeTicks(std::span<const std::uint8_t> payload, std::vector<RecordedTick>& out) {
  ByteReader in(payload);
  const auto count = in.get<std::uint32_t>();
  RecordedTick tick;
  for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
    const auto flags = in.get<std::uint8_t>();
    tick.tick = flags & kTickJump ? in.get<std::uint64_t>() : tick.tick + 1;
    tick.measuredNs = flags & kTimeJump ? in.get<std::int64_t>() : tick.measuredNs + in.get<std::uint32_t>();
    getSample(in, flags, tick.device);
    const auto command = flags & kCommand ? in.get<std::uint8_t>() : std::uint8_t{0};
    if (command > static_cast<std::uint8_t>(trial::Command::Interrupt)) refuse("tick");
    tick.command = static_cast<trial::Command>(command);
    tick.missedTicks = flags & kMissed ? in.get<std::uint32_t>() : 0;
    out.push_back(tick);
  }
  requireWhole(in, "tick");
}

void HandBlock::add(const haptics::DeviceSample& sample) {
  const std::uint8_t flags = flagsOf(sample, count_ > 0 && sameBits(sample.position, last_));
  if (count_ == 0) {
    bytes_.put(std::uint32_t{0});
    bytes_.put(static_cast<std::uint8_t>(hand_));
  }
  bytes_.put(flags);
  putSample(bytes_, flags, sample);
  last_ = sample.position;
  ++count_;
}

HandTicks decodeHandTicks(std::span<const std::uint8_t> payload) {
  ByteReader in(payload);
  const auto count = in.get<std::uint32_t>();
  HandTicks ticks;
  ticks.hand = in.get<std::uint8_t>();
  if (ticks.hand < 2 || ticks.hand > experiment::kMaxHands) refuse("hand");
  haptics::DeviceSample sample;
  for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
    getSample(in, in.get<std::uint8_t>(), sample);
    ticks.samples.push_back(sample);
  }
  requireWhole(in, "hand");
  return ticks;
}

void SampleBlock::add(std::uint64_t tick, const double* row) {
  if (count_ == 0) {
    bytes_.put(std::uint32_t{0});
    bytes_.put(static_cast<std::uint32_t>(columns_));
  }
  bytes_.put(tick);
  bytes_.putBytes(row, columns_ * sizeof(double));
  ++count_;
}

std::uint64_t firstTickOf(std::span<const std::uint8_t> samplesPayload) {
  ByteReader in(samplesPayload);
  in.get<std::uint64_t>();  // count and columns
  return in.get<std::uint64_t>();
}

void decodeSamples(std::span<const std::uint8_t> payload, std::uint64_t firstTick, std::uint64_t lastTick, SampleRows& out) {
  ByteReader in(payload);
  const std::size_t count = in.get<std::uint32_t>();
  const std::size_t columns = in.get<std::uint32_t>();
  const std::size_t rowBytes = (columns + 1) * sizeof(double);  // divided by, not multiplied with: both counts are the file's word
  if (!in.ok() || columns != out.columns || in.left() % rowBytes != 0 || in.left() / rowBytes != count) refuse("sample");
  const std::uint8_t* at = payload.data() + 2 * sizeof(std::uint32_t);
  for (std::size_t row = 0; row < count; ++row, at += rowBytes) {
    std::uint64_t tick = 0;
    std::memcpy(&tick, at, sizeof tick);
    if (tick < firstTick || tick > lastTick) continue;
    out.ticks.push_back(tick);
    const std::size_t old = out.values.size();
    out.values.resize(old + columns);
    std::memcpy(out.values.data() + old, at + sizeof tick, columns * sizeof(double));
  }
}

void encode(const RecordedEvent& event, ByteWriter& out) { visitMembers(event, PutMembers{out}); }
RecordedEvent decodeEvent(std::span<const std::uint8_t> payload) { return decodeWhole<RecordedEvent>(payload, "event"); }

void encode(const TrialSetup& setup, ByteWriter& out) { visitMembers(setup, PutMembers{out}); }
TrialSetup decodeSetup(std::span<const std::uint8_t> payload) { return decodeWhole<TrialSetup>(payload, "trial setup"); }

void encode(const RecordedTrial& trial, const TrialLink& previous, ByteWriter& out) { visitMembers(trial, previous, PutMembers{out}); }
RecordedTrial decodeTrial(std::span<const std::uint8_t> payload, TrialLink& previous) {
  ByteReader in(payload);
  RecordedTrial trial;
  visitMembers(trial, previous, GetMembers{in});
  if (trial.startTick > trial.lastTick) refuse("trial");
  requireWhole(in, "trial");
  return trial;
}

void encode(const TrialLink& last, ByteWriter& out) { visitMembers(last, PutMembers{out}); }
TrialLink decodeEnd(std::span<const std::uint8_t> payload) { return decodeWhole<TrialLink>(payload, "closing"); }

}  // namespace reachlab::record
