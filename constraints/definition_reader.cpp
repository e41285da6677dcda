#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "constraints/definition.h"
#include "base/error.h"
#include "base/json_reader.h"

namespace reachlab::constraints {
namespace {

const std::vector<std::string> kKinds{"curve", "surface"};
const std::vector<std::string> kEnds{"stop", "bounce"};

bool isDefinitionName(const std::string& name) {
  return !name.empty() && name.size() <= 60 && name != "free" && name.front() != '-' &&
         std::all_of(name.begin(), name.end(), [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; });
}

class DefinitionReader {
 public:
  DefinitionReader(FaultList& faults, const JsonNode& tree) : faults_(faults), tree_(tree), root_(faults, tree, "") {}

  Definition read() {
    double version = 1;
    root_.requiredNumber("schema_version", {1, 1, true, "1, the version that this program reads"}, version);
    readName();
    readCoordinates();
    readShape();
    if (faults_.empty()) checkFormula();
    if (faults_.empty()) {
      names_ = formulaOf(definition_);
      for (std::size_t i = 0; i < definition_.shape.size(); ++i) defaults_[i] = definition_.shape[i].defaultValue;
      readDomain();
      readPerParameter();
      readPlace("start", definition_.start);
      readPlace("target", definition_.target);
    } else {
      for (const char* key : {"domain", "periodic", "at_end", "start", "target"}) root_.optional(key);
    }
    root_.text("sentence", definition_.sentence);
    root_.text("source", definition_.source);
    root_.finish();
    return definition_;
  }

 private:
  std::size_t dimensions() const { return definition_.kind == ConstraintKind::Curve ? 1 : 2; }
  const char* kindName() const { return definition_.kind == ConstraintKind::Curve ? "curve" : "surface"; }

  void readName() {
    const JsonNode* node = root_.required("name", "the definition's name");
    if (node == nullptr) return;
    root_.text("name", definition_.name);
    if (node->kind == JsonNode::Kind::String && !isDefinitionName(definition_.name))
      faults_.add(*node, "name", "is no name of a definition", "lower-case letters, digits and '-', at most 60, not free");
  }

  void readCoordinates() {
    std::string kind = "curve";
    const JsonNode* curve = root_.optional("curve");
    const JsonNode* surface = root_.optional("surface");
    if (surface != nullptr) kind = "surface";
    root_.choice("kind", kKinds, kind, true);
    definition_.kind = kind == "curve" ? ConstraintKind::Curve : ConstraintKind::Surface;
    const JsonNode* node = kind == "curve" ? curve : surface;
    if (node == nullptr) return faults_.add(tree_, kind, "is missing", "three formulas, one a coordinate");
    if (curve != nullptr && surface != nullptr) return faults_.add(tree_, "surface", "stands beside curve", "one of the two");
    std::vector<std::string> lines;
    if (root_.strings(*node, kind, 3, lines)) std::copy(lines.begin(), lines.end(), definition_.coordinates.begin());
  }

  void readShape() {
    const JsonNode* node = root_.optional("shape");
    if (node == nullptr) return;
    ObjectReader shape(faults_, *node, "shape");
    for (const auto& [key, value] : node->members) {
      shape.optional(key);
      ObjectReader reader(faults_, value, "shape." + key);
      ShapeParameter p;
      p.name = key;
      reader.requiredNumber("default", anyNumber(), p.defaultValue);
      reader.requiredNumber("min", anyNumber(), p.min);
      reader.requiredNumber("max", anyNumber(), p.max);
      reader.text("unit", p.unit);
      reader.text("meaning", p.meaning);
      reader.boolean("whole", p.whole);
      reader.finish();
      if (!(p.min <= p.defaultValue && p.defaultValue <= p.max))
        faults_.add(value, "shape." + key, fmt::format("default {} is not within min {} and max {}", p.defaultValue, p.min, p.max),
                    "min <= default <= max");
      definition_.shape.push_back(p);
    }
  }

  void checkFormula() {
    const JsonNode& node = *tree_.find(kindName());
    for (const FormulaFault& fault : formulaFaults(formulaOf(definition_))) {
      const bool inLine = fault.coordinate >= 0 && node.items.size() == 3;
      // A string without escapes: the fault's column is that of the line's opening quote plus the character.
      JsonNode place = inLine ? node.items[static_cast<std::size_t>(fault.coordinate)] : node;
      if (inLine) place.column += static_cast<int>(fault.character);
      faults_.add(place, inLine ? fmt::format("{}[{}]", kindName(), fault.coordinate) : kindName(), fault.what);
    }
  }

  // A number, or a constant expression in the shape's names.
  bool readConstant(const JsonNode& node, const std::string& key, std::string& text, double& value) {
    if (node.kind == JsonNode::Kind::Number) {
      text = fmt::format("{}", node.number);
      value = node.number;
      return true;
    }
    if (node.kind != JsonNode::Kind::String) {
      faults_.add(node, key, fmt::format("is {}", nameOf(node.kind)), "a number, or an expression such as \"2*pi\"");
      return false;
    }
    text = node.string;
    try {
      value = constantOf(text, names_, defaults_, faults_.place(node) + ": " + key);
      return true;
    } catch (const UsageError& e) {
      faults_.addLine(e.what());
      return false;
    }
  }

  void readDomain() {
    const JsonNode* node = root_.required("domain", "[lo, hi] (surfaces: two of them), null where there is no end");
    if (node == nullptr || node->kind == JsonNode::Kind::Null) return;
    if (dimensions() == 1) return readRange(*node, "domain", definition_.domain[0]);
    if (node->kind != JsonNode::Kind::Array || node->items.size() != 2)
      return faults_.add(*node, "domain", "is not two ranges", "[[lo, hi], [lo, hi]], null for a parameter without ends");
    for (std::size_t k = 0; k < 2; ++k)
      if (node->items[k].kind != JsonNode::Kind::Null) readRange(node->items[k], fmt::format("domain[{}]", k), definition_.domain[k]);
  }
  void readRange(const JsonNode& node, const std::string& key, DomainText& domain) {
    if (node.kind != JsonNode::Kind::Array || node.items.size() != 2)
      return faults_.add(node, key, "is not a range", "[lo, hi], null for no end");
    double lo = -INFINITY, hi = INFINITY;
    if (node.items[0].kind != JsonNode::Kind::Null && !readConstant(node.items[0], key, domain.lo, lo)) return;
    if (node.items[1].kind != JsonNode::Kind::Null && !readConstant(node.items[1], key, domain.hi, hi)) return;
    if (!(lo < hi)) faults_.add(node, key, fmt::format("runs from {} to {}", lo, hi), "lo < hi");
  }

  // `periodic` and `at_end`: one value, or one a parameter.
  void readPerParameter() {
    if (const JsonNode* node = root_.optional("periodic"))
      forEach(*node, "periodic", [&](const JsonNode& value, std::size_t k, const std::string& key) {
        if (value.kind != JsonNode::Kind::Boolean)
          return faults_.add(value, key, fmt::format("is {}", nameOf(value.kind)), "true or false");
        definition_.domain[k].periodic = value.boolean;
        if (value.boolean && (definition_.domain[k].lo.empty() || definition_.domain[k].hi.empty()))
          faults_.add(value, key, "is true without a range", "a domain with two ends");
      });
    if (const JsonNode* node = root_.optional("at_end"))
      forEach(*node, "at_end", [&](const JsonNode& value, std::size_t k, const std::string& key) {
        if (value.kind != JsonNode::Kind::String || std::find(kEnds.begin(), kEnds.end(), value.string) == kEnds.end())
          return faults_.add(value, key, "is neither", "stop or bounce");
        definition_.domain[k].atEnd = value.string == "bounce" ? AtEnd::Bounce : AtEnd::Stop;
      });
  }
  template <typename F>
  void forEach(const JsonNode& node, const std::string& key, F&& f) {
    if (node.kind != JsonNode::Kind::Array) {
      for (std::size_t k = 0; k < dimensions(); ++k) f(node, k, key);
    } else if (node.items.size() != dimensions()) {
      faults_.add(node, key, fmt::format("has {} values", node.items.size()), fmt::format("one, or {}", dimensions()));
    } else {
      for (std::size_t k = 0; k < dimensions(); ++k) f(node.items[k], k, fmt::format("{}[{}]", key, k));
    }
  }

  void readPlace(const std::string& key, std::vector<double>& place) {
    const JsonNode* node = root_.required(key, "constraint parameters");
    if (node == nullptr) return;
    if (node->kind != JsonNode::Kind::Array || node->items.size() != dimensions())
      return faults_.add(*node, key, "is no place", dimensions() == 1 ? "[phi]" : "[u, v]");
    const std::array<Domain, 2> domain = domainOf(definition_, defaults_);
    for (std::size_t k = 0; k < dimensions(); ++k) {
      std::string text;
      double value = 0;
      if (!readConstant(node->items[k], key, text, value)) return;
      if (!domain[k].periodic && !(value >= domain[k].lo && value <= domain[k].hi))
        faults_.add(node->items[k], key, fmt::format("is {}", value), fmt::format("{} to {}", domain[k].lo, domain[k].hi));
      place.push_back(value);
    }
  }

  FaultList& faults_;
  const JsonNode& tree_;
  ObjectReader root_;
  Definition definition_;
  FormulaText names_;
  std::array<double, kMaxShapeParameters> defaults_{};
};

}  // namespace

FormulaText formulaOf(const Definition& definition) {
  FormulaText text{definition.kind, definition.coordinates, {}};
  for (const ShapeParameter& p : definition.shape) text.parameters.push_back(p.name);
  return text;
}

double constantOf(const std::string& expression, const FormulaText& names, const std::array<double, kMaxShapeParameters>& shape,
                  const std::string& origin) {
  ExpressionGraph graph;
  const ParsedFormula parsed = parseFormula(expression, {{}, names.parameters}, graph);
  if (parsed.fault) throw UsageError(fmt::format("{}, character {}: {}", origin, parsed.fault->character, parsed.fault->what));
  const double value = evaluateNodes(graph, std::array{parsed.root}, shape.data(), nullptr)[0];
  if (!std::isfinite(value)) throw UsageError(origin + ": is not finite; allowed: a finite number");
  return value;
}

std::array<Domain, 2> domainOf(const Definition& definition, const std::array<double, kMaxShapeParameters>& shape) {
  std::array<Domain, 2> domain;
  const FormulaText names = formulaOf(definition);
  for (std::size_t k = 0; k < 2; ++k) {
    const DomainText& text = definition.domain[k];
    if (!text.lo.empty()) domain[k].lo = constantOf(text.lo, names, shape, definition.name + ": domain");
    if (!text.hi.empty()) domain[k].hi = constantOf(text.hi, names, shape, definition.name + ": domain");
    domain[k].periodic = text.periodic;
    domain[k].atEnd = text.atEnd;
  }
  return domain;
}

Definition parseDefinition(const std::string& text, const std::string& file) {
  FaultList faults(file);
  const JsonNode tree = parseJson(text, file);
  if (tree.kind != JsonNode::Kind::Object) {
    faults.add(tree, "file", fmt::format("is {}", nameOf(tree.kind)), "an object { … }");
    faults.throwIfAny();
  }
  Definition definition = DefinitionReader(faults, tree).read();
  faults.throwIfAny();
  return definition;
}

Definition readDefinition(const std::string& file) { return parseDefinition(readTextFile(file), file); }

std::vector<Definition> readDefinitionFolder(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  std::vector<Definition> definitions;
  for (const std::string& file : files) definitions.push_back(readDefinition(file));
  return definitions;
}

std::string userDefinitionFolder() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string(value == nullptr ? "" : value);
  };
  if (const std::string own = variable("REACHLAB_CONSTRAINTS"); !own.empty()) return own;
  if (const std::string data = variable("XDG_DATA_HOME"); !data.empty()) return data + "/reachlab/constraints";
  return variable("HOME") + "/.local/share/reachlab/constraints";
}

}  // namespace reachlab::constraints
