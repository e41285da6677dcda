#include "devices/kept_mapping.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "base/device_options.h"
#include "devices/driver/registry.h"
#include "devices/hands/several_hands.h"
#include "devices/make_device.h"
#include "devices/mapping/mapping.h"

namespace reachlab::devices {
namespace {

std::string kindOf(const std::string& hand) { return hand.substr(0, hand.find_first_of(":,")); }

// "phantom", and "phantom-Left" of a device that is asked for by a name of its own: another one lies elsewhere.
std::string fileOf(const std::string& hand, const std::string& data, const std::string& subject) {
  std::string name = kindOf(hand);
  if (hand.size() > name.size() && hand[name.size()] == ':') {
    std::string own = DeviceOptions(hand.substr(name.size() + 1), "device " + name).plain();
    std::erase_if(own, [](unsigned char c) { return std::isalnum(c) == 0; });
    if (!own.empty()) name += "-" + own;
  }
  return mappingFile(data, subject, name);
}

// With its mapping as values behind the other options, however it was written.
std::string withMappingOf(const std::string& hand, const Mapping& mapping) {
  const std::string kind = kindOf(hand);
  DeviceOptions options(hand.size() > kind.size() ? hand.substr(kind.size() + 1) : "", "device " + kind);
  for (const char* key : {"mapping", "scale", "offset", "rotation", "mirror"}) (void)options.take(key);
  std::string text = options.plain();
  for (const std::string& part : {options.rest(), optionsOf(mapping)})
    if (!part.empty()) text += (text.empty() ? "" : ",") + part;
  return kind + (options.plain().empty() ? ',' : ':') + text;
}

}  // namespace

std::string withKeptMappings(const std::string& device, const std::string& data, const std::string& subject,
                             std::vector<std::string>& taken) {
  std::vector<std::string> hands = splitHands(device);
  for (std::string& hand : hands) {
    const std::string kind = kindOf(hand);
    const DeviceDriver* driver = findDriver(kind);
    if (driver == nullptr || !driver->takesHandSettings) continue;
    const std::string file = fileOf(hand, data, subject);
    std::error_code error;
    if (const HandSettings settings = handSettingsOf(hand); settings.mapped) {
      hand = withMappingOf(hand, settings.mapping);
    } else if (std::filesystem::exists(file, error)) {
      hand = withMappingOf(hand, readMapping(file));
      taken.push_back(file);
    }
  }
  return joinHands(hands);
}

std::vector<std::string> keepMappings(const std::string& device, const std::string& data, const std::string& subject) {
  const std::vector<std::string> hands = splitHands(device);
  std::vector<std::string> kept;
  for (const std::string& hand : hands) {
    const HandSettings options = handSettingsOf(hand);
    if (!options.mapped) continue;
    kept.push_back(fileOf(hand, data, subject));
    saveMapping(options.mapping, kept.back());
  }
  return kept;
}

}  // namespace reachlab::devices
