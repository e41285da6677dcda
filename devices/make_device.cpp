#include "devices/make_device.h"

#include "base/fault.h"
#include "devices/registry.h"
#include "devices/replay/reach_source.h"

namespace reachlab::devices {
namespace {

struct Spec {
  std::string name, argument;
};
Spec parse(const std::string& spec) {
  const std::size_t colon = spec.find(':');
  if (colon != std::string::npos) return {spec.substr(0, colon), spec.substr(colon + 1)};
  // Options without a name of one device: `hid,model=polhem_v1`.
  const std::size_t comma = std::min(spec.find(','), spec.size());
  return {spec.substr(0, comma), spec.substr(comma)};
}

// What a replayed file is called is its own business.
bool takesHandOptions(const Spec& asked) { return asked.name != "replay"; }

std::unique_ptr<haptics::HapticDevice> makeBy(const DeviceDriver& driver, const Spec& asked,
                                              const experiment::CompiledExperiment& experiment, std::uint64_t seed) {
  if (!takesHandOptions(asked)) return driver.make({asked.name, asked.argument, experiment, seed});
  DeviceOptions options(asked.argument, "device " + asked.name);
  const HandOptions hand = takeHandOptions(options);
  if (!hand.any()) return driver.make({asked.name, asked.argument, experiment, seed});
  const std::string rest = options.rest(), argument = options.plain() + (options.plain().empty() || rest.empty() ? "" : ",") + rest;
  return guardDevice(driver.make({asked.name, argument, experiment, seed}), hand);
}

}  // namespace

std::unique_ptr<haptics::HapticDevice> makeDevice(const std::string& spec, const experiment::CompiledExperiment& experiment,
                                                  std::uint64_t seed) {
  const Spec asked = parse(spec);
  if (const DeviceDriver* driver = findDriver(asked.name)) return makeBy(*driver, asked, experiment, seed);
  std::string known;
  for (const DeviceDriver& driver : deviceDrivers()) known += (known.empty() ? "" : ", ") + driver.usage;
  throw FaultError(Fault{"device", "is " + spec + ", which is unknown", known});
}

std::unique_ptr<haptics::HapticDevice> makeDevice(const std::string& spec, const experiment::Experiment& experiment, std::uint64_t seed) {
  return makeDevice(spec, experiment::CompiledExperiment(experiment), seed);
}

HandOptions handOptionsOf(const std::string& spec) {
  const Spec asked = parse(spec);
  if (!takesHandOptions(asked)) return {};
  DeviceOptions options(asked.argument, "device " + asked.name);
  return takeHandOptions(options);
}

int trialsOnOffer(const std::string& spec) {
  const Spec asked = parse(spec);
  return asked.name == "replay" && !asked.argument.empty() ? static_cast<int>(readReaches(reachSourceOf(asked.argument)).size()) : 1;
}

}  // namespace reachlab::devices
