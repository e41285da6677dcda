#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/system/triple_buffer.h"
#include "network/line/line_memory.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/run_sink.h"
#include "sim/haptics/tick_engine.h"
#include "sim/record/log/recorder.h"
#include "sim/record/replay.h"

namespace reachlab::network {

/// How a station stands in its laboratory.
struct StationOptions {
  int station = 1;  // from 1: which of the experiment's hands is here
  int stations = 2;
  bool conductor = false;
  std::string name, device, software;
  std::string endpoint;            // the endpoint's program
  std::string secure;              // folder of this station's certificates; empty: nothing is encrypted
  std::string interface;           // of the network; empty: the system's choice
  std::vector<std::string> peers;  // addresses beyond one network; then no multicast
  int domain = 0;                  // stations of one domain hear each other
};

/// How another station stands to this one.
struct StationStanding {
  enum class Light { Absent, Stop, Fair, Good };  // Fair: more than half of what is allowed
  int station = 0;                                // from 1
  Light light = Light::Absent;
  bool conductor = false;
  std::string name, software, device;  // empty: never heard of
  bool heard = false;                  // it sends, and what follows is known
  double roundTrip = 0, jitter = 0;    // [s]
  double loss = 0;                     // share of a second's samples
  double offset = 0;                   // [s] its clock less ours
  double age = 0;                      // [s] since its newest sample came
  std::vector<std::string> obstacles;  // why no trial may be armed with it, with the numbers
};

/// What must be equal at all stations, as a number: the experiment without its file's text.
std::uint64_t sharedHash(const experiment::Experiment& experiment);

/// A station's end of the line: the rings in memory, and the endpoint's process, which ends with this. Controlling thread, but for the
/// memory's rings.
class StationLine {
 public:
  /// Makes the memory and starts the endpoint. Throws ResourceError.
  StationLine(const StationOptions& options, std::uint64_t experiment);
  ~StationLine();
  StationLine(const StationLine&) = delete;
  StationLine& operator=(const StationLine&) = delete;

  LineMemory& memory() { return *memory_; }
  void send(const LineEvent& event);
  /// Reads cards that have come; call it now and then.
  void look();
  /// False once the endpoint has ended, or has not done a round for a second.
  bool endpointAlive() const;
  /// Since the conductor was last heard of [s]; infinite where none was.
  double conductorSilence() const;
  /// How the endpoint ended, in a few words, where it was not asked to; empty while it runs.
  std::string endpointFault() const;
  /// Asks the endpoint to end and waits for it; a sentence where it did not end in order. Idempotent, also done by the destructor.
  std::string finish();
  /// Why a trial may not be armed: who is missing, differs, or has too poor a line; one sentence each, with the numbers. Empty: it may.
  std::vector<std::string> obstacles() const;
  /// One line a station: name, device, round trip, jitter, loss, offset.
  std::string describe() const;
  /// Every other station, as it stands now.
  std::vector<StationStanding> standings() const;
  /// Whether that station, from 1, says that it conducts; nullopt while it has not said who it is.
  std::optional<bool> isConductor(std::uint32_t station) const;

 private:
  StationStanding standingOf(int station) const;

  StationOptions options_;
  std::uint64_t experiment_;
  std::string memoryName_;
  LineMemory* memory_ = nullptr;
  int process_ = -1;
  std::array<StationCard, kMaxStations> cards_{};
  std::array<std::int64_t, kMaxStations> cardNs_{};
  /// What a clock is against ours, and when it last jumped.
  struct Offset {
    double value = 0, jump = 0;  // [s]
    std::int64_t sinceNs = 0, jumpNs = 0;
  };
  std::array<Offset, kMaxStations> offsets_{};
};

/// A peer's sample as it was given to the copy after a tick: what the log keeps of it.
struct GivenSample {
  /// In a peer's place: from this tick on the copy has another omega_o, which stands in the round trip's.
  static constexpr std::int32_t kFrequency = -1;
  std::uint64_t tick = 0;
  std::int32_t peer = 0;  // of the copy
  double roundTrip = -1;  // [s]
  CopySample sample;
};

/// How a station's copy stands to the others, as channels of a recording: its ledger; of every other station, in their order, how far the
/// two copies are apart, the newest sample's age, fade, synchronisation, round trip and loss. `station`: from 1, of so many.
std::vector<record::Channel> lineChannels(int station, int stations);
/// How many they are with so many peers; so it is also where those of the next peer begin, with how far the copies are apart.
constexpr std::size_t lineColumns(int peers) { return 1 + 6 * static_cast<std::size_t>(peers); }
inline constexpr std::size_t kMostLineColumns = lineColumns(kMaxStations - 1);
/// What stands in them after a tick, before what came then is taken; NaN: not known.
void fillLines(const CoupledCopy& copy, double* columns) noexcept;

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
  StationSink(LineMemory& memory, CoupledCopy& copy, int own, int sendEvery = 1)
      : memory_(memory), copy_(copy), own_(own), sendEvery_(sendEvery), places_(static_cast<std::uint32_t>(copy.placeCount())),
        rates_(static_cast<std::uint32_t>(copy.rateCount())), lineColumns_(lineColumns(copy.peerCount())),
        given_(std::make_unique<SpscQueue<GivenSample, 4096>>()) {}
  bool onTick(const haptics::TickState& state, trial::Command command, std::uint32_t missedTicks) noexcept override;
  void announce(std::int32_t, const trial::PlannedTrial&) override {}
  void awaitTrial(std::int32_t) override {}
  void close() override {}
  /// Of the latest tick.
  void fill(double* columns) const noexcept override { std::copy_n(lines_.begin(), lineColumns_, columns); }

  /// Controlling thread, between trials: omega_o [rad/s] from the next tick on.
  void synchroniseBy(double frequency) noexcept { frequency_.store(frequency, std::memory_order_release); }

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
  std::uint64_t repeatedNow() const noexcept;

  LineMemory& memory_;
  CoupledCopy& copy_;
  int own_, sendEvery_;
  std::uint32_t places_, rates_;  // of the copy, which is the haptic thread's once it runs
  std::size_t lineColumns_;
  std::array<double, kMostLineColumns> lines_{};
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
  std::atomic<bool> givesNoMore_{false}, gaveLast_{false};
  bool said_ = false;  // whose log it is
  OtherHands seen_;    // the haptic thread's
  TripleBuffer<OtherHands> hands_;
};

/// True for the log of a station: it has fewer hands than its experiment.
bool isOfStation(const record::RunLog& log);
/// Whose log it is, from 1; 0 where it holds nothing of the other stations.
int recordedStation(const record::RunLog& log);
/// What the others sent, in the order in which the copy was given it.
std::vector<GivenSample> givenSamples(const record::RunLog& log);
/// A station's run again, from its own log: its hand's samples and what the others sent. `look` sees every tick, before what came then is
/// taken. Throws as record::replayRun.
using LookAtCopy = std::function<void(const haptics::TickState& state, const CoupledCopy& copy)>;
record::Replay replayStation(const record::RunLog& log, const LookAtCopy& look = {});

/// The engine of one station: its own hand on its copy of the object. `copy` becomes the engine's. Throws what CoupledCopy throws.
std::unique_ptr<haptics::TickEngine> makeStationEngine(const experiment::CompiledExperiment& experiment, int own,
                                                       const haptics::EngineOptions& options, CoupledCopy*& copy);

}  // namespace reachlab::network
