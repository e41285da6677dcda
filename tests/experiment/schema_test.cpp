#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "base/json/json_reader.h"
#include "base/text_file.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/experiment_keys.h"
#include "sim/experiment/resources.h"
#include "sim/experiment/scene_look.h"

namespace reachlab::experiment {
namespace {

using Json = nlohmann::json;

class ShippedSchema : public testing::Test {
 protected:
  void SetUp() override {
    const Json text = Json::parse(readTextFile(resourceFolder() + "/schemas/experiment.schema.json"));
    valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(valijson::adapters::NlohmannJsonAdapter(text), schema_);
  }
  bool schemaAccepts(const Json& json) {
    return valijson::Validator().validate(schema_, valijson::adapters::NlohmannJsonAdapter(json), nullptr);
  }

 private:
  valijson::Schema schema_;
};

TEST_F(ShippedSchema, AcceptsWhatTheReaderAccepts) {
  for (const std::string& name : shippedExperiments()) {
    EXPECT_TRUE(schemaAccepts(Json::parse(readExperiment(name).text, nullptr, true, true))) << name;
    EXPECT_TRUE(schemaAccepts(Json::parse(toJson(readExperiment(name))))) << name;
  }
}

TEST_F(ShippedSchema, AcceptsALookThatTheReaderTakesAndTheWriterKeeps) {
  SceneLook look;
  look.surfaceOpacity = 0.8;
  look.depthCue = "grid";
  look.sceneFile = "table.wrl";
  look.colours["last"] = "#f58521";
  look.cameras.push_back({{{0, 0.5, 0.1}, {0.1, 0, 0}, {0, 0, -1}, 20, true}, "above"});
  const Experiment seen = withLook(readExperiment("chain-moderate"), look);
  EXPECT_EQ(lookOf(seen), look);
  EXPECT_EQ(lookOf(parseExperiment(toJson(seen), "x.json")), look);
  EXPECT_TRUE(schemaAccepts(Json::parse(toJson(seen))));
}

Json resolved(const Json& root, const Json& node) {
  if (node.contains("$ref")) {
    Json merged = root.at(Json::json_pointer(node["$ref"].get<std::string>().substr(1)));
    merged.update(node);
    return merged;
  }
  if (node.contains("anyOf")) return node["anyOf"].back();  // a name alone, or the object
  return node;
}

/// Walks the program's list of keys beside the schema's.
struct BesideSchema {
  const Json &root, &object;
  std::string path;
  std::set<std::string>& keys;

  template <class T>
  void operator()(const Key& key, const T& value) const {
    keys.insert(key.name);
    const std::string place = path + key.name;
    ASSERT_TRUE(object["properties"].contains(key.name)) << place;
    const Json node = resolved(root, object["properties"][key.name]);
    const Json needed = object.value("required", Json::array());
    constexpr bool kAskedOfTheValue = std::same_as<T, std::vector<double>> || std::same_as<T, decltype(Object::inertia)>;
    const bool ofOneLaw = path.starts_with("environment.") && key.required && key.name != std::string("kind");
    const bool needs = std::find(needed.begin(), needed.end(), key.name) != needed.end();
    EXPECT_TRUE(kAskedOfTheValue || ofOneLaw || key.required == needs) << place;
    if (key.names != nullptr) {
      EXPECT_EQ(node["enum"], Json(*key.names)) << place;
    }
    if constexpr (std::is_arithmetic_v<T> && !std::same_as<T, bool>) expectRange(node, key.range, place);
    else if constexpr (std::same_as<T, std::array<double, 2>>) expectRange(resolved(root, node["items"]), key.range, place);
    else if constexpr (std::same_as<T, ForceLaw>) std::visit([&](const auto& law) { visitKeys(law, *this); }, value);
    else if constexpr (std::same_as<T, Environment>) compareForces(node["items"], place + ".", value);
    else if constexpr (std::same_as<T, SquareMatrix<3>> || std::same_as<T, SquareMatrix<2>>) {
      if (!key.diagonal) expectRange(node["items"]["items"], key.range, place);
    } else if constexpr (requires { value.has_value(); }) (*this)(key, value.value_or(typename T::value_type{}));
    else if constexpr (requires { visitKeys(value, *this); }) compare(node, place + ".", value);
  }
  template <class T>
  void compare(const Json& inside, const std::string& at, const T& value) const {
    std::set<std::string> found;
    visitKeys(value, BesideSchema{root, inside, at, found});
    for (const auto& [name, node] : inside["properties"].items())
      EXPECT_TRUE(found.contains(name) || (at.empty() && (name == "description" || name == "look"))) << at << name;
  }
  /// Every kind of force together has the keys of the list's elements.
  void compareForces(const Json& inside, const std::string& at, const Environment& environment) const {
    std::set<std::string> found;
    for (const HandForce& force : environment) visitKeys(force, BesideSchema{root, inside, at, found});
    for (const auto& [name, node] : inside["properties"].items()) EXPECT_TRUE(found.contains(name)) << at << name;
  }
  static void expectRange(const Json& node, const NumberRange& range, const std::string& place) {
    if (node.contains("enum")) return;
    constexpr double kNone = std::numeric_limits<double>::infinity();
    EXPECT_EQ(node.value("exclusiveMinimum", node.value("minimum", -kNone)), range.lo) << place;
    EXPECT_EQ(node.contains("exclusiveMinimum"), !range.loIncluded) << place;
    EXPECT_EQ(node.value("maximum", kNone), range.hi) << place;
    EXPECT_EQ(node["type"] == "integer", range.whole) << place;
  }
};

/// A body, so that every key is there.
Experiment wholeExperiment() {
  Experiment whole;
  whole.object.kind = ObjectKind::Body;
  whole.coupling.emplace();
  whole.task.emplace();
  whole.forceLimit = 8;
  whole.subjectScreen.score = true;
  whole.environment = {{ViscousForce{}}, {ElasticForce{}}, {JointViscousForce{}}, {ChannelForce{}, ForceWhen::Trial}, {PulseForce{}}};
  whole.cursor.emplace();
  return whole;
}

void expectDefaults(const Json& root, const Json& object, const Json& written, const std::string& path) {
  for (const auto& [name, unresolved] : object["properties"].items()) {
    if (!written.contains(name)) continue;
    const Json node = resolved(root, unresolved);
    if (node.contains("default") && path + name != "subject_screen.score") {
      EXPECT_EQ(written[name], node["default"]) << path << name;
    }
    if (node.contains("properties")) expectDefaults(root, node, written[name], path + name + ".");
  }
}

TEST_F(ShippedSchema, HasTheKeysOfTheReaderWithTheirRangesNamesAndDefaults) {
  const Json schema = Json::parse(readTextFile(resourceFolder() + "/schemas/experiment.schema.json"));
  const Experiment whole = wholeExperiment();
  std::set<std::string> keys;
  BesideSchema{schema, schema, "", keys}.compare(schema, "", whole);
  expectDefaults(schema, schema, Json::parse(toJson(whole)), "");
}

}  // namespace
}  // namespace reachlab::experiment
