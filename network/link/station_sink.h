#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <vector>

#include "base/system/triple_buffer.h"
#include "network/link/given_samples.h"
#include "network/link/link_channels.h"
#include "network/link/link_memory.h"
#include "sim/haptics/run_sink.h"
#include "sim/record/log/recorder.h"

namespace reachlab::network {

/// [s] The time of the clock at the end of the next tick.
double timeAfter(const haptics::TickState& state) noexcept;

/// The positions of the other stations' hands, by their newest samples.
struct OtherHands {
  std::array<Vec3, kMaxStations> place{};  // [m] by station, from 0
  std::array<bool, kMaxStations> known{};
};

/// How a copy stood to the others in one trial, over all peers.
struct TowardsOthers {
  double mostApart = 0, rmsApart = 0;  // [m] largest distance from another copy, and its root mean square
  double lastApart = 0;                // [m] at the latest tick of the movement, when the trial was judged
  double oldest = 0;                   // [s] age of the oldest used sample
  std::uint64_t fadedTicks = 0;        // with less than the full coupling to a peer
  std::uint64_t repeated = 0;          // samples that were no newer than an earlier sample
};

/// Connects the haptic thread with the rings. It sends this station's state every tick, and it passes new samples to the copy before the
/// next tick. It allocates nothing and never waits.
class StationSink final : public haptics::RunSink, public record::FurtherColumns {
 public:
  /// All arguments outlive the sink's use. `own` counts from 0. One tick in `sendEvery` is sent.
  StationSink(LinkMemory& memory, CoupledCopy& copy, int own, int sendEvery = 1)
      : memory_(memory), copy_(copy), own_(own), sendEvery_(sendEvery), places_(static_cast<std::uint32_t>(copy.placeCount())),
        rates_(static_cast<std::uint32_t>(copy.rateCount())), linkColumns_(linkColumns(copy.peerCount())),
        given_(std::make_unique<SpscQueue<GivenSample, kGivenRoom>>()) {}
  bool onTick(const haptics::TickState& state, trial::Command command, std::uint32_t missedTicks) noexcept override;
  /// For the latest tick.
  void fill(double* columns) const noexcept override { std::copy_n(links_.begin(), linkColumns_, columns); }

  /// Controlling thread, between trials. Sets omega_o [rad/s] from the next tick on.
  void synchroniseBy(double frequency) noexcept { frequency_.store(frequency, std::memory_order_release); }

  /// Controlling thread. That station (from 1) has broken off the trial, as the stations count trials. So this copy loses it.
  void breakOff(int station, std::int32_t trial) noexcept {
    brokenOff_.store(std::int64_t{trial} << 8 | peerOf(station - 1), std::memory_order_release);
  }

  /// Controlling thread. From the next tick on the copy receives nothing more, so that the log can contain every given sample.
  void stopGiving() noexcept { givesNoMore_.store(true, std::memory_order_release); }
  /// True after the haptic thread has noticed it.
  bool hasStoppedGiving() const noexcept { return gaveLast_.load(std::memory_order_acquire); }

  /// Controlling thread, now and then. Returns the samples given since the last call as the payload of a record, or an empty text. Only
  /// `places` coordinates are kept. The first payload names the station of the log, even without samples.
  std::vector<std::uint8_t> takeGiven();

  /// Controlling thread. The present positions of the other hands, in a trial or not. Null when nothing has come since the last call.
  const OtherHands* takeOtherHands() noexcept { return hands_.takeLatest(); }

  /// Controlling thread, before a trial is prepared. The difference between the stations' count of trials and this engine's count. This
  /// engine may have started later.
  void countTrialsFrom(std::int32_t before) noexcept { trialsBefore_.store(before, std::memory_order_release); }

  /// Controlling thread. How this copy stood to the others in the latest trial.
  const TowardsOthers& towardsOthers() noexcept;

 private:
  static constexpr std::size_t kGivenRoom = 4096;                                            // samples
  int peerOf(int station) const noexcept { return station < own_ ? station : station - 1; }  // from 0
  bool give(const GivenSample& given) noexcept;
  void giveOrders(const haptics::TickState& state, std::int32_t trial) noexcept;
  void noteApart(const haptics::TickState& state) noexcept;
  void takeHeard(const haptics::TickState& state, std::int32_t trial, bool gives) noexcept;
  void send(const haptics::TickState& state, std::int32_t trial) noexcept;
  std::uint64_t repeatedNow() const noexcept;

  LinkMemory& memory_;
  CoupledCopy& copy_;
  int own_, sendEvery_;
  std::uint32_t places_, rates_;  // of the copy, which the haptic thread owns once it runs
  std::size_t linkColumns_;
  std::array<double, kMostLinkColumns> links_{};
  std::unique_ptr<SpscQueue<GivenSample, kGivenRoom>> given_;
  std::uint32_t sequence_ = 0;
  std::int32_t trial_ = 0;
  double squares_ = 0;
  std::uint64_t count_ = 0;
  TowardsOthers towards_;  // for the haptic thread
  TripleBuffer<TowardsOthers> toldTowards_;
  TowardsOthers knownTowards_;        // for the controlling thread
  std::atomic<double> frequency_{0};  // [rad/s] as requested; 0: the default of the object
  double frequencyNow_ = 0;
  std::uint64_t repeatedBefore_ = 0;
  std::atomic<std::int32_t> trialsBefore_{0};
  std::atomic<std::int64_t> brokenOff_{0};  // trial and peer; 0: no trial
  std::atomic<bool> givesNoMore_{false}, gaveLast_{false};
  bool said_ = false;  // the log already names its station
  OtherHands seen_;    // for the haptic thread
  TripleBuffer<OtherHands> hands_;
};

}  // namespace reachlab::network
