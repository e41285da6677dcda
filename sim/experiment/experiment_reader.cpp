#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/ticks.h"
#include "base/json_reader.h"
#include "sim/experiment/compiled_experiment.h"

namespace reachlab::experiment {
namespace {

const std::vector<std::string> kMethods{"auto", "rk4", "exact", "abm", "adaptive", "stiff"};
const std::vector<std::string> kObjectKinds{"point", "chain", "parallel", "body"};
const std::vector<std::string> kEstimators{"auto", "difference", "low-pass", "butterworth", "kalman", "adaptive-window", "device"};

Vec3 vec3(const std::vector<double>& values) { return {values[0], values[1], values[2]}; }

// Where the task moves a typed formula on: the hull of start and target, when both are there.
std::optional<std::array<constraints::Domain, 2>> placesInUse(const JsonNode& tree) {
  const JsonNode* task = tree.find("task");
  const JsonNode* start = task == nullptr ? nullptr : task->find("start");
  const JsonNode* target = task == nullptr ? nullptr : task->find("target");
  if (start == nullptr || target == nullptr || start->items.empty() || start->items.size() > 2 ||
      start->items.size() != target->items.size())
    return {};
  std::array<constraints::Domain, 2> range{constraints::Domain{0, 0}, constraints::Domain{0, 0}};
  for (std::size_t k = 0; k < start->items.size(); ++k) {
    const JsonNode &a = start->items[k], &b = target->items[k];
    if (a.kind != JsonNode::Kind::Number || b.kind != JsonNode::Kind::Number) return {};
    range[k] = {std::min(a.number, b.number), std::max(a.number, b.number)};
  }
  return range;
}

void readConstraint(ObjectReader& root, Experiment& experiment, std::optional<constraints::Constraint>& constraint) {
  const JsonNode* node = root.required("constraint", "a name of the catalogue, or a curve or surface formula");
  if (node == nullptr) return;
  ObjectReader reader(root.faults(), *node, root.keyPath("constraint"));
  const std::size_t faultsBefore = root.faults().faults().size();
  constraints::ConstraintSpec& spec = experiment.constraint;
  spec.name.clear();
  const JsonNode* curve = reader.optional("curve");
  const JsonNode* surface = reader.optional("surface");
  const JsonNode* name = reader.optional("name");
  if ((name != nullptr) + (curve != nullptr) + (surface != nullptr) != 1)
    root.faults().add(*node, "constraint", "needs exactly one of name, curve and surface", "one of the three");
  reader.text("name", spec.name);
  if (curve != nullptr) reader.strings(*curve, "curve", 3, spec.curve);
  if (surface != nullptr) reader.strings(*surface, "surface", 3, spec.surface);
  if (const JsonNode* shape = reader.optional("shape")) {
    ObjectReader shapeReader(root.faults(), *shape, reader.keyPath("shape"));
    for (const auto& [key, value] : shape->members) shapeReader.number(key, anyNumber(), spec.shape[key]);
  }
  reader.finish();
  if (root.faults().faults().size() > faultsBefore) return;
  try {
    spec.inUse = placesInUse(root.node());
    constraint = constraints::makeConstraint(spec, root.faults().place(*node) + ": constraint");
  } catch (const UsageError& e) {
    root.faults().addLine(e.what());
  }
}

void readInertia(ObjectReader& reader, Object& object) {
  const JsonNode* node = reader.required("inertia_kg_m2", "[Ix, Iy, Iz] or a symmetric positive 3 x 3 matrix");
  if (node == nullptr) return;
  const bool isMatrix = node->kind == JsonNode::Kind::Array && !node->items.empty() && node->items[0].kind == JsonNode::Kind::Array;
  std::vector<double> row;
  if (!isMatrix) {
    if (!reader.numbers(*node, "inertia_kg_m2", 3, positive("kg m^2"), row)) return;
    for (std::size_t i = 0; i < 3; ++i) object.inertia[i][i] = row[i];
    return;
  }
  if (node->items.size() != 3) {
    reader.faults().add(*node, reader.keyPath("inertia_kg_m2"), fmt::format("has {} rows", node->items.size()), "3 rows");
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (!reader.numbers(node->items[i], fmt::format("inertia_kg_m2[{}]", i), 3, anyNumber(), row)) return;
    for (std::size_t j = 0; j < 3; ++j) object.inertia[i][j] = row[j];
  }
  const auto& m = object.inertia;
  const double minor2 = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                             m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  const bool symmetric = m[0][1] == m[1][0] && m[0][2] == m[2][0] && m[1][2] == m[2][1];
  if (!symmetric || !(m[0][0] > 0 && minor2 > 0 && determinant > 0))
    reader.faults().add(*node, reader.keyPath("inertia_kg_m2"), "is not a symmetric positive matrix", "an inertia tensor");
}

void readObject(ObjectReader& root, Experiment& experiment) {
  const JsonNode* node = root.required("object", "{ kind, masses_kg, … }");
  if (node == nullptr) return;
  ObjectReader reader(root.faults(), *node, "object");
  Object& object = experiment.object;
  std::string kind;
  const bool hasKind = reader.choice("kind", kObjectKinds, kind, true);
  if (hasKind)
    object.kind = kind == "chain"      ? ObjectKind::Chain
                  : kind == "parallel" ? ObjectKind::Parallel
                  : kind == "body"     ? ObjectKind::Body
                                       : ObjectKind::Point;
  const bool hasSprings = object.kind == ObjectKind::Chain || object.kind == ObjectKind::Parallel;
  bool hasMasses = false;
  if (const JsonNode* masses = reader.required("masses_kg", fmt::format("1 to {} masses", kMaxMasses))) {
    hasMasses = reader.numbers(*masses, "masses_kg", hasSprings ? -1 : 1, positive("kg"), object.masses);
    if (hasMasses && (object.masses.empty() || object.masses.size() > kMaxMasses)) {
      reader.faults().add(*masses, "object.masses_kg", fmt::format("has {} elements", object.masses.size()),
                          fmt::format("1 to {}", kMaxMasses));
      hasMasses = false;
    }
  }
  int springs = 0;
  if (hasMasses) springs = static_cast<int>(object.masses.size()) - (object.kind == ObjectKind::Parallel ? 0 : 1);
  const std::string springsAllowed = fmt::format("{} number{} (0 N/m or more)", springs, springs == 1 ? "" : "s");
  const JsonNode* stiffness =
      springs > 0 && hasMasses && hasKind ? reader.required("stiffness_n_per_m", springsAllowed) : reader.optional("stiffness_n_per_m");
  if (stiffness != nullptr && hasMasses && hasKind)
    reader.numbers(*stiffness, "stiffness_n_per_m", springs, atLeastZero("N/m"), object.stiffness);
  const JsonNode* damping = reader.optional("damping_n_s_per_m");
  object.damping.assign(static_cast<std::size_t>(springs), 0.0);
  if (damping != nullptr && hasMasses && hasKind)
    reader.numbers(*damping, "damping_n_s_per_m", springs, atLeastZero("N s/m"), object.damping);
  reader.number("viscosity_n_s_per_m", atLeastZero("N s/m"), object.viscosity);
  std::vector<double> triple;
  if (const JsonNode* gravity = reader.optional("gravity_m_per_s2"))
    if (reader.numbers(*gravity, "gravity_m_per_s2", 3, anyNumber(), triple)) object.gravity = vec3(triple);
  if (object.kind == ObjectKind::Body && hasKind) {
    readInertia(reader, object);
    if (const JsonNode* offset = reader.optional("fp_offset_m"))
      if (reader.numbers(*offset, "fp_offset_m", 3, anyNumber(), triple)) object.fpOffset = vec3(triple);
  }
  reader.finish();
}

void readCoupling(ObjectReader& root, Experiment& experiment) {
  const bool parallel = experiment.object.kind == ObjectKind::Parallel;
  const JsonNode* node =
      parallel ? root.optional("coupling") : root.required("coupling", "{ \"stiffness_n_per_m\": …, \"damping_n_s_per_m\": … }");
  if (node == nullptr) return;
  if (parallel) {
    root.faults().add(*node, "coupling", "stands beside a parallel object, whose own springs are the hand's", "no coupling");
    return;
  }
  ObjectReader reader(root.faults(), *node, "coupling");
  Coupling coupling;
  reader.requiredNumber("stiffness_n_per_m", atLeastZero("N/m"), coupling.stiffness);
  reader.number("damping_n_s_per_m", atLeastZero("N s/m"), coupling.damping);
  reader.finish();
  experiment.coupling = coupling;
}

constexpr double kLongestDuration = 3600, kLongestTimeout = 86400;  // [s]
NumberRange seconds(double most) { return {0, most, false, fmt::format("more than 0 s, at most {:.0f} s", most)}; }

void readTask(ObjectReader& root, Experiment& experiment, int coordinates) {
  const JsonNode* node = root.optional("task");
  if (node == nullptr) return;
  ObjectReader reader(root.faults(), *node, "task");
  Task task;
  for (auto [key, values] : {std::pair{"start", &task.start}, std::pair{"target", &task.target}})
    if (const JsonNode* place = reader.required(key, "constraint parameters, or three metres when free"))
      reader.numbers(*place, key, coordinates, anyNumber(), *values);
  reader.requiredNumber("duration_s", seconds(kLongestDuration), task.duration);
  if (const JsonNode* tolerance = reader.required("tolerance", "{ position_m, velocity_m_per_s, time_s }")) {
    ObjectReader inner(root.faults(), *tolerance, "task.tolerance");
    inner.requiredNumber("position_m", positive("m"), task.tolerance.position);
    inner.requiredNumber("velocity_m_per_s", positive("m/s"), task.tolerance.velocity);
    inner.requiredNumber("time_s", seconds(kLongestDuration), task.tolerance.time);
    inner.finish();
  }
  reader.number("onset_m", positive("m"), task.onset);
  reader.number("arm_radius_m", positive("m"), task.armRadius);
  reader.number("timeout_s", seconds(kLongestTimeout), task.timeout);
  reader.finish();
  experiment.task = std::move(task);
}

void readArm(ObjectReader& root, Experiment& experiment) {
  const JsonNode* node = root.optional("arm");
  if (node == nullptr) return;
  ObjectReader reader(root.faults(), *node, "arm");
  Arm& arm = experiment.arm;
  const auto pair = [&](const std::string& key, const NumberRange& range, std::array<double, 2>& value) {
    std::vector<double> read;
    if (const JsonNode* values = reader.optional(key))
      if (reader.numbers(*values, key, 2, range, read)) value = {read[0], read[1]};
  };
  pair("link_length_m", positive("m"), arm.length);
  pair("link_centre_m", positive("m"), arm.centre);
  pair("link_mass_kg", positive("kg"), arm.mass);
  pair("link_inertia_kg_m2", positive("kg m^2"), arm.inertia);
  pair("joint_damping_n_m_s_per_rad", atLeastZero("N m s/rad"), arm.damping);
  pair("shoulder_m", anyNumber(), arm.shoulder);
  reader.boolean("elbow_left", arm.elbowLeft);
  reader.finish();
}

void readTiming(ObjectReader& root, Experiment& experiment) {
  const JsonNode* node = root.optional("timing");
  if (node == nullptr) return;
  ObjectReader reader(root.faults(), *node, "timing");
  reader.integer("max_missed_ticks", 0, kNoTimingLimits.maxMissedTicks, experiment.timing.maxMissedTicks);
  // A gap between two ticks is never shorter than one.
  reader.number("max_gap_s", {kTickSeconds, kNoTimingLimits.maxGap, true, fmt::format("{} s to {:.0f} s", kTickSeconds, kNoTimingLimits.maxGap)},
                experiment.timing.maxGap);
  reader.finish();
}

void readVelocityEstimator(ObjectReader& root, Experiment& experiment) {
  const JsonNode* node = root.optional("velocity_estimator");
  if (node == nullptr) return;
  if (node->kind == JsonNode::Kind::String) {
    root.choice("velocity_estimator", kEstimators, experiment.velocityEstimator.kind, false);
    return;
  }
  ObjectReader reader(root.faults(), *node, "velocity_estimator");
  reader.choice("kind", kEstimators, experiment.velocityEstimator.kind, true);
  NumberRange cutoff = positive("Hz");
  cutoff.hi = 400;
  cutoff.allowed = "more than 0 Hz, at most 400 Hz";
  reader.number("cutoff_hz", cutoff, experiment.velocityEstimator.cutoff);
  reader.finish();
}

}  // namespace

CompiledExperiment openExperimentText(const std::string& text, const std::string& file, const std::string& definition) {
  FaultList faults(file);
  const JsonNode tree = parseJson(text, file);
  ObjectReader root(faults, tree, "");
  faults.throwIfAny();
  Experiment experiment;
  experiment.text = text;
  experiment.name = std::filesystem::path(file).stem().string();

  double version = 1;
  root.requiredNumber("schema_version", {1, 1, true, "1, the version that this program reads"}, version);
  root.text("name", experiment.name);
  std::string description;
  root.text("description", description);
  std::optional<constraints::Constraint> constraint;
  experiment.constraint.definition = definition;
  readConstraint(root, experiment, constraint);
  readObject(root, experiment);
  readCoupling(root, experiment);
  const int coordinates = !constraint ? -1 : constraint->kind == constraints::ConstraintKind::Free ? 3 : constraint->parameterCount();
  readTask(root, experiment, coordinates);
  root.choice("method", kMethods, experiment.method, false);
  root.number("hand_mass_kg", atLeastZero("kg"), experiment.handMass);
  if (root.optional("force_limit_n") != nullptr) {
    double limit = 0;
    if (root.requiredNumber("force_limit_n", positive("N"), limit)) experiment.forceLimit = limit;
  }
  root.boolean("force_limit_ends_trial", experiment.forceLimitEndsTrial);
  readTiming(root, experiment);
  readVelocityEstimator(root, experiment);
  readArm(root, experiment);
  root.finish();

  if (constraint && faults.empty()) {
    const JsonNode& object = *tree.find("object");
    if (experiment.object.kind == ObjectKind::Body && constraint->kind != constraints::ConstraintKind::Free)
      faults.add(object, "object.kind", "is body, which moves free", "constraint { \"name\": \"free\" }");
    if (experiment.object.masses.size() > 1 && constraint->kind == constraints::ConstraintKind::Surface)
      faults.add(object, "object.masses_kg", fmt::format("has {} masses on a surface", experiment.object.masses.size()),
                 "one mass on a surface; chains and parallel objects on curves or free");
    if (experiment.object.kind == ObjectKind::Parallel && constraint->kind == constraints::ConstraintKind::Surface)
      faults.add(object, "object.kind", "is parallel on a surface", "parallel on curves or free");
  }
  faults.throwIfAny();
  return {std::move(experiment), std::move(*constraint)};
}

Experiment parseExperiment(const std::string& text, const std::string& file, const std::string& definition) {
  return openExperimentText(text, file, definition).experiment();
}

CompiledExperiment::CompiledExperiment(const Experiment& experiment)
    : CompiledExperiment(openExperimentText(toJson(experiment), experiment.name, experiment.constraint.definition)) {
  auto own = std::make_shared<Experiment>(*experiment_);  // with its own text, where it has one
  if (!experiment.text.empty()) own->text = experiment.text;
  experiment_ = std::move(own);
}

}  // namespace reachlab::experiment
