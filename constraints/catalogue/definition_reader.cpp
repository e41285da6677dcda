#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "base/fault.h"
#include "base/json/json_reader.h"
#include "base/text_file.h"
#include "constraints/catalogue/definition.h"

namespace reachlab::constraints {
namespace {

const std::vector<std::string> kKinds{"curve", "surface"};
const std::vector<std::string> kEnds{"stop", "bounce"};

class DefinitionReader {
 public:
  DefinitionReader(FaultList& faults, const JsonNode& tree) : faults_(faults), tree_(tree), root_(faults, tree, "") {}

  Definition read() {
    double version = 1;
    root_.requiredNumber("schema_version", {1, 1, true, "1, the version that this program reads"}, version);
    readName();
    readCoordinates();
    readShape();
    readDomain();
    readPerParameter();
    if (faults_.empty()) {
      readPlace("start", definition_.start);
      readPlace("target", definition_.target);
    } else {  // their expressions may name what could not be read
      for (const char* key : {"start", "target"}) root_.optional(key);
    }
    root_.text("sentence", definition_.sentence);
    root_.text("source", definition_.source);
    root_.finish();
    if (faults_.empty())
      for (Fault& fault : problems(definition_)) faults_.addOfValue(tree_, std::move(fault));
    return definition_;
  }

 private:
  std::size_t dimensions() const { return definition_.kind == ConstraintKind::Curve ? 1 : 2; }

  void readName() {
    if (root_.required("name", "the definition's name") != nullptr) root_.text("name", definition_.name);
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
    if (node->members.size() > kMaxShapeParameters)
      return faults_.add(*node, "shape", fmt::format("has {} names", node->members.size()), fmt::format("up to {}", kMaxShapeParameters));
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
      definition_.shape.push_back(p);
    }
  }

  // A number, or a constant expression in the shape's names, as text.
  bool readText(const JsonNode& node, const std::string& key, std::string& text) {
    if (node.kind == JsonNode::Kind::Number) text = fmt::format("{}", node.number);
    else if (node.kind == JsonNode::Kind::String) text = node.string;
    if (text.empty())
      faults_.add(node, key, node.kind == JsonNode::Kind::String ? "is empty" : fmt::format("is {}", nameOf(node.kind)),
                  "a number, or an expression such as \"2*pi\"");
    return !text.empty();
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
    if (node.items[0].kind != JsonNode::Kind::Null) readText(node.items[0], key + "[0]", domain.lo);
    if (node.items[1].kind != JsonNode::Kind::Null) readText(node.items[1], key + "[1]", domain.hi);
  }

  // `periodic` and `at_end`: one value, or one a parameter.
  void readPerParameter() {
    if (const JsonNode* node = root_.optional("periodic"))
      forEach(*node, "periodic", [&](const JsonNode& value, std::size_t k, const std::string& key) {
        if (value.kind != JsonNode::Kind::Boolean)
          return faults_.add(value, key, fmt::format("is {}", nameOf(value.kind)), "true or false");
        definition_.domain[k].periodic = value.boolean;
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
    for (std::size_t k = 0; k < dimensions(); ++k) {
      std::string text;
      if (!readText(node->items[k], fmt::format("{}[{}]", key, k), text)) return;
      try {
        place.push_back(constantOf(text, formulaOf(definition_), defaultsOf(definition_), fmt::format("{}[{}]", key, k)));
      } catch (const FaultError& error) {
        for (const Fault& fault : error.faults) faults_.addOfValue(tree_, fault);
      }
    }
  }

  FaultList& faults_;
  const JsonNode& tree_;
  ObjectReader root_;
  Definition definition_;
};

}  // namespace

FormulaText formulaOf(const Definition& definition) {
  FormulaText text{definition.kind, definition.coordinates, {}};
  for (const ShapeParameter& p : definition.shape) text.parameters.push_back(p.name);
  return text;
}

double constantOf(const std::string& expression, const FormulaText& names, const std::array<double, kMaxShapeParameters>& shape,
                  const std::string& key) {
  ExpressionGraph graph;
  const ParsedFormula parsed = parseFormula(expression, {{}, names.parameters}, graph);
  if (parsed.fault)
    throw FaultError(Fault{key, parsed.fault->what, parsed.fault->allowed, FilePlace{{}, 0, static_cast<int>(parsed.fault->character)}});
  const double value = evaluateNode(graph, parsed.root, shape.data(), nullptr);
  if (!std::isfinite(value)) throw FaultError(Fault{key, "is not finite", "a finite number"});
  return value;
}

std::array<Domain, 2> domainOf(const Definition& definition, const std::array<double, kMaxShapeParameters>& shape) {
  std::array<Domain, 2> domain;
  const FormulaText names = formulaOf(definition);
  for (std::size_t k = 0; k < 2; ++k) {
    const DomainText& text = definition.domain[k];
    const std::string key = definition.kind == ConstraintKind::Curve ? "domain" : fmt::format("domain[{}]", k);
    if (!text.lo.empty()) domain[k].lo = constantOf(text.lo, names, shape, key + "[0]");
    if (!text.hi.empty()) domain[k].hi = constantOf(text.hi, names, shape, key + "[1]");
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

Definition readNamedDefinition(const std::string& file) {
  Definition definition = readDefinition(file);
  const std::string stem = std::filesystem::path(file).stem().string();
  if (definition.name != stem)
    throw FaultError(Fault{"name", fmt::format("is \"{}\" in a file that is found as \"{}\"", definition.name, stem), "one name for both",
                           FilePlace{file}});
  return definition;
}

std::vector<Definition> readDefinitionFolder(const std::string& folder, std::vector<Fault>& faults) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  std::vector<Definition> definitions;
  for (const std::string& file : files) {
    try {
      definitions.push_back(readNamedDefinition(file));
    } catch (const FaultError& faulty) {
      faults.insert(faults.end(), faulty.faults.begin(), faulty.faults.end());
    }
  }
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
