#include "devices/kept_mapping.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "base/device_options.h"
#include "base/text_file.h"
#include "devices/driver/registry.h"
#include "devices/hands/several_hands.h"
#include "devices/make_device.h"
#include "devices/mapping/mapping.h"

namespace reachlab::devices {
namespace {

namespace fs = std::filesystem;

std::string kindOf(const std::string& hand) { return hand.substr(0, hand.find_first_of(":,")); }

// "phantom", or "phantom:Left" if the device is asked for by its own name.
std::string nameOf(const std::string& hand) {
  const std::string kind = kindOf(hand);
  const std::string own =
      hand.size() > kind.size() && hand[kind.size()] == ':' ? DeviceOptions(hand.substr(kind.size() + 1), kind).plain() : "";
  return own.empty() ? kind : kind + ":" + own;
}

// "phantom-Left". Other characters are written by their numbers, so that no two devices share a file.
std::string fileOf(const std::string& name, const std::string& data, const std::string& subject) {
  std::string file = kindOf(name);
  if (name.size() > file.size()) file += '-';
  for (const char c : std::string_view(name).substr(file.size()))
    file += std::isalnum(static_cast<unsigned char>(c)) != 0 ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return mappingFile(data, subject, file);
}

// The file of the hand's mapping, empty without one. The only device of its kind is the same by its kind and by its own name.
std::string keptFile(const DeviceDriver& driver, const std::string& hand, const std::string& data, const std::string& subject) {
  const std::string name = nameOf(hand);
  if (const std::string file = fileOf(name, data, subject); isThere(file)) return file;
  // Looking for devices takes time and may open some, so it is done only where it can find a mapping.
  const fs::path ofKind = fileOf(driver.name, data, subject);
  const auto isOfOne = [&](const fs::path& file) { return file.filename().string().starts_with(ofKind.stem().string() + "-"); };
  std::error_code error;
  const fs::directory_iterator kept(ofKind.parent_path(), error);
  if (driver.isMade || (name != driver.name ? !isThere(ofKind) : std::none_of(begin(kept), end(kept), isOfOne))) return {};
  std::vector<FoundDevice> found = driver.find(driver);
  std::erase_if(found, [](const FoundDevice& device) { return !device.present; });
  if (found.size() != 1 || (name != driver.name && name != found[0].name)) return {};
  const std::string file = fileOf(name == driver.name ? found[0].name : driver.name, data, subject);
  return isThere(file) ? file : "";
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
    if (const HandSettings settings = handSettingsOf(hand); settings.mapped) {
      hand = withMappingOf(hand, settings.mapping);
    } else if (const std::string file = keptFile(*driver, hand, data, subject); !file.empty()) {
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
    kept.push_back(fileOf(nameOf(hand), data, subject));
    saveMapping(options.mapping, kept.back());
  }
  return kept;
}

}  // namespace reachlab::devices
