#include "sim/record/configuration/checked_json.h"

#include <fmt/format.h>

#include "base/fault.h"

namespace reachlab::record {
namespace {

[[noreturn]] void refuse(const std::string& key, const nlohmann::json& value, const std::string& allowed) {
  constexpr std::size_t kShown = 40;
  std::string shown = value.is_structured() ? value.type_name() : value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  if (shown.size() > kShown) shown = shown.substr(0, kShown) + " …";
  throw FaultError(Fault{key, "is " + shown, allowed});
}

}  // namespace

const nlohmann::json& memberOf(const nlohmann::json& object, const std::string& key) {
  if (!object.is_object()) throw FaultError(Fault{key, "stands in no object"});
  const auto found = object.find(key);
  if (found == object.end()) throw FaultError(Fault{key, "is missing"});
  return *found;
}

std::int64_t wholeOf(const nlohmann::json& object, const std::string& key, std::int64_t lo, std::int64_t hi) {
  const nlohmann::json& value = memberOf(object, key);
  const std::string allowed = fmt::format("a whole number from {} to {}", lo, hi);
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > static_cast<std::uint64_t>(INT64_MAX)) refuse(key, value, allowed);
  if (!value.is_number_integer()) refuse(key, value, allowed);
  const auto number = value.get<std::int64_t>();
  if (number < lo || number > hi) refuse(key, value, allowed);
  return number;
}

std::uint64_t seedOf(const nlohmann::json& object, const std::string& key) {
  const nlohmann::json& value = memberOf(object, key);
  if (!value.is_number_unsigned()) refuse(key, value, "a whole number from 0 to 18446744073709551615");
  return value.get<std::uint64_t>();
}

double numberOf(const nlohmann::json& object, const std::string& key, double lo, double hi) {
  const nlohmann::json& value = memberOf(object, key);
  const std::string allowed = fmt::format("a number from {} to {}", lo, hi);
  if (!value.is_number()) refuse(key, value, allowed);
  const auto number = value.get<double>();
  if (!(number >= lo && number <= hi)) refuse(key, value, allowed);
  return number;
}

bool flagOf(const nlohmann::json& object, const std::string& key) {
  const nlohmann::json& value = memberOf(object, key);
  if (!value.is_boolean()) refuse(key, value, "true or false");
  return value.get<bool>();
}

std::string textOf(const nlohmann::json& object, const std::string& key) {
  const nlohmann::json& value = memberOf(object, key);
  if (!value.is_string()) refuse(key, value, "a text");
  return value.get<std::string>();
}

const nlohmann::json& listOf(const nlohmann::json& object, const std::string& key, std::size_t most) {
  const nlohmann::json& value = memberOf(object, key);
  if (!value.is_array() || value.size() > most) refuse(key, value, fmt::format("a list of up to {}", most));
  return value;
}

}  // namespace reachlab::record
