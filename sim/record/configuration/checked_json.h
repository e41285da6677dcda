#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

/// Members of a JSON object that came out of a file, whoever wrote it: each is there, of its kind and within its bounds, or a FaultError
/// says `KEY: what is wrong; allowed: …`. (nlohmann's own conversions cut a number to whatever type it is given to.)
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
