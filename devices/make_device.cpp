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
  std::string words() const { return "device " + name; }
};
Spec parse(const std::string& spec) {
  const std::size_t colon = spec.find(':');
  if (colon != std::string::npos) return {spec.substr(0, colon), spec.substr(colon + 1)};
  // Options without a name of one device: `hid,model=polhem_v1`.
  const std::size_t comma = std::min(spec.find(','), spec.size());
  return {spec.substr(0, comma), spec.substr(comma)};
}

constexpr std::uint64_t kOfAHand = 0x68616e64;

/// For what devices are made.
struct Block {
  std::span<const experiment::CompiledExperiment> scenes;
  std::uint64_t seed = 0;
  std::shared_ptr<void>* learnt = nullptr;
};

// What a virtual person learns in one scene is kept for the next.
std::unique_ptr<haptics::HapticDevice> makeInScenes(const DeviceDriver& driver, const Spec& asked, const Block& block) {
  std::shared_ptr<void> ofBlock;
  std::shared_ptr<void>* learnt = block.learnt != nullptr && block.scenes.size() > 1 ? block.learnt : &ofBlock;
  std::vector<std::unique_ptr<haptics::HapticDevice>> hands;
  for (const experiment::CompiledExperiment& scene : block.scenes) {
    hands.push_back(driver.make({asked.name, asked.argument, scene, block.seed, learnt}));
    if (block.scenes.size() == 1 || !hands.front()->info().virtualHand) return std::move(hands.front());
  }
  return subjects::joinScenes(std::move(hands));
}

std::unique_ptr<haptics::HapticDevice> makeBy(const DeviceDriver& driver, const Spec& asked, const Block& block) {
  if (!driver.takesHandSettings) return makeInScenes(driver, asked, block);
  DeviceOptions options(asked.argument, asked.words());
  const HandSettings hand = takeHandSettings(options);
  const std::string rest = options.rest(), argument = options.plain() + (options.plain().empty() || rest.empty() ? "" : ",") + rest;
  return guardDevice(makeInScenes(driver, {asked.name, argument}, block), hand);
}

std::unique_ptr<haptics::HapticDevice> makeHand(const std::string& spec, const Block& block, bool first) {
  const Spec asked = parse(first ? spec : byComputersClock(spec));  // only the first hand's device may be the clock
  if (const DeviceDriver* driver = findDriver(asked.name)) {
    try {
      return makeBy(*driver, asked, block);
    } catch (const ResourceError& error) {  // a loader's or a system's own words do not say what was asked for
      if (std::string_view(error.what()).starts_with(asked.words())) throw;
      throw ResourceError(asked.words() + ": " + error.what());
    }
  }
  std::vector<std::string> known;
  for (const DeviceDriver& driver : deviceDrivers()) known.push_back(driver.name);
  throw FaultError(Fault{"device", "is " + spec + ", which is unknown" + didYouMean(asked.name, known), listOf(known)});
}

// Before anything is opened: two threads would tell one device two forces.
void requireTheirOwn(const std::vector<std::string>& hands) {
  const auto nameOf = [](const Spec& asked) { return DeviceOptions(asked.argument, asked.words()).plain(); };
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
  if (hands.size() == 1) return makeHand(spec, {scenes, seed, learnt}, true);
  requireTheirOwn(hands);
  std::vector<std::unique_ptr<haptics::HapticDevice>> all;
  // Two subjects of one seed would move alike.
  for (std::size_t i = 0; i < hands.size(); ++i)
    all.push_back(makeHand(hands[i], {scenes, i == 0 ? seed : seededBits(seed, kOfAHand + i)}, i == 0));
  return joinDevices(std::move(all));
}

std::unique_ptr<haptics::HapticDevice> makeDevice(const std::string& spec, const experiment::Experiment& experiment, std::uint64_t seed) {
  return makeDevice(spec, experiment::CompiledExperiment(experiment), seed);
}

std::string byComputersClock(const std::string& hand) {
  const Spec asked = parse(hand);
  const bool hasChoice = asked.name == "phantom" && ("," + asked.argument).find(",clock=") == std::string::npos;
  return hasChoice ? hand + ",clock=computer" : hand;
}

HandSettings handSettingsOf(const std::string& spec) {
  const Spec asked = parse(spec);
  if (const DeviceDriver* driver = findDriver(asked.name); driver != nullptr && !driver->takesHandSettings) return {};
  DeviceOptions options(asked.argument, asked.words());
  return takeHandSettings(options);
}

int trialsOnOffer(const std::string& spec) {
  std::size_t most = 1;
  for (const std::string& hand : splitHands(spec))
    if (const Spec asked = parse(hand); asked.name == "replay" && !asked.argument.empty())
      most = std::max(most, readReaches(reachSourceOf(asked.argument)).size());
  return static_cast<int>(most);
}

}  // namespace reachlab::devices
