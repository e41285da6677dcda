#pragma once
#include <algorithm>
#include <concepts>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "base/fault.h"
#include "base/math/vec3.h"
#include "sim/record/configuration/checked_json.h"

/// Plain structs as JSON objects by one list of their fields: `visitFields(value, visit)` calls `visit(Field, member)` for each. The same
/// list serves for reading, writing and comparing. A member that is a struct, or a list of structs, has its own list.
namespace reachlab::record {

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

/// A fault inside names the whole key: "trials[3].index".
template <class T>
void readInside(const std::string& key, const nlohmann::json& object, T& member) {
  try {
    readFields(object, member);
  } catch (const FaultError& error) {
    throw FaultError(inside(key, error.faults));
  }
}
template <class T>
void readMember(const nlohmann::json& j, const Field& f, T& member) {
  if (f.zeroIfMissing && !j.contains(f.key)) return;
  if constexpr (std::is_same_v<T, std::string>) {
    member = textOf(j, f.key);
  } else if constexpr (std::is_same_v<T, bool>) {
    member = flagOf(j, f.key);
  } else if constexpr (std::is_same_v<T, std::uint64_t>) {
    member = seedOf(j, f.key);
  } else if constexpr (std::integral<T>) {
    member = static_cast<T>(wholeOf(j, f.key, static_cast<std::int64_t>(f.least), static_cast<std::int64_t>(f.most)));
  } else if constexpr (std::is_same_v<T, double>) {
    member = numberOf(j, f.key, f.least, f.most);
  } else {
    const nlohmann::json& inner = memberOf(j, f.key);
    if (!inner.is_object()) throw FaultError(Fault{f.key, "is no object"});
    readInside(f.key, inner, member);
  }
}
inline void readMember(const nlohmann::json& j, const Field& f, Vec3& member) {
  const nlohmann::json& list = listOf(j, f.key, 3);
  const bool good = list.size() == 3 && std::all_of(list.begin(), list.end(), [](const nlohmann::json& x) { return x.is_number(); });
  if (!good) throw FaultError(Fault{f.key, "is not three numbers"});
  member = {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}
template <class T>
void readMember(const nlohmann::json& j, const Field& f, std::vector<T>& member) {
  for (const nlohmann::json& element : listOf(j, f.key, static_cast<std::size_t>(f.most))) {
    const std::string key = std::string(f.key) + "[" + std::to_string(member.size()) + "]";
    readInside(key, element, member.emplace_back());
  }
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
