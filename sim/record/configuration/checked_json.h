#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

/// Members of a JSON object from a file of unknown origin. Each is present, of its kind and within its bounds, or a FaultError names key,
/// fault and allowed values. (The conversions of nlohmann cut a number to the type that it is assigned to.)
namespace reachlab::record {

/// A whole number from `lo` to `hi`.
std::int64_t wholeOf(const nlohmann::json& object, const std::string& key, std::int64_t lo, std::int64_t hi);
/// 0 to 2^64 - 1.
std::uint64_t seedOf(const nlohmann::json& object, const std::string& key);
double numberOf(const nlohmann::json& object, const std::string& key, double lo, double hi);
bool flagOf(const nlohmann::json& object, const std::string& key);
std::string textOf(const nlohmann::json& object, const std::string& key);
/// With at most `most` elements.
const nlohmann::json& listOf(const nlohmann::json& object, const std::string& key, std::size_t most);
const nlohmann::json& memberOf(const nlohmann::json& object, const std::string& key);

}  // namespace reachlab::record
