#include <nlohmann/json.hpp>

#include "base/error.h"
#include "constraints/catalogue/definition.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/scene_look.h"

namespace reachlab::experiment {
namespace {

using Json = nlohmann::ordered_json;

const char* nameOf(ObjectKind kind) {
  switch (kind) {
    case ObjectKind::Point: return "point";
    case ObjectKind::Chain: return "chain";
    case ObjectKind::Parallel: return "parallel";
    case ObjectKind::Body: return "body";
  }
  return "";
}

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

Json objectJson(const Object& object) {
  Json json = Json::object();
  json["kind"] = nameOf(object.kind);
  json["masses_kg"] = object.masses;
  json["stiffness_n_per_m"] = object.stiffness;
  json["damping_n_s_per_m"] = object.damping;
  json["viscosity_n_s_per_m"] = object.viscosity;
  json["gravity_m_per_s2"] = toArray(object.gravity);
  if (object.kind == ObjectKind::Body) {
    json["inertia_kg_m2"] = object.inertia;
    json["fp_offset_m"] = toArray(object.fpOffset);
  }
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

Json taskJson(const Task& task) {
  return {{"start", task.start},
          {"target", task.target},
          {"duration_s", task.duration},
          {"tolerance",
           {{"position_m", task.tolerance.position}, {"velocity_m_per_s", task.tolerance.velocity}, {"time_s", task.tolerance.time}}},
          {"onset_m", task.onset},
          {"arm_radius_m", task.armRadius},
          {"timeout_s", task.timeout},
          {"rest_s", task.rest.seconds},
          {"rest_speed_m_per_s", task.rest.speed}};
}

}  // namespace

std::string toJson(const Experiment& experiment) {
  Json json = Json::object();
  json["schema_version"] = experiment.schemaVersion;
  json["name"] = experiment.name;
  json["constraint"] = constraintJson(experiment.constraint);
  json["object"] = objectJson(experiment.object);
  if (experiment.coupling)
    json["coupling"] = {{"stiffness_n_per_m", experiment.coupling->stiffness}, {"damping_n_s_per_m", experiment.coupling->damping}};
  if (!experiment.hands.empty()) json["hands"] = Json::array();
  for (const Hand& hand : experiment.hands) json["hands"].push_back(handJson(hand, experiment.object.kind == ObjectKind::Body));
  if (experiment.task) json["task"] = taskJson(*experiment.task);
  json["method"] = experiment.method;
  json["hand_mass_kg"] = experiment.handMass;
  if (experiment.forceLimit) json["force_limit_n"] = *experiment.forceLimit;
  json["force_limit_ends_trial"] = experiment.forceLimitEndsTrial;
  json["timing"] = {{"max_missed_ticks", experiment.timing.maxMissedTicks}, {"max_gap_s", experiment.timing.maxGap}};
  json["velocity_estimator"] = {{"kind", experiment.velocityEstimator.kind}, {"cutoff_hz", experiment.velocityEstimator.cutoff}};
  const Arm& arm = experiment.arm;
  json["arm"] = {{"link_length_m", arm.length},
                 {"link_centre_m", arm.centre},
                 {"link_mass_kg", arm.mass},
                 {"link_inertia_kg_m2", arm.inertia},
                 {"joint_damping_n_m_s_per_rad", arm.damping},
                 {"shoulder_m", arm.shoulder},
                 {"elbow_left", arm.elbowLeft}};
  if (const SubjectScreen& screen = experiment.subjectScreen; !(screen == SubjectScreen{}))
    json["subject_screen"] = {{"semaphore", screen.semaphore}, {"target", screen.target}, {"masses", screen.masses},
                              {"words", screen.words},         {"score", screen.score},   {"photodiode", screen.photodiode}};
  if (!(lookOf(experiment) == SceneLook{})) json["look"] = Json::parse(experiment.text, nullptr, true, true)["look"];
  return json.dump(2) + "\n";
}

std::string definitionTextOf(const Experiment& experiment) {
  const constraints::ConstraintSpec& spec = experiment.constraint;
  if (!spec.definition.empty()) return spec.definition;
  if (!spec.curve.empty() || !spec.surface.empty() || spec.name == "free") return {};
  return constraints::toJson(constraints::findDefinition(spec.name, "constraint"));
}

}  // namespace reachlab::experiment
