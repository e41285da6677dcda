#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "network/coupled_copy.h"
#include "sim/record/log/log.h"
#include "sim/record/log/run_log.h"

/// What a station's copy was given between two ticks, as the station's log keeps it: the other stations' samples, and what was ordered.
namespace reachlab::network {

struct GivenSample {
  /// In a peer's place, an order to the copy that holds from this tick on; its value stands in the round trip's.
  static constexpr std::int32_t kFrequency = -1;  // another omega_o [rad/s]
  static constexpr std::int32_t kBrokenOff = -2;  // the peer of this number has broken the trial off
  std::uint64_t tick = 0;
  std::int32_t peer = 0;  // of the copy
  double roundTrip = -1;  // [s]
  CopySample sample;

  /// To the copy, as it was told after its tick.
  void giveTo(CoupledCopy& copy) const noexcept;
};

/// The payload of a record: whose log it is (from 0), how many coordinates of a sample are kept, and the samples.
struct GivenRecord {
  int own = -1;
  std::uint32_t places = 0, rates = 0;
  std::vector<GivenSample> samples;
};
void beginGiven(record::ByteWriter& out, int own, std::uint32_t places, std::uint32_t rates);
void addGiven(record::ByteWriter& out, const GivenSample& given, std::uint32_t places, std::uint32_t rates);
void endGiven(record::ByteWriter& out, std::uint32_t count);
/// Throws FaultError: a payload of an unknown form.
GivenRecord decodeGiven(std::span<const std::uint8_t> payload);

/// True for the log of a station: it has fewer hands than its experiment.
bool isOfStation(const record::RunLog& log);
/// All that a log holds of it, in the order in which the copy was given it; own -1: nothing.
GivenRecord readGiven(const record::RunLog& log);
/// Whose log it is, from 1; 0 where it holds nothing of the other stations.
int recordedStation(const record::RunLog& log);
/// What the others sent, without the orders.
std::vector<GivenSample> givenSamples(const record::RunLog& log);

}  // namespace reachlab::network
