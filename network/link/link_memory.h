#pragma once
#include <array>
#include <atomic>
#include <cstdint>

#include "base/system/spsc_queue.h"
#include "network/coupled_copy.h"
#include "sim/trial/outcome.h"
#include "sim/trial/planned_trial.h"

/// The memory that a station and its endpoint share: rings that both processes map. Neither process ever waits for the other. Plain and of
/// fixed size. Both processes are built from this header, and `version` identifies it.
namespace reachlab::network {

/// This station's state at a tick, for sending.
struct OwnState {
  std::int64_t timeNs = 0;  // monotonic clock
  std::int32_t trial = 0;
  std::uint8_t phase = 0;               // trial::Phase
  std::uint32_t places = 0, rates = 0;  // number of places and rates in the sample
  CopySample sample;
};
/// A peer's state as it arrived, with its time on this station's clock.
struct HeardState {
  std::int32_t trial = 0;
  std::uint8_t phase = 0;
  double roundTrip = -1;  // [s]; below 0: not known yet
  CopySample sample;
};

struct LinkEvent {
  enum class Kind : std::uint8_t {
    Arm,        // the conductor: prepare this trial
    Ended,      // any station: how its trial has ended
    Interrupt,  // the conductor: end the trial under way
    Finish,     // the conductor: no more trials
  };
  std::uint32_t station = 0;  // from 1
  Kind kind = Kind::Arm;
  std::int32_t trial = 0;
  trial::PlannedTrial planned;
  double frequency = 0;  // [rad/s] omega_o of the armed trial; 0: the default of the object
  trial::Outcome outcome = trial::Outcome::None;
  trial::Reason reason = trial::Reason::None;
  double apart = 0;  // [m] at the end
};

/// The identity of a station, as it reports it. Texts end with a zero.
struct StationCard {
  std::uint32_t station = 0;  // from 1; 0: only observes
  std::uint32_t version = 0;  // of the messages
  std::uint64_t experiment = 0;
  bool conductor = false;
  std::array<char, 65> name{}, software{};
  std::array<char, 97> device{};
};

/// The quality of the link to one station, written by the endpoint. Numbers that are read together may come from neighbouring moments.
struct LinkStatus {
  std::atomic<double> roundTrip{-1};  // [s] the newest; -1: not known
  std::atomic<double> jitter{0};      // [s] SD of the round trip over the last samples
  std::atomic<double> offset{0};      // [s] the peer's clock less ours, from the fastest recent exchange
  std::atomic<double> loss{0};        // share of its samples that do not arrive, over two or ten seconds, whichever is more
  std::atomic<double> lossBound{1};   // the most that the loss may be; 1: not known
  std::atomic<double> overtaken{0};   // share of a second's samples that came after a newer sample and were not used
  std::atomic<double> gap{0};         // [s] longest time without a sample in the last second
  std::atomic<std::int64_t> heardNs{0};
};
static_assert(std::atomic<double>::is_always_lock_free && std::atomic<std::size_t>::is_always_lock_free);

/// The configuration of the endpoint, written by the station before it starts the endpoint. Texts end with a zero.
struct EndpointSettings {
  static constexpr std::size_t kPath = 512, kAddress = 64, kAddresses = 16;
  StationCard card;
  int domain = 0;
  std::array<char, kPath> secure{};                            // folder of certificates; empty: nothing is encrypted
  std::array<char, kAddress> interface {};                     // network interface; empty: the system's choice
  std::array<std::array<char, kAddress>, kAddresses> peers{};  // addresses; the first empty one ends the list
};

struct LinkMemory {
  static constexpr std::uint32_t kVersion = 5;
  std::uint32_t version = kVersion;
  EndpointSettings settings;
  std::atomic<bool> stop{false};
  std::atomic<std::int64_t> aliveNs{0};  // the endpoint's last round
  SpscQueue<OwnState, 64> out;
  std::array<SpscQueue<HeardState, 64>, kMaxStations> in;  // by station, from 0; the queue of this station stays empty
  SpscQueue<LinkEvent, 64> eventsOut, eventsIn;
  SpscQueue<StationCard, 32> cardsIn;
  std::array<LinkStatus, kMaxStations> status;
  std::atomic<std::uint64_t> ringsFull{0};       // samples that found no room
  std::atomic<std::uint64_t> discardedBytes{0};  // bytes of states that came twice or after newer states, dropped by the endpoint's reader
};

}  // namespace reachlab::network
