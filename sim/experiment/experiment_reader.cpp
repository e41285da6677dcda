#include <fmt/format.h>

#include <algorithm>

#include "base/fault.h"
#include "base/json/json_reader.h"
#include "base/names.h"
#include "constraints/catalogue/definition.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment_keys.h"
#include "sim/experiment/scene_look.h"

namespace reachlab::experiment {
namespace {

void readConstraint(ObjectReader& reader, constraints::ConstraintSpec& spec) {
  spec.name.clear();
  const JsonNode* curve = reader.optional("curve");
  const JsonNode* surface = reader.optional("surface");
  const JsonNode* name = reader.optional("name");
  if ((name != nullptr) + (curve != nullptr) + (surface != nullptr) != 1)
    reader.faults().add(reader.node(), "constraint", "needs exactly one of name, curve and surface", "one of the three");
  reader.text("name", spec.name);
  if (curve != nullptr) reader.strings(*curve, "curve", 3, spec.curve);
  if (surface != nullptr) reader.strings(*surface, "surface", 3, spec.surface);
  if (const JsonNode* shape = reader.optional("shape")) {
    ObjectReader shapeReader(reader.faults(), *shape, reader.keyPath("shape"));
    if (shape->members.size() > constraints::kMaxShapeParameters)
      reader.faults().add(*shape, reader.keyPath("shape"), fmt::format("has {} names", shape->members.size()),
                          fmt::format("up to {}", constraints::kMaxShapeParameters));
    else
      for (const auto& [key, value] : shape->members) shapeReader.number(key, anyNumber(), spec.shape[key]);
  }
}

template <std::size_t N>
void readMatrix(ObjectReader& reader, const JsonNode& node, const Key& key, SquareMatrix<N>& matrix) {
  const bool isArray = node.kind == JsonNode::Kind::Array;
  const int count = static_cast<int>(N);
  std::vector<double> row;
  if (key.diagonal && !(isArray && !node.items.empty() && node.items[0].kind == JsonNode::Kind::Array)) {
    if (!reader.numbers(node, key.name, count, anyNumber(), row)) return;
    for (std::size_t i = 0; i < N; ++i) matrix[i][i] = row[i];
    return;
  }
  if (!reader.faults().requireKind(node, JsonNode::Kind::Array, reader.keyPath(key.name), key.shape)) return;
  if (node.items.size() != N)
    return reader.faults().add(node, reader.keyPath(key.name), fmt::format("has {} rows", node.items.size()), fmt::format("{} rows", N));
  for (std::size_t i = 0; i < N; ++i) {
    if (!reader.numbers(node.items[i], fmt::format("{}[{}]", key.name, i), count, anyNumber(), row)) return;
    for (std::size_t j = 0; j < N; ++j) matrix[i][j] = row[j];
  }
}

/// The law of this kind with its defaults.
HandForce forceOfKind(const std::string& kind) {
  if (kind == "elastic") return {ElasticForce{}};
  if (kind == "joint-viscous") return {JointViscousForce{}};
  if (kind == "channel") return {ChannelForce{}, ForceWhen::Trial};
  if (kind == "pulse") return {PulseForce{}};
  return {ViscousForce{}};
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
    if (reader.numbers(*offset, "fp_offset_m", 3, anyNumber(), triple)) hand.fpOffset = {triple[0], triple[1], triple[2]};
}

void readHands(FaultList& faults, const JsonNode& node, const Experiment& experiment, std::vector<Hand>& hands) {
  if (node.kind != JsonNode::Kind::Array || node.items.empty())
    return faults.add(node, "hands", "is no list of hands", "[ { \"mass\": 1 }, { \"mass\": 5 } ], one for each hand");
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    ObjectReader reader(faults, node.items[i], fmt::format("hands[{}]", i));
    readHand(reader, experiment, hands.emplace_back());
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

/// Reads each key into its member. What depends on another key of the experiment finds it already read.
struct KeyReader {
  ObjectReader& in;
  const Experiment& experiment;

  void operator()(const Key& key, double& value) const {
    if (key.required) in.requiredNumber(key.name, anyNumber(), value);
    else in.number(key.name, anyNumber(), value);
  }
  void operator()(const Key& key, int& value) const {
    double read = value;
    if (key.required) in.requiredNumber(key.name, key.range, read);
    else in.number(key.name, key.range, read);
    if (isWithin(key.range, read)) value = static_cast<int>(read);
  }
  void operator()(const Key& key, bool& value) const { in.boolean(key.name, value); }
  void operator()(const Key& key, std::string& value) const {
    if (!key.required || in.required(key.name, listOf(*key.names)) != nullptr) in.text(key.name, value);
  }
  template <class T>
  requires std::is_enum_v<T>
  void operator()(const Key& key, T& value) const {
    std::string name;
    if (!in.choice(key.name, *key.names, name, key.required)) return;
    value = static_cast<T>(std::find(key.names->begin(), key.names->end(), name) - key.names->begin());
  }
  void operator()(const Key& key, ForceLaw& law) const {
    std::string kind;
    if (!in.choice(key.name, *key.names, kind, key.required)) return;
    std::visit([&](auto& of) { visitKeys(of, *this); }, law);
  }
  void operator()(const Key& key, Environment& environment) const {
    const JsonNode* node = in.optional(key.name);
    if (node == nullptr) return;
    if (!in.faults().requireKind(*node, JsonNode::Kind::Array, in.keyPath(key.name), "a list of forces")) return;
    for (std::size_t i = 0; i < node->items.size(); ++i) {
      const JsonNode& item = node->items[i];
      ObjectReader inner(in.faults(), item, fmt::format("{}[{}]", in.keyPath(key.name), i));
      const JsonNode* kind = item.find("kind");
      const std::string name = kind != nullptr ? kind->string : std::string{};
      visitKeys(environment.emplace_back(forceOfKind(name)), KeyReader{inner, experiment});
      if (std::count(kForceKindNames.begin(), kForceKindNames.end(), name) > 0) inner.finish();  // else no key is known
    }
  }
  void operator()(const Key& key, std::vector<double>& values) const {
    const JsonNode* node = in.optional(key.name);
    if (node == nullptr) return;
    in.numbers(key.constants ? withConstants(in, *node, key.name) : *node, key.name, -1, anyNumber(), values);
  }
  void operator()(const Key& key, std::array<double, 2>& pair) const {
    if (const auto read = numbers(key, 2); !read.empty()) pair = {read[0], read[1]};
  }
  void operator()(const Key& key, Vec3& v) const {
    if (const auto read = numbers(key, 3); !read.empty()) v = {read[0], read[1], read[2]};
  }
  void operator()(const Key& key, std::vector<Vec3>& places) const {
    const JsonNode* node = in.optional(key.name);
    if (node == nullptr) return;
    if (!in.faults().requireKind(*node, JsonNode::Kind::Array, in.keyPath(key.name), key.shape)) return;
    std::vector<double> place;
    for (std::size_t i = 0; i < node->items.size(); ++i)
      if (in.numbers(node->items[i], fmt::format("{}[{}]", key.name, i), 3, anyNumber(), place))
        places.push_back({place[0], place[1], place[2]});
  }
  template <std::size_t N>
  void operator()(const Key& key, SquareMatrix<N>& matrix) const {
    if (const JsonNode* node = find(key)) readMatrix(in, *node, key, matrix);
  }
  void operator()(const Key& key, std::vector<Hand>& hands) const {
    if (const JsonNode* node = find(key)) readHands(in.faults(), *node, experiment, hands);
  }
  template <class T>
  void operator()(const Key& key, std::optional<T>& value) const {
    Key given = key;
    given.required = true;  // an object of this key brings its number
    if (find(key) != nullptr) (*this)(given, value.emplace());
  }
  template <class T>
  void operator()(const Key& key, T& value) const {
    const JsonNode* node = find(key);
    if (node == nullptr) return;
    if constexpr (std::same_as<T, VelocityEstimatorSpec>)
      if (node->kind == JsonNode::Kind::String) return in.text(key.name, value.kind);
    ObjectReader inner(in.faults(), *node, in.keyPath(key.name));
    if constexpr (std::same_as<T, constraints::ConstraintSpec>) readConstraint(inner, value);
    else visitKeys(value, KeyReader{inner, experiment});
    if constexpr (std::same_as<T, Object>)
      if (node->find("damping_n_s_per_m") == nullptr) value.damping.assign(springCount(value), 0.0);
    inner.finish();
  }

 private:
  const JsonNode* find(const Key& key) const { return key.required ? in.required(key.name, key.shape) : in.optional(key.name); }
  std::vector<double> numbers(const Key& key, int count) const {
    std::vector<double> read;
    const JsonNode* node = in.optional(key.name);
    if (node == nullptr || !in.numbers(*node, key.name, count, anyNumber(), read)) return {};
    return read;
  }
};

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
  experiment.name = nameOfFile(file);

  experiment.constraint.definition = definition;
  visitKeys(experiment, KeyReader{root, experiment});
  std::string description;
  root.text("description", description);
  if (const JsonNode* look = root.optional("look")) (void)readLook(root.faults(), *look);  // its value stands in the text
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
  return {std::move(experiment), std::move(checked.constraint)};
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
  const bool same = origin != nullptr && experiment.constraint == origin->experiment().constraint;
  CheckedExperiment checked = check(experiment, same ? &origin->constraint() : nullptr);
  if (!checked.faults.empty()) throw FaultError(std::move(checked.faults));
  return std::move(checked.constraint);
}

}  // namespace

CompiledExperiment::CompiledExperiment(Experiment experiment, std::shared_ptr<const constraints::Constraint> constraint)
    : experiment_(std::make_shared<const Experiment>(std::move(experiment))), constraint_(std::move(constraint)) {}

CompiledExperiment::CompiledExperiment(const Experiment& experiment)
    : CompiledExperiment(knowingItsPlaces(experiment), constraintOf(experiment, nullptr)) {}

CompiledExperiment::CompiledExperiment(const Experiment& experiment, const CompiledExperiment& origin)
    : CompiledExperiment(knowingItsPlaces(experiment), constraintOf(knowingItsPlaces(experiment), &origin)) {}

}  // namespace reachlab::experiment
