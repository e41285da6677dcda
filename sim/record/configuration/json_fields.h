#pragma once
#include <concepts>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "base/fault.h"
#include "base/math/vec3.h"

/// Plain structs as JSON objects by one list of their fields: `visitFields(value, visit)` calls `visit(Field, member)` for each. The same
/// list serves for reading, writing and comparing. A member that is a struct, or a list of structs, has its own list.
namespace reachlab::record {

/// Throws FaultError where there is no such member.
const nlohmann::json& memberOf(const nlohmann::json& object, const char* key);

struct Field {
  const char* key;
  double least = 0, most = 0;  // bounds of a number, most elements of a list
  bool zeroIfMissing = false;  // a number that is 0 is left out
};

template <class T>
void readFields(const nlohmann::json& object, T& value);
template <class T>
nlohmann::json writeFields(const T& value);

namespace fieldsDetail {

/// Each member is there, of its kind and within its bounds, or a FaultError names key, fault and allowed values. (The conversions of nlohmann
/// cut a number to the type that it is assigned to.)
void readMember(const nlohmann::json& j, const Field& f, std::string& member);
void readMember(const nlohmann::json& j, const Field& f, bool& member);
void readMember(const nlohmann::json& j, const Field& f, double& member);
void readMember(const nlohmann::json& j, const Field& f, std::uint64_t& member);  // 0 to 2^64 - 1
void readMember(const nlohmann::json& j, const Field& f, Vec3& member);
std::int64_t wholeOf(const nlohmann::json& j, const Field& f);
/// With at most f.most elements.
const nlohmann::json& listOf(const nlohmann::json& j, const Field& f);
const nlohmann::json& objectOf(const nlohmann::json& j, const Field& f);

template <std::integral T>
void readMember(const nlohmann::json& j, const Field& f, T& member) {
  if (!f.zeroIfMissing || j.contains(f.key)) member = static_cast<T>(wholeOf(j, f));
}

/// A fault inside names the whole key: "trials[3].index".
template <class T>
void readMember(const nlohmann::json& j, const Field& f, T& member) {
  const nlohmann::json& inner = objectOf(j, f);
  underKey(f.key, [&] { readFields(inner, member); });
}
template <class T>
void readMember(const nlohmann::json& j, const Field& f, std::vector<T>& member) {
  for (const nlohmann::json& element : listOf(j, f))
    underKey(std::string(f.key) + "[" + std::to_string(member.size()) + "]", [&] { readFields(element, member.emplace_back()); });
}

template <class T>
void readMember(const nlohmann::json& j, const Field& f, std::optional<T>& member) {
  if (j.contains(f.key)) readMember(j, f, member.emplace());
}

template <class T>
nlohmann::json memberToJson(const T& member) {
  if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) return member;
  else return writeFields(member);
}
inline nlohmann::json memberToJson(const Vec3& v) { return nlohmann::json::array({v.x, v.y, v.z}); }
template <class T>
nlohmann::json memberToJson(const std::vector<T>& member) {
  nlohmann::json list = nlohmann::json::array();
  for (const T& element : member) list.push_back(writeFields(element));
  return list;
}

}  // namespace fieldsDetail

/// Throws FaultError `KEY: …` for a member that is missing, of another kind, or out of its bounds. A std::optional may be missing.
template <class T>
void readFields(const nlohmann::json& object, T& value) {
  visitFields(value, [&](const Field& field, auto& member) { fieldsDetail::readMember(object, field, member); });
}

template <class T>
nlohmann::json writeFields(const T& value) {
  nlohmann::json object = nlohmann::json::object();
  visitFields(value, [&]<class M>(const Field& field, const M& member) {
    if constexpr (requires { member.has_value(); }) {
      if (member) object[field.key] = fieldsDetail::memberToJson(*member);
    } else {
      if constexpr (std::is_arithmetic_v<M>)
        if (field.zeroIfMissing && member == M{}) return;
      object[field.key] = fieldsDetail::memberToJson(member);
    }
  });
  return object;
}

}  // namespace reachlab::record
