#include "devices/make_device.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/device_options.h"
#include "base/fault.h"
#include "base/math/seeded.h"
#include "base/names.h"
#include "devices/driver/registry.h"
#include "devices/hands/several_hands.h"
#include "devices/replay/reach_source.h"
#include "sim/subjects/hands_in_scenes.h"

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

constexpr std::uint64_t kOfAHand = 0x68616e64;

// What a replayed file is called is its own business.
bool takesHandSettings(const Spec& asked) { return asked.name != "replay"; }

// What a virtual person learns in one scene is kept for the next.
std::unique_ptr<haptics::HapticDevice> makeInScenes(const DeviceDriver& driver, const std::string& name, const std::string& argument,
                                                    std::span<const experiment::CompiledExperiment> scenes, std::uint64_t seed,
                                                    std::shared_ptr<void>* kept) {
  std::shared_ptr<void> ofBlock;
  std::shared_ptr<void>* learnt = kept != nullptr && scenes.size() > 1 ? kept : &ofBlock;
  std::vector<std::unique_ptr<haptics::HapticDevice>> hands;
  for (const experiment::CompiledExperiment& scene : scenes) {
    hands.push_back(driver.make({name, argument, scene, seed, learnt}));
    if (scenes.size() == 1 || !hands.front()->info().virtualHand) return std::move(hands.front());
  }
  return subjects::joinScenes(std::move(hands));
}

std::unique_ptr<haptics::HapticDevice> makeBy(const DeviceDriver& driver, const Spec& asked,
                                              std::span<const experiment::CompiledExperiment> scenes, std::uint64_t seed,
                                              std::shared_ptr<void>* learnt) {
  if (!takesHandSettings(asked)) return makeInScenes(driver, asked.name, asked.argument, scenes, seed, learnt);
  DeviceOptions options(asked.argument, "device " + asked.name);
  const HandSettings hand = takeHandSettings(options);
  if (!hand.any()) return makeInScenes(driver, asked.name, asked.argument, scenes, seed, learnt);
  const std::string rest = options.rest(), argument = options.plain() + (options.plain().empty() || rest.empty() ? "" : ",") + rest;
  return guardDevice(makeInScenes(driver, asked.name, argument, scenes, seed, learnt), hand);
}

// Only the first hand's device may be the clock; another one that could be is sampled, unless it is told how.
Spec sampled(const Spec& asked) {
  if (asked.name != "phantom" || ("," + asked.argument).find(",clock=") != std::string::npos) return asked;
  return {asked.name, asked.argument + ",clock=computer"};
}

std::unique_ptr<haptics::HapticDevice> makeHand(const std::string& spec, std::span<const experiment::CompiledExperiment> scenes,
                                                std::uint64_t seed, bool first, std::shared_ptr<void>* learnt) {
  const Spec asked = parse(spec);
  if (const DeviceDriver* driver = findDriver(asked.name)) {
    const std::string words = "device " + asked.name;
    try {
      return makeBy(*driver, first ? asked : sampled(asked), scenes, seed, learnt);
    } catch (const ResourceError& error) {  // a loader's or a system's own words do not say what was asked for
      if (std::string_view(error.what()).starts_with(words)) throw;
      throw ResourceError(words + ": " + error.what());
    }
  }
  std::vector<std::string> known;
  for (const DeviceDriver& driver : deviceDrivers()) known.push_back(driver.name);
  const std::string nearest = nearestName(asked.name, known);
  throw FaultError(
      Fault{"device", "is " + spec + ", which is unknown" + (nearest.empty() ? "" : "; did you mean " + nearest + "?"), listOf(known)});
}

// Before anything is opened: two threads would tell one device two forces.
void requireTheirOwn(const std::vector<std::string>& hands) {
  const auto nameOf = [](const Spec& asked) { return DeviceOptions(asked.argument, "device " + asked.name).plain(); };
  for (std::size_t i = 0; i < hands.size(); ++i) {
    const Spec one = parse(hands[i]);
    const DeviceDriver* driver = findDriver(one.name);
    if (driver == nullptr || driver->isMade) continue;
    for (std::size_t j = i + 1; j < hands.size(); ++j) {
      const Spec other = parse(hands[j]);
      if (other.name != one.name || (!nameOf(one).empty() && !nameOf(other).empty() && nameOf(one) != nameOf(other))) continue;
      throw FaultError(Fault{"device", fmt::format("is {}, which may be one device twice", joinHands(hands)),
                             fmt::format("{}, each by a name of its own", driver->usage)});
    }
  }
}

}  // namespace

std::unique_ptr<haptics::HapticDevice> makeDevice(const std::string& spec, const experiment::CompiledExperiment& experiment,
                                                  std::uint64_t seed) {
  return makeDevice(spec, std::span(&experiment, 1), seed);
}

std::unique_ptr<haptics::HapticDevice> makeDevice(const std::string& spec, std::span<const experiment::CompiledExperiment> scenes,
                                                  std::uint64_t seed, std::shared_ptr<void>* learnt) {
  const std::vector<std::string> hands = splitHands(spec);
  if (hands.size() == 1) return makeHand(spec, scenes, seed, true, learnt);
  requireTheirOwn(hands);
  std::vector<std::unique_ptr<haptics::HapticDevice>> all;
  // Two subjects of one seed would move alike.
  for (std::size_t i = 0; i < hands.size(); ++i)
    all.push_back(makeHand(hands[i], scenes, i == 0 ? seed : seededBits(seed, kOfAHand + i), i == 0, nullptr));
  return joinDevices(std::move(all));
}

std::unique_ptr<haptics::HapticDevice> makeDevice(const std::string& spec, const experiment::Experiment& experiment, std::uint64_t seed) {
  return makeDevice(spec, experiment::CompiledExperiment(experiment), seed);
}

HandSettings handSettingsOf(const std::string& spec) {
  const Spec asked = parse(spec);
  if (!takesHandSettings(asked)) return {};
  DeviceOptions options(asked.argument, "device " + asked.name);
  return takeHandSettings(options);
}

int trialsOnOffer(const std::string& spec) {
  if (const std::vector<std::string> hands = splitHands(spec); hands.size() > 1) {
    int most = 1;
    for (const std::string& hand : hands) most = std::max(most, trialsOnOffer(hand));
    return most;
  }
  const Spec asked = parse(spec);
  return asked.name == "replay" && !asked.argument.empty() ? static_cast<int>(readReaches(reachSourceOf(asked.argument)).size()) : 1;
}

}  // namespace reachlab::devices
