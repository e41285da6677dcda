#pragma once
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim/record/configuration/run_configuration.h"

namespace reachlab::record {

/// Whether the configuration has these values under these keys; others are not looked at.
inline void expectRecorded(const RunConfiguration& configuration, const nlohmann::json& expected) {
  const nlohmann::json written = nlohmann::json::parse(toJson(configuration));
  for (const auto& [key, value] : expected.items()) EXPECT_EQ(written.value(key, nlohmann::json()), value) << key;
}

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
