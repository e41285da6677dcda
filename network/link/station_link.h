#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "network/link/link_memory.h"

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
struct StationStatus {
  enum class Light { Absent, Stop, Fair, Good };  // Fair: more than half of what is allowed
  int station = 0;                                // from 1
  Light light = Light::Absent;
  bool conductor = false;
  std::string name, software, device;  // empty: never heard of
  bool heard = false;                  // it sends, and what follows is known
  double roundTrip = 0, jitter = 0;    // [s]
  double loss = 0;                     // share of what it sends that does not come
  double overtaken = 0;                // share of its samples that came after a newer one
  double offset = 0;                   // [s] its clock less ours
  double age = 0;                      // [s] since its newest sample came
  std::vector<std::string> obstacles;  // why no trial may be armed with it, with the numbers
};

/// What must be equal at all stations, as a number: the experiment without its file's text.
std::uint64_t sharedHash(const experiment::Experiment& experiment);

/// A station's end of the link: the rings in memory, and the endpoint's process, which ends with this. Controlling thread, but for the
/// memory's rings.
class StationLink {
 public:
  /// Makes the memory and starts the endpoint. Throws ResourceError.
  StationLink(const StationOptions& options, std::uint64_t experiment);
  ~StationLink();
  StationLink(const StationLink&) = delete;
  StationLink& operator=(const StationLink&) = delete;

  LinkMemory& memory() { return *memory_; }
  void send(const LinkEvent& event);
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
  /// Why a trial may not be armed: who is missing, differs, or has too poor a link; one sentence each, with the numbers. Empty: it may.
  std::vector<std::string> obstacles() const;
  /// One line a station: name, device, round trip, jitter, loss, offset.
  std::string describe() const;
  /// Every other station, as it stands now.
  std::vector<StationStatus> statuses() const;
  /// Whether that station, from 1, says that it conducts; nullopt while it has not said who it is.
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
  /// What a clock is against ours, and when it last jumped.
  struct Offset {
    double value = 0, jump = 0;  // [s]
    std::int64_t sinceNs = 0, jumpNs = 0;
  };
  std::array<Offset, kMaxStations> offsets_{};
};

}  // namespace reachlab::network
