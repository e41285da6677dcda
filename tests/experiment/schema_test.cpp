#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "base/fault.h"
#include "base/json/json_reader.h"
#include "base/text_file.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/scene_look.h"

using namespace reachlab;
using namespace reachlab::experiment;
using Json = nlohmann::json;

namespace {

class ShippedSchema : public testing::Test {
 protected:
  void SetUp() override {
    const Json text = Json::parse(readTextFile(resourceFolder() + "/schemas/experiment.schema.json"));
    valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(valijson::adapters::NlohmannJsonAdapter(text), schema_);
  }
  bool schemaAccepts(const Json& json) {
    return valijson::Validator().validate(schema_, valijson::adapters::NlohmannJsonAdapter(json), nullptr);
  }
  static bool readerAccepts(const Json& json) {
    try {
      parseExperiment(json.dump(), "x.json");
      return true;
    } catch (const FaultError&) {
      return false;
    }
  }

 private:
  valijson::Schema schema_;
};

}  // namespace

TEST_F(ShippedSchema, AcceptsWhatTheReaderAccepts) {
  for (const std::string& name : shippedExperiments()) {
    EXPECT_TRUE(schemaAccepts(Json::parse(readExperiment(name).text, nullptr, true, true))) << name;
    EXPECT_TRUE(schemaAccepts(Json::parse(toJson(readExperiment(name))))) << name;
  }
}

TEST_F(ShippedSchema, AcceptsALookThatTheReaderTakesAndTheWriterKeeps) {
  SceneLook look;
  look.surfaceOpacity = 0.8;
  look.depthCue = "shadow";
  look.sceneFile = "table.wrl";
  look.colours["last"] = "#f58521";
  look.cameras.push_back({"above", {0, 0.5, 0.1}, {0.1, 0, 0}, {0, 0, -1}, 20, true});
  const Experiment seen = withLook(readExperiment("chain-moderate"), look);
  EXPECT_EQ(lookOf(seen), look);
  const Experiment read = parseExperiment(toJson(seen), "x.json");
  EXPECT_EQ(lookOf(read), look);
  EXPECT_TRUE(schemaAccepts(Json::parse(toJson(seen))));
  EXPECT_EQ(lookOf(withLook(read, {})), SceneLook{});
  EXPECT_EQ(lookOf(readExperiment("chain-moderate")), SceneLook{});
}

TEST_F(ShippedSchema, RefusesWhatTheReaderRefuses) {
  const Json good = Json::parse(toJson(readExperiment("chain-moderate")));
  ASSERT_TRUE(schemaAccepts(good) && readerAccepts(good));
  const std::vector<std::function<void(Json&)>> faults = {
      [](Json& j) { j["unknown"] = 1; },
      [](Json& j) { j["schema_version"] = 2; },
      [](Json& j) { j["task"]["rest_s"] = -0.1; },
      [](Json& j) { j["task"]["rest_s"] = 61; },
      [](Json& j) { j["task"]["rest_speed_m_per_s"] = 0; },
      [](Json& j) { j.erase("object"); },
      [](Json& j) { j["object"]["masses_kg"][0] = 0; },
      [](Json& j) { j["object"]["kind"] = "string"; },
      [](Json& j) { j["object"]["stiffness_n_per_m"][0] = -1; },
      [](Json& j) { j["coupling"]["stiffness_n_per_m"] = "600"; },
      [](Json& j) { j["task"]["tolerance"].erase("time_s"); },
      [](Json& j) { j["task"]["duration_s"] = 0; },
      [](Json& j) { j["task"]["start"] = Json::array(); },
      [](Json& j) { j["method"] = "euler"; },
      [](Json& j) { j["force_limit_n"] = 0; },
      [](Json& j) { j["timing"]["max_missed_ticks"] = -1; },
      [](Json& j) { j["timing"]["max_missed_ticks"] = 2.5; },
      [](Json& j) { j["timing"]["max_missed_ticks"] = 10'000'001; },
      [](Json& j) { j["timing"]["max_gap_s"] = 0; },
      [](Json& j) { j["timing"]["max_gap_s"] = 7201; },
      [](Json& j) { j["timing"]["max_gap"] = 0.02; },
      [](Json& j) { j["velocity_estimator"] = "guess"; },
      [](Json& j) { j["arm"]["link_length_m"] = {1}; },
      [](Json& j) { j["look"]["surface_opacity"] = 1.1; },
      [](Json& j) { j["look"]["depth_cue"] = "fog"; },
      [](Json& j) { j["look"]["colours"]["mass7"] = "#ffffff"; },
      [](Json& j) { j["look"]["colours"]["last"] = "orange"; },
      [](Json& j) {
        j["look"]["cameras"] = {{{"name", "above"}}};
      },
      [](Json& j) {
        j["constraint"]["curve"] = {"0", "0", "phi"};
      },
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    Json bad = good;
    faults[i](bad);
    EXPECT_FALSE(schemaAccepts(bad)) << "fault " << i;
    EXPECT_FALSE(readerAccepts(bad)) << "fault " << i;
  }
}
