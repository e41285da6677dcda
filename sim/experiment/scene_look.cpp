#include "sim/experiment/scene_look.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/fault.h"
#include "base/json/json_reader.h"
#include "sim/experiment/experiment.h"

namespace reachlab::experiment {
namespace {

using Json = nlohmann::ordered_json;

bool isColour(const std::string& text) {
  return text.size() == 7 && text[0] == '#' && text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
}

void readPlace(ObjectReader& reader, const JsonNode* node, const std::string& key, Vec3& place) {
  std::vector<double> numbers;
  if (node != nullptr && reader.numbers(*node, key, 3, anyNumber(), numbers)) place = {numbers[0], numbers[1], numbers[2]};
}

NamedCamera readCamera(ObjectReader& reader) {
  NamedCamera camera;
  if (const JsonNode* name = reader.required("name", "a name")) {
    reader.text("name", camera.name);
    if (camera.name.empty()) reader.faults().add(*name, reader.keyPath("name"), "is empty", "a name");
  }
  readPlace(reader, reader.required("position_m", "[x, y, z] in m"), "position_m", camera.position);
  const JsonNode* focus = reader.required("focus_m", "[x, y, z] in m");
  readPlace(reader, focus, "focus_m", camera.focus);
  if (focus != nullptr && camera.position == camera.focus)
    reader.faults().add(*focus, reader.keyPath("focus_m"), "is where the eye is", "another place than position_m");
  const JsonNode* up = reader.optional("up");
  readPlace(reader, up, "up", camera.up);
  if (up != nullptr && camera.up == Vec3{}) reader.faults().add(*up, reader.keyPath("up"), "has no direction", "[0, 1, 0], say");
  reader.number("angle_deg", {1, 120, true, "1 to 120 degrees"}, camera.angle);
  reader.boolean("parallel", camera.parallel);
  reader.finish();
  return camera;
}

void readColours(FaultList& faults, const JsonNode& node, std::map<std::string, std::string>& colours) {
  ObjectReader reader(faults, node, "look.colours");
  for (const std::string& part : colouredParts()) {
    const JsonNode* value = reader.optional(part);
    if (value == nullptr) continue;
    reader.text(part, colours[part]);
    if (value->kind == JsonNode::Kind::String && !isColour(colours[part]))
      faults.add(*value, "look.colours." + part, fmt::format("is \"{}\"", colours[part]),
                 "\"#rrggbb\": two hexadecimal digits each of red, green, blue");
  }
  reader.finish();
}

Json lookJson(const SceneLook& look) {
  const auto array = [](const Vec3& v) { return Json::array({v.x, v.y, v.z}); };
  Json json = {
      {"surface_opacity", look.surfaceOpacity}, {"depth_cue", look.depthCue}, {"trace", look.trace}, {"force_arrow", look.forceArrow}};
  if (!look.sceneFile.empty()) json["scene_file"] = look.sceneFile;
  if (!look.colours.empty()) json["colours"] = look.colours;
  if (!look.cameras.empty()) json["cameras"] = Json::array();
  for (const NamedCamera& camera : look.cameras)
    json["cameras"].push_back({{"name", camera.name},
                               {"position_m", array(camera.position)},
                               {"focus_m", array(camera.focus)},
                               {"up", array(camera.up)},
                               {"angle_deg", camera.angle},
                               {"parallel", camera.parallel}});
  return json;
}

}  // namespace

const std::vector<std::string>& colouredParts() {
  static const std::vector<std::string> names{
      "background_top", "background_bottom", "rail",  "surface", "surface_line", "start", "target", "driven", "middle", "last", "hand",
      "spring",         "coupling",          "force", "trace"};
  return names;
}

SceneLook readLook(FaultList& faults, const JsonNode& node) {
  SceneLook look;
  ObjectReader reader(faults, node, "look");
  reader.number("surface_opacity", {0, 1, true, "0 to 1"}, look.surfaceOpacity);
  reader.choice("depth_cue", {"none", "grid", "shadow"}, look.depthCue, false);
  reader.boolean("trace", look.trace);
  reader.boolean("force_arrow", look.forceArrow);
  reader.text("scene_file", look.sceneFile);
  if (const JsonNode* colours = reader.optional("colours")) readColours(faults, *colours, look.colours);
  if (const JsonNode* cameras = reader.optional("cameras")) {
    if (cameras->kind != JsonNode::Kind::Array)
      faults.add(*cameras, "look.cameras", "is no list", "[ { \"name\": …, \"position_m\": …, \"focus_m\": … } ]");
    for (std::size_t i = 0; i < cameras->items.size(); ++i) {
      ObjectReader inner(faults, cameras->items[i], fmt::format("look.cameras[{}]", i));
      look.cameras.push_back(readCamera(inner));
    }
  }
  reader.finish();
  return look;
}

SceneLook lookOf(const Experiment& experiment) {
  if (experiment.text.find("\"look\"") == std::string::npos) return {};
  try {
    FaultList faults("look");
    const JsonNode tree = parseJson(experiment.text, "look");
    const JsonNode* node = tree.find("look");
    const SceneLook look = node != nullptr ? readLook(faults, *node) : SceneLook{};
    return faults.empty() ? look : SceneLook{};
  } catch (const FaultError&) {  // no experiment's text: nobody has read it
    return {};
  }
}

Experiment withLook(const Experiment& experiment, const SceneLook& look) {
  Experiment changed = experiment;
  Json json = Json::parse(experiment.text.empty() ? toJson(experiment) : experiment.text, nullptr, true, true);
  if (look == SceneLook{}) json.erase("look");
  else json["look"] = lookJson(look);
  changed.text = json.dump(2) + "\n";
  return changed;
}

}  // namespace reachlab::experiment
