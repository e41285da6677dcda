#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "network/coupled_copy.h"
#include "sim/record/log/log.h"
#include "sim/record/log/run_log.h"

/// The samples and orders that a station's copy received between two ticks, as the station's log keeps them.
namespace reachlab::network {

struct GivenSample {
  /// An order to the copy takes the place of the peer and holds from this tick on. Its value is stored as the round trip.
  static constexpr std::int32_t kFrequency = -1;  // another omega_o [rad/s]
  static constexpr std::int32_t kBrokenOff = -2;  // the peer of this number has broken the trial off
  std::uint64_t tick = 0;
  std::int32_t peer = 0;  // of the copy
  double roundTrip = -1;  // [s]
  CopySample sample;

  /// Gives the sample or the order to the copy.
  void giveTo(CoupledCopy& copy) const noexcept;
};

/// The payload of a record: the station of the log (from 0), the number of coordinates per sample, and the samples.
struct GivenRecord {
  int own = -1;
  std::uint32_t places = 0, rates = 0;
  std::vector<GivenSample> samples;
};
std::vector<std::uint8_t> encodeGiven(GivenRecord record);
/// Throws FaultError for a payload of an unknown form.
GivenRecord decodeGiven(std::span<const std::uint8_t> payload);

/// True for the log of a station, which has fewer hands than its experiment.
bool isOfStation(const record::RunLog& log);
/// All samples and orders of a log, in the order in which the copy received them. If the log holds no samples, own is -1.
GivenRecord readGiven(const record::RunLog& log);
/// The samples of the other stations, without the orders.
std::vector<GivenSample> givenSamples(const record::RunLog& log);

}  // namespace reachlab::network
