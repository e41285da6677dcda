#include <fmt/format.h>

#include <filesystem>

#include "base/fault.h"
#include "base/json/json_reader.h"
#include "constraints/catalogue/definition.h"
#include "sim/experiment/checked_experiment.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/scene_look.h"

namespace reachlab::experiment {
namespace {

const std::vector<std::string> kObjectKinds{"point", "chain", "parallel", "body"};

Vec3 vec3(const std::vector<double>& values) { return {values[0], values[1], values[2]}; }

void readConstraint(ObjectReader& root, Experiment& experiment) {
  const JsonNode* node = root.required("constraint", "a name of the catalogue, or a curve or surface formula");
  if (node == nullptr) return;
  ObjectReader reader(root.faults(), *node, root.keyPath("constraint"));
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
}

void readInertia(ObjectReader& reader, Object& object) {
  const JsonNode* node = reader.required("inertia_kg_m2", "[Ix, Iy, Iz] or a symmetric positive 3 x 3 matrix");
  if (node == nullptr) return;
  const bool isMatrix = node->kind == JsonNode::Kind::Array && !node->items.empty() && node->items[0].kind == JsonNode::Kind::Array;
  std::vector<double> row;
  if (!isMatrix) {
    if (!reader.numbers(*node, "inertia_kg_m2", 3, anyNumber(), row)) return;
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
  const auto list = [&](const char* key, std::vector<double>& values) {
    const JsonNode* numbers = reader.optional(key);
    return numbers != nullptr && reader.numbers(*numbers, key, -1, anyNumber(), values);
  };
  list("masses_kg", object.masses);
  list("stiffness_n_per_m", object.stiffness);
  const std::size_t springs = object.masses.empty() ? 0 : object.masses.size() - (object.kind == ObjectKind::Parallel ? 0 : 1);
  if (!list("damping_n_s_per_m", object.damping)) object.damping.assign(springs, 0.0);
  reader.number("viscosity_n_s_per_m", anyNumber(), object.viscosity);
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
  const JsonNode* node = root.optional("coupling");
  if (node == nullptr) return;
  ObjectReader reader(root.faults(), *node, "coupling");
  Coupling coupling;
  reader.requiredNumber("stiffness_n_per_m", anyNumber(), coupling.stiffness);
  reader.number("damping_n_s_per_m", anyNumber(), coupling.damping);
  reader.finish();
  experiment.coupling = coupling;
}

// What a hand's springs are where they are not given: those that a single hand would have.
void readHand(ObjectReader& reader, const Experiment& experiment, Hand& hand) {
  const Object& object = experiment.object;
  const bool parallel = object.kind == ObjectKind::Parallel;
  const JsonNode* stiffness = reader.optional("stiffness_n_per_m");
  const JsonNode* damping = reader.optional("damping_n_s_per_m");
  const auto isList = [](const JsonNode* node) { return node != nullptr && node->kind == JsonNode::Kind::Array; };
  const bool toAll = isList(stiffness) || isList(damping) || (parallel && reader.optional("mass") == nullptr);
  if (toAll) {
    hand.mass = 0;
    hand.stiffness = object.stiffness;
    hand.damping = object.damping;
    if (!parallel) hand.stiffness.clear(), hand.damping.assign(object.masses.size(), 0.0);
    if (stiffness != nullptr) reader.numbers(*stiffness, "stiffness_n_per_m", -1, anyNumber(), hand.stiffness);
    if (damping != nullptr) reader.numbers(*damping, "damping_n_s_per_m", -1, anyNumber(), hand.damping);
    if (reader.optional("mass") != nullptr)
      reader.faults().add(*reader.optional("mass"), reader.keyPath("mass"), "stands beside a list of springs, one for each mass",
                          "a mass and one stiffness, or a list without a mass");
  } else {
    const Coupling coupling = experiment.coupling.value_or(Coupling{});
    hand.stiffness = {coupling.stiffness};
    hand.damping = {coupling.damping};
    reader.integer("mass", 1, kMaxMasses, hand.mass);
    if (parallel && stiffness == nullptr)
      reader.faults().add(reader.node(), reader.keyPath("stiffness_n_per_m"), "is missing, and a parallel object has no coupling",
                          "a stiffness in N/m");
    reader.number("stiffness_n_per_m", anyNumber(), hand.stiffness[0]);
    reader.number("damping_n_s_per_m", anyNumber(), hand.damping[0]);
  }
  hand.fpOffset = object.fpOffset;
  if (object.kind != ObjectKind::Body) return;
  std::vector<double> triple;
  if (const JsonNode* offset = reader.optional("fp_offset_m"))
    if (reader.numbers(*offset, "fp_offset_m", 3, anyNumber(), triple)) hand.fpOffset = vec3(triple);
}

void readHands(ObjectReader& root, Experiment& experiment) {
  const JsonNode* node = root.optional("hands");
  if (node == nullptr) return;
  if (node->kind != JsonNode::Kind::Array || node->items.empty())
    return root.faults().add(*node, "hands", "is no list of hands", "[ { \"mass\": 1 }, { \"mass\": 5 } ], one for each hand");
  for (std::size_t i = 0; i < node->items.size(); ++i) {
    ObjectReader reader(root.faults(), node->items[i], fmt::format("hands[{}]", i));
    readHand(reader, experiment, experiment.hands.emplace_back());
    reader.finish();
  }
}

/// Numbers, of which some may be told as constants ("2*pi"): a place on a circle is then what is meant, and not sixteen digits of it.
JsonNode withConstants(ObjectReader& reader, JsonNode numbers, const std::string& key) {
  for (std::size_t i = 0; i < numbers.items.size(); ++i) {
    JsonNode& item = numbers.items[i];
    if (item.kind != JsonNode::Kind::String) continue;
    const std::string name = fmt::format("{}[{}]", reader.keyPath(key), i);
    item.number = 0;  // where it is no constant: that is told once
    try {
      item.number = constraints::constantOf(item.string, {}, {}, name);
    } catch (const FaultError& error) {
      reader.faults().add(item, name, error.faults.front().what, "a number, or a constant such as \"2*pi\"");
    }
    item.kind = JsonNode::Kind::Number;
  }
  return numbers;
}

void readTask(ObjectReader& root, Experiment& experiment) {
  const JsonNode* node = root.optional("task");
  if (node == nullptr) return;
  ObjectReader reader(root.faults(), *node, "task");
  Task task;
  for (auto [key, values] : {std::pair{"start", &task.start}, std::pair{"target", &task.target}})
    if (const JsonNode* place = reader.optional(key)) reader.numbers(withConstants(reader, *place, key), key, -1, anyNumber(), *values);
  reader.requiredNumber("duration_s", anyNumber(), task.duration);
  if (const JsonNode* tolerance = reader.required("tolerance", "{ position_m, velocity_m_per_s, time_s }")) {
    ObjectReader inner(root.faults(), *tolerance, "task.tolerance");
    inner.requiredNumber("position_m", anyNumber(), task.tolerance.position);
    inner.requiredNumber("velocity_m_per_s", anyNumber(), task.tolerance.velocity);
    inner.requiredNumber("time_s", anyNumber(), task.tolerance.time);
    inner.finish();
  }
  reader.number("onset_m", anyNumber(), task.onset);
  reader.number("arm_radius_m", anyNumber(), task.armRadius);
  reader.number("timeout_s", anyNumber(), task.timeout);
  reader.number("rest_s", anyNumber(), task.rest.seconds);
  reader.number("rest_speed_m_per_s", anyNumber(), task.rest.speed);
  reader.finish();
  experiment.task = std::move(task);
}

void readArm(ObjectReader& root, Experiment& experiment) {
  const JsonNode* node = root.optional("arm");
  if (node == nullptr) return;
  ObjectReader reader(root.faults(), *node, "arm");
  Arm& arm = experiment.arm;
  const auto pair = [&](const std::string& key, std::array<double, 2>& value) {
    std::vector<double> read;
    if (const JsonNode* values = reader.optional(key))
      if (reader.numbers(*values, key, 2, anyNumber(), read)) value = {read[0], read[1]};
  };
  pair("link_length_m", arm.length);
  pair("link_centre_m", arm.centre);
  pair("link_mass_kg", arm.mass);
  pair("link_inertia_kg_m2", arm.inertia);
  pair("joint_damping_n_m_s_per_rad", arm.damping);
  pair("shoulder_m", arm.shoulder);
  reader.boolean("elbow_left", arm.elbowLeft);
  reader.finish();
}

void readTiming(ObjectReader& root, Experiment& experiment) {
  const JsonNode* node = root.optional("timing");
  if (node == nullptr) return;
  ObjectReader reader(root.faults(), *node, "timing");
  reader.integer("max_missed_ticks", 0, kNoTimingLimits.maxMissedTicks, experiment.timing.maxMissedTicks);
  reader.number("max_gap_s", anyNumber(), experiment.timing.maxGap);
  reader.finish();
}

void readVelocityEstimator(ObjectReader& root, Experiment& experiment) {
  const JsonNode* node = root.optional("velocity_estimator");
  if (node == nullptr) return;
  if (node->kind == JsonNode::Kind::String) return root.text("velocity_estimator", experiment.velocityEstimator.kind);
  ObjectReader reader(root.faults(), *node, "velocity_estimator");
  if (reader.required("kind", listOf(velocityEstimatorNames())) != nullptr) reader.text("kind", experiment.velocityEstimator.kind);
  reader.number("cutoff_hz", anyNumber(), experiment.velocityEstimator.cutoff);
  reader.finish();
}

void readSubjectScreen(ObjectReader& root, SubjectScreen& screen) {
  const JsonNode* node = root.optional("subject_screen");
  if (node == nullptr) return;
  ObjectReader reader(root.faults(), *node, "subject_screen");
  reader.boolean("semaphore", screen.semaphore);
  reader.boolean("target", screen.target);
  reader.boolean("masses", screen.masses);
  reader.boolean("words", screen.words);
  reader.boolean("score", screen.score);
  reader.boolean("photodiode", screen.photodiode);
  reader.finish();
}

/// What cannot be judged because of what the file does not say: a count of springs where the masses are unreadable, say.
bool hangsOn(const FaultList& file, const Fault& fault) {
  const auto about = [&](const char* key) { return fault.key.starts_with(key); };
  if (file.isAbout("object.kind") && (about("object") || about("coupling"))) return true;
  if (file.isAbout("object.masses_kg") && (about("object.stiffness") || about("object.damping"))) return true;
  return file.isAbout("constraint") && (about("task.start") || about("task.target"));
}

/// The faults of the value at their places in the file, beside those of the file itself.
void addProblems(const JsonNode& tree, const std::vector<Fault>& problems, FaultList& faults) {
  const FaultList ofFile = faults;
  for (const Fault& fault : problems)
    if (!hangsOn(ofFile, fault)) faults.addOfValue(tree, fault);
}

Experiment readTree(const JsonNode& tree, const std::string& text, const std::string& file, const std::string& definition,
                    FaultList& faults) {
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
  experiment.constraint.definition = definition;
  readConstraint(root, experiment);
  readObject(root, experiment);
  readCoupling(root, experiment);
  readHands(root, experiment);
  readTask(root, experiment);
  root.text("method", experiment.method);
  root.number("hand_mass_kg", anyNumber(), experiment.handMass);
  if (root.optional("force_limit_n") != nullptr) {
    double limit = 0;
    if (root.requiredNumber("force_limit_n", anyNumber(), limit)) experiment.forceLimit = limit;
  }
  root.boolean("force_limit_ends_trial", experiment.forceLimitEndsTrial);
  readTiming(root, experiment);
  readVelocityEstimator(root, experiment);
  readSubjectScreen(root, experiment.subjectScreen);
  if (const JsonNode* look = root.optional("look")) (void)readLook(root.faults(), *look);  // its value stands in the text
  readArm(root, experiment);
  root.finish();

  experiment.constraint.inUse = placesInUse(experiment.task);
  return experiment;
}

}  // namespace

CompiledExperiment openExperimentText(const std::string& text, const std::string& file, const std::string& definition) {
  FaultList faults(file);
  const JsonNode tree = parseJson(text, file);
  if (tree.find("blocks") != nullptr)
    throw FaultError(
        Fault{file, "is a session plan, and an experiment is needed here", "an experiment file or name, such as the plan's blocks have"});
  Experiment experiment = readTree(tree, text, file, definition, faults);
  CheckedExperiment checked = check(experiment);
  addProblems(tree, checked.faults, faults);
  faults.throwIfAny();
  return {std::move(experiment), std::make_shared<const constraints::Constraint>(std::move(*checked.constraint))};
}

Experiment readUnchecked(const std::string& text, const std::string& file, const std::string& definition) {
  FaultList faults(file);
  const JsonNode tree = parseJson(text, file);
  Experiment experiment = readTree(tree, text, file, definition, faults);
  faults.throwIfAny();
  return experiment;
}

Experiment parseExperiment(const std::string& text, const std::string& file, const std::string& definition) {
  return openExperimentText(text, file, definition).experiment();
}

namespace {

Experiment knowingItsPlaces(Experiment experiment) {
  experiment.constraint.inUse = placesInUse(experiment.task);
  return experiment;
}

std::shared_ptr<const constraints::Constraint> constraintOf(const Experiment& experiment, const CompiledExperiment* origin) {
  const bool same = origin != nullptr && isSameConstraint(experiment.constraint, origin->experiment().constraint);
  CheckedExperiment checked = check(experiment, same ? &origin->constraint() : nullptr);
  if (!checked.faults.empty()) throw FaultError(std::move(checked.faults));
  return std::make_shared<const constraints::Constraint>(std::move(*checked.constraint));
}

}  // namespace

CompiledExperiment::CompiledExperiment(const Experiment& experiment)
    : CompiledExperiment(knowingItsPlaces(experiment), constraintOf(experiment, nullptr)) {}

CompiledExperiment::CompiledExperiment(const Experiment& experiment, const CompiledExperiment& origin)
    : CompiledExperiment(knowingItsPlaces(experiment), constraintOf(knowingItsPlaces(experiment), &origin)) {}

}  // namespace reachlab::experiment
