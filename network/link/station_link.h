#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "network/link/link_memory.h"

namespace reachlab::network {

/// The settings of a station in its laboratory.
struct StationOptions {
  int station = 1;  // from 1: the hand of the experiment at this station
  int stations = 2;
  bool conductor = false;
  std::string name, device, software;
  std::string endpoint;            // program of the endpoint
  std::string secure;              // folder of this station's certificates; empty: nothing is encrypted
  std::string interface;           // network interface; empty: the system's choice
  std::vector<std::string> peers;  // addresses beyond one network; then no multicast
  int domain = 0;                  // stations of one domain hear each other
};

/// The relation of another station to this station.
struct StationStatus {
  enum class Light { Absent, Stop, Fair, Good };  // Fair: more than half of the allowed value
  int station = 0;                                // from 1
  Light light = Light::Absent;
  bool conductor = false;
  std::string name, software, device;  // empty: never heard
  bool heard = false;                  // it sends, so the values below are known
  double roundTrip = 0, jitter = 0;    // [s]
  double loss = 0;                     // share of its samples that do not arrive
  double lossBound = 1;                // the most that this share may be, as far as the samples tell
  double overtaken = 0;                // share of its samples that came after a newer sample
  double offset = 0;                   // [s] its clock less ours
  double age = 0;                      // [s] since its newest sample came
  std::vector<std::string> obstacles;  // reasons why no trial may be armed with it, with the numbers
};

/// A number for the part that must be equal at all stations: the experiment without its file's text.
std::uint64_t sharedHash(const experiment::Experiment& experiment);

/// A station's end of the link: the rings in memory and the process of the endpoint. The process ends with this object. Controlling thread,
/// except for the memory's rings.
class StationLink {
 public:
  /// Makes the memory and starts the endpoint. Throws ResourceError.
  StationLink(const StationOptions& options, std::uint64_t experiment);
  ~StationLink();
  StationLink(const StationLink&) = delete;
  StationLink& operator=(const StationLink&) = delete;

  LinkMemory& memory() { return *memory_; }
  void send(const LinkEvent& event);
  /// Reads the cards that have arrived. Call it now and then.
  void look();
  /// False after the endpoint has ended, or when it has not run for a second.
  bool endpointAlive() const;
  /// Time [s] since the conductor was last heard. Infinite without a conductor.
  double conductorSilence() const;
  /// The end of the endpoint in a few words, if nobody asked it to end. Empty while it runs.
  std::string endpointFault() const;
  /// Asks the endpoint to end and waits for it. Returns a sentence if it did not end in order. A second call has no effect. The destructor
  /// calls it, too.
  std::string finish();
  /// The reasons why a trial may not be armed: a missing station, a difference, or a poor link. One sentence each, with the numbers. Empty:
  /// the trial may be armed.
  std::vector<std::string> obstacles() const;
  /// One line per station: name, device, round trip, jitter, loss, offset.
  std::string describe() const;
  /// The present state of every other station.
  std::vector<StationStatus> statuses() const;
  /// Whether that station (from 1) says that it conducts. nullopt while it has not yet sent its identity.
  std::optional<bool> isConductor(std::uint32_t station) const;

 private:
  StationStatus statusOf(int station) const;

  StationOptions options_;
  std::uint64_t experiment_;
  std::string memoryName_;
  LinkMemory* memory_ = nullptr;
  int process_ = -1;
  std::array<StationCard, kMaxStations> cards_{};
  std::array<std::int64_t, kMaxStations> cardNs_{};
  /// The offset of a clock from ours, and the time of its last jump.
  struct Offset {
    double value = 0, jump = 0;  // [s]
    std::int64_t sinceNs = 0, jumpNs = 0;
  };
  std::array<Offset, kMaxStations> offsets_{};
};

}  // namespace reachlab::network
