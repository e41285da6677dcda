#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "sim/record/log/log.h"
#include "sim/record/log/run_log.h"

/// Payloads of the log's records, to bytes and back (docs/recording.md). Decoding throws FaultError on bytes that no writer makes.
namespace reachlab::record {

/// Puts the members of a record in their order. An enumerator is one byte, and so are up to eight marks.
struct PutMembers {
  ByteWriter& out;
  template <class... Members>
  void operator()(const Members&... members) const {
    (put(members), ...);
  }
  void marks(std::same_as<bool> auto... marks) const {
    unsigned bits = 0, bit = 1;
    ((bits |= marks ? bit : 0u, bit <<= 1), ...);
    out.put(static_cast<std::uint8_t>(bits));
  }

 private:
  void put(const std::string& text) const { out.putText(text); }
  template <class T>
  void put(const T& value) const {
    if constexpr (std::is_enum_v<T>) out.put(static_cast<std::uint8_t>(value));
    else out.put(value);
  }
};

/// Gets them again. An enumerator that there is not counts as a read beyond the end.
struct GetMembers {
  ByteReader& in;
  template <class... Members>
  void operator()(Members&... members) const {
    (get(members), ...);
  }
  void marks(std::same_as<bool> auto&... marks) const {
    unsigned bits = in.get<std::uint8_t>();
    ((marks = (bits & 1) != 0, bits >>= 1), ...);
  }

 private:
  static constexpr EventKind lastOf(EventKind) { return kLastEventKind; }
  static constexpr trial::Outcome lastOf(trial::Outcome) { return trial::Outcome::Interrupted; }
  static constexpr trial::Reason lastOf(trial::Reason) { return trial::kLastReason; }
  void get(std::string& text) const { text = in.getText(); }
  template <class T>
  void get(T& value) const {
    if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(in.get<std::uint8_t>());
      if (value > lastOf(value)) in.fail();
    } else {
      value = in.get<T>();
    }
  }
};

/// A payload that grows entry by entry behind its count.
class Block {
 public:
  bool empty() const { return count_ == 0; }
  std::uint32_t count() const { return count_; }
  /// The payload so far. Call `clear` before the next block.
  std::span<const std::uint8_t> payload();
  void clear();

 protected:
  ByteWriter bytes_;
  std::uint32_t count_ = 0;
};

/// Collects the ticks of one block.
class TickBlock : public Block {
 public:
  /// `device`: the first hand's sample.
  void add(const TickStamp& tick, const haptics::DeviceSample& device);

 private:
  TickStamp last_;
  Vec3 lastPosition_;  // [m]
};
void decodeTicks(std::span<const std::uint8_t> payload, std::vector<RecordedTick>& out);

/// Collects a further hand's raw samples, one for each tick of the block of ticks that goes before it.
class HandBlock : public Block {
 public:
  /// `hand` from 2.
  explicit HandBlock(int hand) : hand_(hand) {}
  void add(const haptics::DeviceSample& sample);

 private:
  int hand_;
  Vec3 last_;  // [m]
};
/// The samples and whose they are, from 2.
struct HandTicks {
  int hand = 0;
  std::vector<haptics::DeviceSample> samples;
};
HandTicks decodeHandTicks(std::span<const std::uint8_t> payload);

/// Collects rows of the derived channels.
class SampleBlock : public Block {
 public:
  explicit SampleBlock(std::size_t columns) : columns_(columns) {}
  void add(std::uint64_t tick, const double* row);

 private:
  std::size_t columns_;
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
void encode(const TrialLink& last, ByteWriter& out);
TrialLink decodeEnd(std::span<const std::uint8_t> payload);
inline constexpr std::size_t kEndPayloadBytes = 12;

}  // namespace reachlab::record
