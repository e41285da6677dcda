#include <nlohmann/json.hpp>

#include "constraints/catalogue/definition.h"
#include "sim/experiment/experiment_keys.h"
#include "sim/experiment/file_text.h"
#include "sim/experiment/scene_look.h"

namespace reachlab::experiment {
namespace {

using Json = nlohmann::ordered_json;

Json toArray(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

Json constraintJson(const constraints::ConstraintSpec& spec) {
  Json json = Json::object();
  if (!spec.curve.empty()) {
    json["curve"] = spec.curve;
  } else if (!spec.surface.empty()) {
    json["surface"] = spec.surface;
  } else {
    json["name"] = spec.name;
  }
  if (!spec.shape.empty()) json["shape"] = spec.shape;
  return json;
}

Json handJson(const Hand& hand, bool body) {
  Json json = Json::object();
  if (hand.mass > 0) {
    json["mass"] = hand.mass;
    json["stiffness_n_per_m"] = hand.stiffness.at(0);
    json["damping_n_s_per_m"] = hand.damping.at(0);
  } else {
    json["stiffness_n_per_m"] = hand.stiffness;
    json["damping_n_s_per_m"] = hand.damping;
  }
  if (body) json["fp_offset_m"] = toArray(hand.fpOffset);
  return json;
}

/// Writes each key from its member, what is not there excepted.
struct KeyWriter {
  Json& out;
  const Experiment& experiment;

  template <class T>
  void operator()(const Key& key, const T& value) const {
    if constexpr (std::is_enum_v<T>) out[key.name] = key.names->at(static_cast<std::size_t>(value));
    else if constexpr (std::same_as<T, Vec3>) out[key.name] = toArray(value);
    else if constexpr (std::same_as<T, constraints::ConstraintSpec>) out[key.name] = constraintJson(value);
    else if constexpr (std::is_class_v<T> && !requires { value.begin(); })
      visitKeys(value, KeyWriter{out[key.name] = Json::object(), experiment});
    else out[key.name] = value;
  }
  template <class T>
  void operator()(const Key& key, const std::optional<T>& value) const {
    if (value) (*this)(key, *value);
  }
  void operator()(const Key& key, const std::vector<Vec3>& places) const {
    for (const Vec3& place : places) out[key.name].push_back(toArray(place));
  }
  void operator()(const Key& key, const std::vector<Hand>& hands) const {
    for (const Hand& hand : hands) out[key.name].push_back(handJson(hand, experiment.object.kind == ObjectKind::Body));
  }
  void operator()(const Key& key, const ForceLaw& law) const {
    out[key.name] = key.names->at(law.index());
    std::visit([&](const auto& of) { visitKeys(of, *this); }, law);
  }
  void operator()(const Key& key, const Environment& environment) const {
    for (const HandForce& force : environment) visitKeys(force, KeyWriter{out[key.name].emplace_back(Json::object()), experiment});
  }
  void operator()(const Key& key, const SubjectScreen& screen) const {
    if (!(screen == SubjectScreen{})) visitKeys(screen, KeyWriter{out[key.name] = Json::object(), experiment});
  }
};

}  // namespace

std::string toJson(const Experiment& experiment) {
  Json json = Json::object();
  visitKeys(experiment, KeyWriter{json, experiment});
  if (!(lookOf(experiment) == SceneLook{})) json["look"] = Json::parse(experiment.text, nullptr, true, true)["look"];
  return json.dump(2) + "\n";
}

std::string fileText(const Experiment& experiment) {
  const Json text = Json::parse(experiment.text, nullptr, false, true);  // none, before the experiment has been a file
  if (!text.is_object() || !text.contains("description")) return toJson(experiment);
  const Json values = Json::parse(toJson(experiment));
  Json json{{"schema_version", values["schema_version"]}, {"description", text["description"]}};
  json.update(values);
  return json.dump(2) + "\n";
}

std::string definitionTextOf(const Experiment& experiment) {
  const constraints::ConstraintSpec& spec = experiment.constraint;
  if (!spec.definition.empty()) return spec.definition;
  if (!spec.curve.empty() || !spec.surface.empty() || spec.name == "free") return {};
  return constraints::toJson(constraints::findDefinition(spec.name, "constraint"));
}

}  // namespace reachlab::experiment
