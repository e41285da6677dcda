#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "sim/record/log/log.h"
#include "sim/record/log/run_log.h"

/// Payloads of the log's records, to bytes and back (docs/recording.md). Decoding throws FaultError on bytes that no writer makes.
namespace reachlab::record {

/// Collects the ticks of one block.
class TickBlock {
 public:
  /// `device`: the first hand's sample.
  void add(const TickStamp& tick, const haptics::DeviceSample& device);
  bool empty() const { return count_ == 0; }
  std::uint32_t count() const { return count_; }
  /// The payload so far. Call `clear` before the next block.
  std::span<const std::uint8_t> payload();
  void clear();

 private:
  ByteWriter bytes_;
  TickStamp last_;
  Vec3 lastPosition_;  // [m]
  std::uint32_t count_ = 0;
};
void decodeTicks(std::span<const std::uint8_t> payload, std::vector<RecordedTick>& out);

/// Collects a further hand's raw samples, one for each tick of the block of ticks that goes before it.
class HandBlock {
 public:
  /// `hand` from 2.
  explicit HandBlock(int hand) : hand_(hand) {}
  void add(const haptics::DeviceSample& sample);
  bool empty() const { return count_ == 0; }
  std::span<const std::uint8_t> payload();
  void clear();

 private:
  int hand_;
  ByteWriter bytes_;
  Vec3 last_;  // [m]
  std::uint32_t count_ = 0;
};
/// The samples and whose they are, from 2.
struct HandTicks {
  int hand = 0;
  std::vector<haptics::DeviceSample> samples;
};
HandTicks decodeHandTicks(std::span<const std::uint8_t> payload);

/// Collects rows of the derived channels.
class SampleBlock {
 public:
  explicit SampleBlock(std::size_t columns) : columns_(columns) {}
  void add(std::uint64_t tick, const double* row);
  bool empty() const { return count_ == 0; }
  std::span<const std::uint8_t> payload();
  void clear();

 private:
  ByteWriter bytes_;
  std::size_t columns_;
  std::uint32_t count_ = 0;
};
/// Rows with firstTick <= tick <= lastTick are appended.
std::uint64_t firstTickOf(std::span<const std::uint8_t> samplesPayload);
void decodeSamples(std::span<const std::uint8_t> payload, std::uint64_t firstTick, std::uint64_t lastTick, SampleRows& out);

void encode(const RecordedEvent& event, ByteWriter& out);
RecordedEvent decodeEvent(std::span<const std::uint8_t> payload);

void encode(const TrialSetup& setup, ByteWriter& out);
TrialSetup decodeSetup(std::span<const std::uint8_t> payload);

/// A trial's result, with the position of the trial record before it (offset 0: this is the first trial).
struct TrialLink {
  std::uint64_t offset = 0;
  std::uint32_t sequence = 0;
};
void encode(const RecordedTrial& trial, const TrialLink& previous, ByteWriter& out);
RecordedTrial decodeTrial(std::span<const std::uint8_t> payload, TrialLink& previous);

/// The closing record: where the last trial record lies.
void encodeEnd(const TrialLink& last, ByteWriter& out);
TrialLink decodeEnd(std::span<const std::uint8_t> payload);
inline constexpr std::size_t kEndPayloadBytes = 12;

}  // namespace reachlab::record
