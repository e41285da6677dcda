#pragma once
#include <array>
#include <atomic>
#include <cstdint>

#include "base/system/spsc_queue.h"
#include "network/coupled_copy.h"
#include "sim/trial/outcome.h"
#include "sim/trial/planned_trial.h"

/// What a station and its endpoint share: rings in memory that both processes map. Neither side ever waits for the other. Plain and of fixed
/// size; both are built from this header, and `version` says so.
namespace reachlab::network {

/// This station's own state at a tick, to be sent.
struct OwnState {
  std::int64_t timeNs = 0;  // monotonic clock
  std::int32_t trial = 0;
  std::uint8_t phase = 0;               // trial::Phase
  std::uint32_t places = 0, rates = 0;  // of the sample, that there are
  CopySample sample;
};
/// A peer's, as it came: its time on this station's clock.
struct HeardState {
  std::int32_t trial = 0;
  std::uint8_t phase = 0;
  double roundTrip = -1;  // [s]; below 0: not known yet
  CopySample sample;
};

struct LinkEvent {
  enum class Kind : std::uint8_t {
    Arm,        // the conductor: put this trial up
    Ended,      // any station: its trial has ended so
    Interrupt,  // the conductor: end the trial under way
    Finish,     // the conductor: no more trials
  };
  std::uint32_t station = 0;  // from 1
  Kind kind = Kind::Arm;
  std::int32_t trial = 0;
  trial::PlannedTrial planned;
  double frequency = 0;  // [rad/s] omega_o of the trial that is armed; 0: as the object has it
  trial::Outcome outcome = trial::Outcome::None;
  trial::Reason reason = trial::Reason::None;
  double apart = 0;  // [m] at the end
};

/// Who a station says it is. Texts end with a zero.
struct StationCard {
  std::uint32_t station = 0;  // from 1; 0 only observes
  std::uint32_t version = 0;  // of the messages
  std::uint64_t experiment = 0;
  bool conductor = false;
  std::array<char, 65> name{}, software{};
  std::array<char, 97> device{};
};

/// How the link to one station is, written by the endpoint; numbers of one moment may be of neighbouring ones.
struct LinkStatus {
  std::atomic<double> roundTrip{-1};  // [s] the newest; -1: not known
  std::atomic<double> jitter{0};      // [s] SD of the round trip over the last samples
  std::atomic<double> offset{0};      // [s] the peer's clock less ours, of the fastest exchange lately
  std::atomic<double> loss{0};        // share of what it sends that does not come, of the last two seconds
  std::atomic<double> overtaken{0};   // share of a second's samples that came after a newer one, and were not used
  std::atomic<double> gap{0};         // [s] the longest that nothing came in the last second
  std::atomic<std::int64_t> heardNs{0};
};
static_assert(std::atomic<double>::is_always_lock_free && std::atomic<std::size_t>::is_always_lock_free);

/// What the endpoint is to be, written by the station before it starts it. Texts end with a zero.
struct EndpointSettings {
  static constexpr std::size_t kPath = 512, kAddress = 64, kAddresses = 16;
  StationCard card;
  int domain = 0;
  std::array<char, kPath> secure{};                            // folder of certificates; empty: nothing is encrypted
  std::array<char, kAddress> interface {};                     // of the network; empty: the system's choice
  std::array<std::array<char, kAddress>, kAddresses> peers{};  // addresses; the first empty one ends the list
};

struct LinkMemory {
  static constexpr std::uint32_t kVersion = 4;
  std::uint32_t version = kVersion;
  EndpointSettings settings;
  std::atomic<bool> stop{false};
  std::atomic<std::int64_t> aliveNs{0};  // the endpoint's last round
  SpscQueue<OwnState, 64> out;
  std::array<SpscQueue<HeardState, 64>, kMaxStations> in;  // by station, from 0; one's own stays empty
  SpscQueue<LinkEvent, 64> eventsOut, eventsIn;
  SpscQueue<StationCard, 32> cardsIn;
  std::array<LinkStatus, kMaxStations> status;
  std::atomic<std::uint64_t> ringsFull{0};       // samples that found no room
  std::atomic<std::uint64_t> discardedBytes{0};  // of states that came twice or after newer ones, dropped by the endpoint's reader
};

}  // namespace reachlab::network
