#include "sim/record/log/records.h"

#include <fmt/format.h>

#include <cstring>
#include <limits>

#include "base/fault.h"

namespace reachlab::record {
namespace {

constexpr std::uint8_t kValid = 1, kHasVelocity = 2, kButtons = 4, kSamePosition = 8, kCommand = 16, kMissed = 32, kTickJump = 64,
                       kTimeJump = 128;

constexpr std::uint8_t kCatchTrial = 1, kChannelBroken = 2;  // marks of a trial

bool sameBits(const Vec3& a, const Vec3& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void put(ByteWriter& out, const Vec3& v) {
  out.put(v.x);
  out.put(v.y);
  out.put(v.z);
}

Vec3 getVec3(ByteReader& in) {
  Vec3 v;
  v.x = in.get<double>();
  v.y = in.get<double>();
  v.z = in.get<double>();
  return v;
}

// Buttons, or an open dead-man switch, which is told by the mark before them: pressed buttons are never that number.
constexpr std::uint32_t kReleasedMark = 0;
bool hasButtons(const haptics::DeviceSample& sample) { return sample.buttons != 0 || sample.released; }
void putButtons(ByteWriter& out, const haptics::DeviceSample& sample) {
  if (sample.released) out.put(kReleasedMark);
  out.put(sample.buttons);
}
void getButtons(ByteReader& in, haptics::DeviceSample& sample) {
  sample.buttons = in.get<std::uint32_t>();
  sample.released = sample.buttons == kReleasedMark;
  if (sample.released) sample.buttons = in.get<std::uint32_t>();
}

[[noreturn]] void refuse(const char* what) { throw FaultError(Fault{.what = fmt::format("{} record of an unknown form", what)}); }

template <typename Enum>
Enum getEnum(ByteReader& in, Enum last, const char* what) {
  const auto number = in.get<std::uint8_t>();
  if (number > static_cast<std::uint8_t>(last)) refuse(what);
  return static_cast<Enum>(number);
}

void requireWhole(const ByteReader& in, const char* what) {
  if (!in.ok() || in.left() != 0) refuse(what);
}

}  // namespace

void TickBlock::add(const TickStamp& tick, const haptics::DeviceSample& device) {
  const bool first = count_ == 0;
  const std::int64_t passed = tick.measuredNs - last_.measuredNs;
  std::uint8_t flags = 0;
  if (device.valid) flags |= kValid;
  if (device.hasVelocity) flags |= kHasVelocity;
  if (hasButtons(device)) flags |= kButtons;
  if (!first && sameBits(device.position, lastPosition_)) flags |= kSamePosition;
  if (tick.command != trial::Command::None) flags |= kCommand;
  if (tick.missedTicks != 0) flags |= kMissed;
  if (first || tick.tick != last_.tick + 1) flags |= kTickJump;
  if (first || passed < 0 || passed > std::numeric_limits<std::uint32_t>::max()) flags |= kTimeJump;
  if (first) bytes_.put(std::uint32_t{0});
  bytes_.put(flags);
  if (flags & kTickJump) bytes_.put(tick.tick);
  if (flags & kTimeJump) bytes_.put(tick.measuredNs);
  else bytes_.put(static_cast<std::uint32_t>(passed));
  if (!(flags & kSamePosition)) put(bytes_, device.position);
  if (flags & kHasVelocity) put(bytes_, device.velocity);
  if (flags & kButtons) putButtons(bytes_, device);
  if (flags & kCommand) bytes_.put(static_cast<std::uint8_t>(tick.command));
  if (flags & kMissed) bytes_.put(tick.missedTicks);
  last_ = tick;
  lastPosition_ = device.position;
  ++count_;
}

std::span<const std::uint8_t> TickBlock::payload() {
  bytes_.overwrite(0, count_);
  return bytes_.bytes();
}

void TickBlock::clear() {
  bytes_.clear();
  count_ = 0;
}

void decodeTicks(std::span<const std::uint8_t> payload, std::vector<RecordedTick>& out) {
  ByteReader in(payload);
  const auto count = in.get<std::uint32_t>();
  RecordedTick tick;
  for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
    const auto flags = in.get<std::uint8_t>();
    tick.tick = flags & kTickJump ? in.get<std::uint64_t>() : tick.tick + 1;
    tick.measuredNs = flags & kTimeJump ? in.get<std::int64_t>() : tick.measuredNs + in.get<std::uint32_t>();
    if (!(flags & kSamePosition)) tick.device.position = getVec3(in);
    tick.device.hasVelocity = flags & kHasVelocity;
    tick.device.velocity = flags & kHasVelocity ? getVec3(in) : Vec3{};
    tick.device.buttons = 0;
    tick.device.released = false;
    if (flags & kButtons) getButtons(in, tick.device);
    tick.device.valid = flags & kValid;
    tick.command = flags & kCommand ? getEnum(in, trial::Command::Interrupt, "tick") : trial::Command::None;
    tick.missedTicks = flags & kMissed ? in.get<std::uint32_t>() : 0;
    out.push_back(tick);
  }
  requireWhole(in, "tick");
}

void HandBlock::add(const haptics::DeviceSample& sample) {
  std::uint8_t flags = 0;
  if (sample.valid) flags |= kValid;
  if (sample.hasVelocity) flags |= kHasVelocity;
  if (hasButtons(sample)) flags |= kButtons;
  if (count_ > 0 && sameBits(sample.position, last_)) flags |= kSamePosition;
  if (count_ == 0) {
    bytes_.put(std::uint32_t{0});
    bytes_.put(static_cast<std::uint8_t>(hand_));
  }
  bytes_.put(flags);
  if (!(flags & kSamePosition)) put(bytes_, sample.position);
  if (flags & kHasVelocity) put(bytes_, sample.velocity);
  if (flags & kButtons) putButtons(bytes_, sample);
  last_ = sample.position;
  ++count_;
}

std::span<const std::uint8_t> HandBlock::payload() {
  bytes_.overwrite(0, count_);
  return bytes_.bytes();
}

void HandBlock::clear() {
  bytes_.clear();
  count_ = 0;
}

HandTicks decodeHandTicks(std::span<const std::uint8_t> payload) {
  ByteReader in(payload);
  const auto count = in.get<std::uint32_t>();
  HandTicks ticks;
  ticks.hand = in.get<std::uint8_t>();
  if (ticks.hand < 2 || ticks.hand > experiment::kMaxHands) refuse("hand");
  haptics::DeviceSample sample;
  for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
    const auto flags = in.get<std::uint8_t>();
    if (!(flags & kSamePosition)) sample.position = getVec3(in);
    sample.hasVelocity = flags & kHasVelocity;
    sample.velocity = flags & kHasVelocity ? getVec3(in) : Vec3{};
    sample.buttons = 0;
    sample.released = false;
    if (flags & kButtons) getButtons(in, sample);
    sample.valid = flags & kValid;
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

std::span<const std::uint8_t> SampleBlock::payload() {
  bytes_.overwrite(0, count_);
  return bytes_.bytes();
}

void SampleBlock::clear() {
  bytes_.clear();
  count_ = 0;
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

void encode(const RecordedEvent& event, ByteWriter& out) {
  out.put(event.tick);
  out.put(static_cast<std::uint8_t>(event.kind));
  out.put(event.trial);
  out.put(event.value);
  out.putText(event.text);
}

RecordedEvent decodeEvent(std::span<const std::uint8_t> payload) {
  ByteReader in(payload);
  RecordedEvent event;
  event.tick = in.get<std::uint64_t>();
  event.kind = getEnum(in, kLastEventKind, "event");
  event.trial = in.get<std::int32_t>();
  event.value = in.get<double>();
  event.text = in.getText();
  requireWhole(in, "event");
  return event;
}

void encode(const TrialSetup& setup, ByteWriter& out) {
  out.put(setup.trial);
  out.put(static_cast<std::int32_t>(setup.planned.index));
  out.put(static_cast<std::int32_t>(setup.planned.foreperiodTicks));
  out.put(static_cast<std::uint8_t>(setup.planned.catchTrial));
}

TrialSetup decodeSetup(std::span<const std::uint8_t> payload) {
  ByteReader in(payload);
  TrialSetup setup;
  setup.trial = in.get<std::int32_t>();
  setup.planned.index = in.get<std::int32_t>();
  setup.planned.foreperiodTicks = in.get<std::int32_t>();
  setup.planned.catchTrial = in.get<std::uint8_t>() != 0;
  requireWhole(in, "trial setup");
  return setup;
}

void encode(const RecordedTrial& t, const TrialLink& previous, ByteWriter& out) {
  out.put(static_cast<std::int32_t>(t.trial));
  out.put(static_cast<std::int32_t>(t.planned.index));
  out.put(static_cast<std::int32_t>(t.planned.foreperiodTicks));
  out.put(static_cast<std::uint8_t>((t.planned.catchTrial ? kCatchTrial : 0) | (t.channelBroken ? kChannelBroken : 0)));
  out.put(static_cast<std::uint8_t>(t.result.outcome));
  out.put(static_cast<std::uint8_t>(t.result.reason));
  out.put(static_cast<std::int32_t>(t.result.mass));
  for (const double value : {t.result.by, t.result.movementTime}) out.put(value);
  for (const std::uint64_t tick : {t.startTick, t.armedTick, t.goTick, t.result.onsetTick, t.result.endTick, t.lastTick}) out.put(tick);
  for (const double value : {t.peakHandSpeed, t.handPathLength, t.peakForce, t.meanForce}) out.put(value);
  out.put(t.clampedTicks);
  out.put(t.missedTicks);
  out.put(t.offset);
  out.put(t.sequence);
  out.put(previous.offset);
  out.put(previous.sequence);
  out.put(t.elapsed);
  out.put(t.droppedTicks);
}

RecordedTrial decodeTrial(std::span<const std::uint8_t> payload, TrialLink& previous) {
  ByteReader in(payload);
  RecordedTrial t;
  t.trial = in.get<std::int32_t>();
  t.planned.index = in.get<std::int32_t>();
  t.planned.foreperiodTicks = in.get<std::int32_t>();
  const auto marks = in.get<std::uint8_t>();
  t.planned.catchTrial = (marks & kCatchTrial) != 0;
  t.channelBroken = (marks & kChannelBroken) != 0;
  t.result.outcome = getEnum(in, trial::Outcome::Interrupted, "trial");
  t.result.reason = getEnum(in, trial::kLastReason, "trial");
  t.result.mass = in.get<std::int32_t>();
  for (double* value : {&t.result.by, &t.result.movementTime}) *value = in.get<double>();
  for (std::uint64_t* tick : {&t.startTick, &t.armedTick, &t.goTick, &t.result.onsetTick, &t.result.endTick, &t.lastTick})
    *tick = in.get<std::uint64_t>();
  if (t.startTick > t.lastTick) refuse("trial");
  for (double* value : {&t.peakHandSpeed, &t.handPathLength, &t.peakForce, &t.meanForce}) *value = in.get<double>();
  t.clampedTicks = in.get<std::uint64_t>();
  t.missedTicks = in.get<std::uint64_t>();
  t.offset = in.get<std::uint64_t>();
  t.sequence = in.get<std::uint32_t>();
  previous.offset = in.get<std::uint64_t>();
  previous.sequence = in.get<std::uint32_t>();
  t.elapsed = in.get<double>();
  t.droppedTicks = in.get<std::uint64_t>();
  requireWhole(in, "trial");
  return t;
}

void encodeEnd(const TrialLink& last, ByteWriter& out) {
  out.put(last.offset);
  out.put(last.sequence);
}

TrialLink decodeEnd(std::span<const std::uint8_t> payload) {
  ByteReader in(payload);
  TrialLink last;
  last.offset = in.get<std::uint64_t>();
  last.sequence = in.get<std::uint32_t>();
  requireWhole(in, "closing");
  return last;
}

}  // namespace reachlab::record
