#include "devices/mapping/mapping.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/error.h"
#include "base/fault.h"
#include "base/json/json_tree.h"
#include "base/text_file.h"
#include "sim/record/log/logs_folder.h"

namespace reachlab::devices {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kLeastScale = 0.01, kMostScale = 100, kFarthest = 10;

std::string shown(const OrderedJson& value) { return std::string("is ") + (value.is_number() ? value.dump() : value.type_name()); }

double numberFrom(const OrderedJson& value, const std::string& key, double least, double most) {
  const double x = value.is_number() ? value.get<double>() : NAN;
  if (!(x >= least) || !(x <= most)) throw FaultError(Fault{key, shown(value), fmt::format("a number from {} to {}", least, most)});
  return x;
}

Vec3 vectorFrom(const OrderedJson& value, const std::string& key, double most) {
  if (!value.is_array() || value.size() != 3) throw FaultError(Fault{key, shown(value), "three numbers"});
  return {numberFrom(value[0], key, -most, most), numberFrom(value[1], key, -most, most), numberFrom(value[2], key, -most, most)};
}

Mapping fromJson(const OrderedJson& json) {
  if (!json.is_object()) throw FaultError(Fault{.what = "is no JSON object of a mapping"});
  Mapping m;
  for (const auto& [key, value] : json.items()) {
    if (key == "scale") m.scale = numberFrom(value, key, kLeastScale, kMostScale);
    else if (key == "offset_m") m.offset = vectorFrom(value, key, kFarthest);
    else if (key == "rotation_deg") m.rotation = kDegree * vectorFrom(value, key, 360);
    else if (key == "mirror_x" && value.is_boolean()) m.mirrorX = value.get<bool>();
    else throw FaultError(Fault{key, shown(value), "scale, offset_m, rotation_deg, mirror_x (true or false)"});
  }
  return m;
}

}  // namespace

// Rodrigues' formula on the (mirrored) unit vectors, transposed into rows.
std::array<Vec3, 3> directions(const Mapping& mapping) noexcept {
  const double angle = norm(mapping.rotation);
  const Vec3 axis = angle > 0 ? mapping.rotation / angle : Vec3{1, 0, 0};
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turned = [&](const Vec3& v) { return c * v + s * cross(axis, v) + (1 - c) * dot(axis, v) * axis; };
  const Vec3 x = turned({mapping.mirrorX ? -1.0 : 1.0, 0, 0}), y = turned({0, 1, 0}), z = turned({0, 0, 1});
  return {Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}};
}

std::string toJson(const Mapping& m) {
  const OrderedJson json = {{"scale", m.scale},
                            {"offset_m", {m.offset.x, m.offset.y, m.offset.z}},
                            {"rotation_deg", {m.rotation.x / kDegree, m.rotation.y / kDegree, m.rotation.z / kDegree}},
                            {"mirror_x", m.mirrorX}};
  return json.dump();
}

std::string optionsOf(const Mapping& m) {
  const auto vector = [](const char* key, const Vec3& v, double unit) {
    return v == Vec3{} ? std::string() : fmt::format(",{}={:.12g}/{:.12g}/{:.12g}", key, v.x / unit, v.y / unit, v.z / unit);
  };
  const std::string others = vector("offset", m.offset, 1) + vector("rotation", m.rotation, kDegree) + (m.mirrorX ? ",mirror=x" : "");
  return m.scale == 1 && !others.empty() ? others.substr(1) : fmt::format("scale={}", m.scale) + others;
}

Mapping mappingFromJson(const std::string& text, const std::string& origin) {
  try {
    return fromJson(OrderedJson::parse(text, nullptr, false));
  } catch (const FaultError& error) {
    throw FaultError(inFile(origin, error.faults));
  }
}

Mapping readMapping(const std::string& file) { return mappingFromJson(readTextFile(file), file); }

std::string mappingFile(const std::string& data, const std::string& subject, const std::string& device) {
  return fmt::format("{}/{}/mappings/sub-{}_{}.json", data, record::kLogsFolder, subject, device);
}

void saveMapping(const Mapping& mapping, const std::string& file) {
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(file).parent_path(), error);
  std::ofstream out(file, std::ios::binary);
  out << toJson(mapping) << '\n' << std::flush;
  if (!out) throw ResourceError(fmt::format("{}: the mapping cannot be saved{}", file, error ? ": " + error.message() : ""));
}

}  // namespace reachlab::devices
