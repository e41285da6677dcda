#include "devices/make_device.h"

#include "base/error.h"
#include "devices/replayed_reach.h"
#include "devices/simulated_hand.h"
#include "sim/trial/protocol.h"

namespace reachlab::devices {

std::unique_ptr<haptics::HapticDevice> makeDevice(const std::string& spec, const experiment::Experiment& experiment, std::uint64_t seed) {
  const std::size_t colon = spec.find(':');
  const std::string name = spec.substr(0, colon), argument = colon == std::string::npos ? "" : spec.substr(colon + 1);
  if (name == "simulated") return makeSimulatedHand(experiment, parseSubject(argument), seed);
  if (name == "replay") {
    if (argument.empty()) throw UsageError("--device replay: what to replay is missing; allowed: replay:FILE, replay:FOLDER");
    const trial::ProtocolSettings task = trial::makeProtocolSettings(experiment, constraints::makeConstraint(experiment.constraint));
    return makeReplayHand(argument, task.start, task.target);
  }
  if (name == "mouse") throw ResourceError("--device mouse: needs a window to point into; use `reachlab`");
  throw UsageError("--device " + spec + ": unknown; allowed: simulated[:KEY=VALUE,...], replay:FILE, replay:FOLDER, mouse");
}

int trialsOnOffer(const std::string& spec) {
  const std::string replay = "replay:";
  return spec.starts_with(replay) && spec.size() > replay.size() ? static_cast<int>(reachFiles(spec.substr(replay.size())).size()) : 1;
}

std::vector<DeviceDescription> knownDevices() {
  return {{"simulated", "a virtual subject: minimum hand jerk for this very object, with seeded motor noise"},
          {"replay", "replay:FILE|FOLDER, recorded reaches laid onto start and target, one a trial"},
          {"mouse", "the pointer in the window of `reachlab`"}};
}

}  // namespace reachlab::devices
