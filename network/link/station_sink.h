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

/// [s] What the clock shows at the end of the tick to come.
double timeAfter(const haptics::TickState& state) noexcept;

/// Where the other stations' hands were by their newest samples.
struct OtherHands {
  std::array<Vec3, kMaxStations> place{};  // [m] by station, from 0
  std::array<bool, kMaxStations> known{};
};

/// Between the haptic thread and the rings: sends this station's state every tick, and hands what came to the copy before the next. It allocates
/// nothing and waits for nothing.
class StationSink final : public haptics::RunSink, public record::FurtherColumns {
 public:
  /// All outlive the sink's use. `own`: from 0. Of the ticks one in `sendEvery` is sent.
  StationSink(LinkMemory& memory, CoupledCopy& copy, int own, int sendEvery = 1)
      : memory_(memory), copy_(copy), own_(own), sendEvery_(sendEvery), places_(static_cast<std::uint32_t>(copy.placeCount())),
        rates_(static_cast<std::uint32_t>(copy.rateCount())), linkColumns_(linkColumns(copy.peerCount())),
        given_(std::make_unique<SpscQueue<GivenSample, 4096>>()) {}
  bool onTick(const haptics::TickState& state, trial::Command command, std::uint32_t missedTicks) noexcept override;
  void announce(std::int32_t, const trial::PlannedTrial&) override {}
  void awaitTrial(std::int32_t) override {}
  void close() override {}
  /// Of the latest tick.
  void fill(double* columns) const noexcept override { std::copy_n(links_.begin(), linkColumns_, columns); }

  /// Controlling thread, between trials: omega_o [rad/s] from the next tick on.
  void synchroniseBy(double frequency) noexcept { frequency_.store(frequency, std::memory_order_release); }

  /// Controlling thread: that station, from 1, has broken the trial off (as the stations count them); so this copy loses it.
  void breakOff(int station, std::int32_t trial) noexcept {
    brokenOff_.store(std::int64_t{trial} << 8 | peerOf(station - 1), std::memory_order_release);
  }

  /// Controlling thread: from the next tick on nothing is given to the copy any more, so that the log can have all that was.
  void stopGiving() noexcept { givesNoMore_.store(true, std::memory_order_release); }
  /// The haptic thread has heard of it.
  bool hasStoppedGiving() const noexcept { return gaveLast_.load(std::memory_order_acquire); }

  /// Controlling thread, now and then: what was given since, as the payload of a record; empty: nothing. Only `places` coordinates are kept.
  /// The first says whose log it is, be anything given or not.
  std::vector<std::uint8_t> takeGiven();

  /// Controlling thread: the other hands as they are now, in a trial or not; null: nothing has come since.
  const OtherHands* takeOtherHands() noexcept { return hands_.takeLatest(); }

  /// Controlling thread, before a trial is put up: what the stations count more than this engine, which may have come later.
  void countTrialsFrom(std::int32_t before) noexcept { trialsBefore_.store(before, std::memory_order_release); }

  /// The largest distance between this copy and another in the latest trial, and samples of it that were lost for want of room. Any thread.
  double mostApart() const noexcept { return mostApart_.load(std::memory_order_relaxed); }
  double rmsApart() const noexcept { return rmsApart_.load(std::memory_order_relaxed); }
  /// The same at the latest tick of the movement: how far apart the copies were when the trial was judged.
  double lastApart() const noexcept { return lastApart_.load(std::memory_order_relaxed); }
  /// Of the latest trial, over all peers: ticks at which one was held by less than its full coupling, the oldest sample in force [s], and
  /// samples that were no newer than one before. Any thread.
  std::uint64_t fadedTicks() const noexcept { return fadedTicks_.load(std::memory_order_relaxed); }
  double oldest() const noexcept { return oldest_.load(std::memory_order_relaxed); }
  std::uint64_t repeated() const noexcept { return repeated_.load(std::memory_order_relaxed); }

 private:
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
  std::uint32_t places_, rates_;  // of the copy, which is the haptic thread's once it runs
  std::size_t linkColumns_;
  std::array<double, kMostLinkColumns> links_{};
  std::unique_ptr<SpscQueue<GivenSample, 4096>> given_;
  std::uint32_t sequence_ = 0;
  std::int32_t trial_ = 0;
  double squares_ = 0;
  std::uint64_t count_ = 0;
  std::atomic<double> mostApart_{0}, rmsApart_{0}, lastApart_{0}, oldest_{0};  // [m], [m], [m], [s]
  std::atomic<double> frequency_{0};                                           // [rad/s] as asked for; 0: as the object has it
  double frequencyNow_ = 0;
  std::atomic<std::uint64_t> fadedTicks_{0}, repeated_{0};
  std::uint64_t repeatedBefore_ = 0;
  std::atomic<std::int32_t> trialsBefore_{0};
  std::atomic<std::int64_t> brokenOff_{0};  // trial and peer; 0: none
  std::atomic<bool> givesNoMore_{false}, gaveLast_{false};
  bool said_ = false;  // whose log it is
  OtherHands seen_;    // the haptic thread's
  TripleBuffer<OtherHands> hands_;
};

}  // namespace reachlab::network
