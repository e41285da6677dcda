#include "cli/terminal/session_device.h"

#include <fmt/format.h>

#include "base/terminal/message.h"
#include "devices/kept_mapping.h"
#include "devices/make_device.h"
#include "devices/preflight/preflight.h"

namespace reachlab::cli {

std::string withMappings(const session::SessionRequest& request) {
  if (record::labelFault(request.place.subject, "subject")) return request.device;  // the session is refused, in its own words
  std::vector<std::string> taken;
  std::string mapped = devices::withKeptMappings(request.device, request.place.data, request.place.subject, taken);
  for (const std::string& file : taken) fmt::print(stderr, "mapping of {}\n", file);
  return mapped;
}

session::DeviceMaker checkedDeviceMaker() {
  return [learnt = std::shared_ptr<void>()](const std::string& spec, std::span<const experiment::CompiledExperiment> scenes,
                                            std::uint64_t seed) mutable {
    auto device = devices::makeDevice(spec, scenes, seed, &learnt);
    for (const std::string& sentence : devices::warningsBeforeBlock(scenes, *device)) fmt::print(stderr, "warning: {}\n", sentence);
    return device;
  };
}

void printWarnings(const session::RecordedRun& run) {
  for (const Fault& warning : run.warnings()) fmt::print(stderr, "{}", messageOf(warning, "warning"));
}

}  // namespace reachlab::cli
