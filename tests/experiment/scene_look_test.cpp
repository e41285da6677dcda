#include "sim/experiment/scene_look.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "base/fault.h"
#include "sim/experiment/experiment.h"
#include "tests/refusal.h"

namespace reachlab::experiment {
namespace {

// A point on a line whose file has this look.
std::string fileWith(const std::string& look) {
  return R"({ "schema_version": 1, "constraint": { "name": "line" }, "object": { "kind": "point", "masses_kg": [1] },
  "coupling": { "stiffness_n_per_m": 600 }, "look": )" +
         look + "}";
}

std::string toldOf(const std::string& look) {
  const std::string text = refusalOf<FaultError>([&] { parseExperiment(fileWith(look), "x.json"); });
  return text.empty() ? "none" : text.substr(text.find("look"));
}

std::string withCamera(const std::string& camera) { return "{ \"cameras\": [" + camera + "] }"; }

TEST(SceneLook, IsTheDefaultWhereTheFileSaysNothing) {
  const SceneLook look = lookOf(parseExperiment(fileWith("{}"), "x.json"));
  EXPECT_EQ(look, SceneLook{});
  EXPECT_EQ(lookOf(Experiment{}), SceneLook{}) << "of no text";
  Experiment odd;
  odd.text = "no file, but \"look\"";
  EXPECT_EQ(lookOf(odd), SceneLook{});
  odd.text = R"({ "look": { "surface_opacity": 7 } })";
  EXPECT_EQ(lookOf(odd), SceneLook{}) << "nothing of one that is at fault";
}

TEST(SceneLook, OfAFileIsReadAndGoesIntoAnotherUnchanged) {
  const SceneLook look = lookOf(parseExperiment(
      fileWith(R"({ "surface_opacity": 0.25, "depth_cue": "grid", "trace": true, "force_arrow": true, "scene_file": "lab.wrl",
      "colours": { "hand": "#0aF9e1", "rail": "#000000" },
      "cameras": [ { "name": "near", "position_m": [1, 2, 3], "focus_m": [4, 5, 6], "up": [0, 0.5, 1], "angle_deg": 45, "parallel": true },
                   { "name": "far", "position_m": [0, 0, 9], "focus_m": [0, 0, 0] } ] })"),
      "x.json"));
  EXPECT_EQ(look.surfaceOpacity, 0.25);
  EXPECT_EQ(look.depthCue, "grid");
  EXPECT_TRUE(look.trace);
  EXPECT_TRUE(look.forceArrow);
  EXPECT_EQ(look.sceneFile, "lab.wrl");
  EXPECT_EQ(look.colours, (std::map<std::string, std::string>{{"hand", "#0aF9e1"}, {"rail", "#000000"}}));
  ASSERT_EQ(look.cameras.size(), 2u);
  EXPECT_EQ(look.cameras[0], (NamedCamera{{{1, 2, 3}, {4, 5, 6}, {0, 0.5, 1}, 45, true}, "near"}));
  EXPECT_EQ(look.cameras[1], (NamedCamera{{{0, 0, 9}, {0, 0, 0}, {0, 1, 0}, 30, false}, "far"}));
  const Experiment plain = parseExperiment(fileWith("{}"), "x.json");
  const Experiment dressed = withLook(plain, look);
  EXPECT_EQ(lookOf(dressed), look);
  EXPECT_EQ(toJson(parseExperiment(dressed.text, "x.json")).find("0aF9e1") != std::string::npos, true) << "what is saved has it";
  EXPECT_FALSE(holds(withLook(dressed, {}).text, "look")) << "the default is not written";
  Experiment untold = plain;
  untold.text.clear();
  EXPECT_EQ(lookOf(withLook(untold, look)), look) << "of an experiment that was never a file";
}

TEST(SceneLook, HasItsBounds) {
  for (const char* good : {"{ \"surface_opacity\": 0 }", "{ \"surface_opacity\": 1 }", "{ \"depth_cue\": \"shadow\" }"})
    EXPECT_EQ(toldOf(good), "none") << good;
  for (const char* bad : {"-0.01", "1.01"})
    EXPECT_EQ(toldOf("{ \"surface_opacity\": " + std::string(bad) + " }"),
              "look.surface_opacity: is " + std::string(bad) + "; allowed: 0 to 1");
  EXPECT_EQ(toldOf("{ \"depth_cue\": \"fog\" }"), "look.depth_cue: is \"fog\"; allowed: none, grid or shadow");
  EXPECT_EQ(toldOf("{ \"cameras\": {} }").substr(0, 26), "look.cameras: is no list; ");
}

TEST(SceneLook, AColourIsSixHexadecimalDigitsOfAPartThatIsThere) {
  const auto colour = [](const std::string& value) { return toldOf("{ \"colours\": { \"hand\": \"" + value + "\" } }"); };
  for (const char* good : {"#09afAF", "#ffffff"}) EXPECT_EQ(colour(good), "none");
  for (const char* bad : {"#fffff", "#fffffff", "0ffffff", "#fffffg", "#ffff f", "red", ""})
    EXPECT_EQ(colour(bad),
              "look.colours.hand: is \"" + std::string(bad) + "\"; allowed: \"#rrggbb\": two hexadecimal digits each of red, green, blue");
  EXPECT_NE(toldOf("{ \"colours\": { \"foot\": \"#ffffff\" } }"), "none");
  for (const std::string& part : colouredParts()) EXPECT_EQ(toldOf("{ \"colours\": { \"" + part + "\": \"#123456\" } }"), "none") << part;
}

TEST(SceneLook, ACameraLooksFromOnePlaceToAnother) {
  const std::string places = R"("position_m": [0, 0, 1], "focus_m": [0, 0, 0])";
  const auto with = [&](const std::string& more) { return toldOf(withCamera("{ \"name\": \"a\", " + places + more + " }")); };
  for (const char* good : {"", ", \"angle_deg\": 1", ", \"angle_deg\": 120", ", \"up\": [0, 0, 1]"}) EXPECT_EQ(with(good), "none") << good;
  for (const char* bad : {"0.9", "120.5"})
    EXPECT_EQ(with(", \"angle_deg\": " + std::string(bad)),
              "look.cameras[0].angle_deg: is " + std::string(bad) + "; allowed: 1 to 120 degrees");
  EXPECT_EQ(with(", \"up\": [0, 0, 0]"), "look.cameras[0].up: has no direction; allowed: [0, 1, 0], say");
  EXPECT_EQ(toldOf(withCamera("{ \"name\": \"\", " + places + " }")), "look.cameras[0].name: is empty; allowed: a name");
  EXPECT_EQ(toldOf(withCamera(R"({ "name": "a", "position_m": [1, 2, 3], "focus_m": [1, 2, 3] })")),
            "look.cameras[0].focus_m: is where the eye is; allowed: another place than position_m");
  EXPECT_EQ(toldOf(withCamera(R"({ "name": "a", "focus_m": [1, 2, 3] })")).substr(0, 40), "look.cameras[0].position_m: is missing; ");
}

}  // namespace
}  // namespace reachlab::experiment
