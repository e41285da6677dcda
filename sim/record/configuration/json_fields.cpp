#include "sim/record/configuration/json_fields.h"

#include <fmt/format.h>

#include <algorithm>

namespace reachlab::record {
namespace {

[[noreturn]] void refuse(const std::string& key, const nlohmann::json& value, const std::string& allowed) {
  constexpr std::size_t kShown = 40;
  std::string shown = value.is_structured() ? value.type_name() : value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  if (shown.size() > kShown) shown = shown.substr(0, kShown) + " …";
  throw FaultError(Fault{key, "is " + shown, allowed});
}

}  // namespace

const nlohmann::json& memberOf(const nlohmann::json& object, const char* key) {
  if (!object.is_object()) throw FaultError(Fault{key, "stands in no object"});
  const auto found = object.find(key);
  if (found == object.end()) throw FaultError(Fault{key, "is missing"});
  return *found;
}

namespace fieldsDetail {

void readMember(const nlohmann::json& j, const Field& f, std::string& member) {
  const nlohmann::json& value = memberOf(j, f.key);
  if (!value.is_string()) refuse(f.key, value, "a text");
  member = value.get<std::string>();
}

void readMember(const nlohmann::json& j, const Field& f, bool& member) {
  const nlohmann::json& value = memberOf(j, f.key);
  if (!value.is_boolean()) refuse(f.key, value, "true or false");
  member = value.get<bool>();
}

void readMember(const nlohmann::json& j, const Field& f, double& member) {
  const nlohmann::json& value = memberOf(j, f.key);
  const bool within = value.is_number() && value.get<double>() >= f.least && value.get<double>() <= f.most;
  if (!within) refuse(f.key, value, fmt::format("a number from {} to {}", f.least, f.most));
  member = value.get<double>();
}

void readMember(const nlohmann::json& j, const Field& f, std::uint64_t& member) {
  const nlohmann::json& value = memberOf(j, f.key);
  if (!value.is_number_unsigned()) refuse(f.key, value, "a whole number from 0 to 18446744073709551615");
  member = value.get<std::uint64_t>();
}

void readMember(const nlohmann::json& j, const Field& f, Vec3& member) {
  const nlohmann::json& list = listOf(j, {.key = f.key, .most = 3});
  const bool good = list.size() == 3 && std::all_of(list.begin(), list.end(), [](const nlohmann::json& x) { return x.is_number(); });
  if (!good) throw FaultError(Fault{f.key, "is not three numbers"});
  member = {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

std::int64_t wholeOf(const nlohmann::json& j, const Field& f) {
  const nlohmann::json& value = memberOf(j, f.key);
  const auto least = static_cast<std::int64_t>(f.least), most = static_cast<std::int64_t>(f.most);
  const bool tooLarge = value.is_number_unsigned() && value.get<std::uint64_t>() > static_cast<std::uint64_t>(INT64_MAX);
  if (tooLarge || !value.is_number_integer() || value.get<std::int64_t>() < least || value.get<std::int64_t>() > most)
    refuse(f.key, value, fmt::format("a whole number from {} to {}", least, most));
  return value.get<std::int64_t>();
}

const nlohmann::json& listOf(const nlohmann::json& j, const Field& f) {
  const nlohmann::json& value = memberOf(j, f.key);
  if (!value.is_array() || static_cast<double>(value.size()) > f.most) refuse(f.key, value, fmt::format("a list of up to {:.0f}", f.most));
  return value;
}

const nlohmann::json& objectOf(const nlohmann::json& j, const Field& f) {
  const nlohmann::json& value = memberOf(j, f.key);
  if (!value.is_object()) throw FaultError(Fault{f.key, "is no object"});
  return value;
}

}  // namespace fieldsDetail

}  // namespace reachlab::record
