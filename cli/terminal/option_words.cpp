#include "cli/terminal/option_words.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>
#include <utility>

namespace reachlab::cli {
namespace {

/// The one place where keys of a request and options of `reach` meet: those whose names differ by more than the hyphens.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kRenamed{{
    {"participant.age", "--age"},
    {"participant.sex", "--sex"},
    {"participant.handedness", "--handedness"},
}};
constexpr std::array<std::string_view, 25> kSame{
    "subject", "session",      "trials", "run",           "seed",        "day",          "data",         "device", "fast",
    "resume",  "disk_reserve", "sweep",  "hand_mass",     "unknowns",    "duration",     "hand_damping", "point",  "scene",
    "method",  "cutoff",       "until",  "onset_percent", "onset_speed", "learning_bin", "hand_masses"};

}  // namespace

std::string optionOf(const std::string& key) {
  for (const auto& [name, option] : kRenamed)
    if (name == key) return std::string(option);
  if (std::find(kSame.begin(), kSame.end(), key) == kSame.end()) return {};
  std::string option = "--" + key;
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

std::vector<std::string> partsBetweenCommas(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream rest(text + ",");
  for (std::string part; std::getline(rest, part, ',');) parts.push_back(part);
  return parts;
}

std::vector<Fault> inOptionWords(std::vector<Fault> faults) {
  for (Fault& fault : faults)
    if (!fault.place)
      if (std::string option = optionOf(fault.key); !option.empty()) fault.key = std::move(option);
  return faults;
}

}  // namespace reachlab::cli
