#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim/record/configuration/run_configuration.h"

namespace reachlab::record {

/// Keys of two JSON objects that differ, in the order of the alphabet.
inline std::vector<std::string> differingKeys(const nlohmann::json& a, const nlohmann::json& b) {
  nlohmann::json both = a;
  both.update(b);
  std::vector<std::string> keys;
  for (const auto& [key, value] : both.items())
    if (a.value(key, nlohmann::json()) != b.value(key, nlohmann::json())) keys.push_back(key);
  return keys;
}
inline std::vector<std::string> differingKeys(const RunConfiguration& a, const RunConfiguration& b) {
  return differingKeys(nlohmann::json::parse(toJson(a)), nlohmann::json::parse(toJson(b)));
}

}  // namespace reachlab::record
