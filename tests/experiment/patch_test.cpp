#include "sim/experiment/patch.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/fault.h"
#include "base/json/json_reader.h"
#include "sim/experiment/experiment.h"
#include "tests/refusal.h"

namespace reachlab::experiment {
namespace {

Experiment patched(const std::vector<Patch>& patches) {
  const Experiment chain = readExperiment("chain-moderate");
  return parseExperiment(patchedText(chain.text, "chain", patches), "chain-moderate.json");
}

TEST(Patch, ChangesWhatItsPathNames) {
  const Experiment e = patched({{"coupling.stiffness_n_per_m", "250.5"},
                                {"object.masses_kg[2]", "0.7"},
                                {"object.stiffness_n_per_m[*]", "500"},
                                {"task.onset_m", "0.002"},
                                {"name", "\"softer\""}});
  EXPECT_EQ(e.coupling->stiffness, 250.5);
  EXPECT_EQ(e.object.masses, (std::vector<double>{0.6, 0.6, 0.7, 0.6, 0.6}));
  EXPECT_EQ(e.object.stiffness, (std::vector<double>{500, 500, 500, 500}));
  EXPECT_EQ(e.task->onset, 0.002) << "a key that was not there is made";
  EXPECT_EQ(e.name, "softer");
}

TEST(Patch, LeavesEverythingElseAsItWas) {
  Experiment same = patched({{"task.duration_s", "1.35"}}), before = readExperiment("chain-moderate");
  same.text = before.text;
  EXPECT_EQ(toJson(same), toJson(before));
}

TEST(Patch, TellsWhyAPathLeadsNowhere) {
  const auto told = [](const std::string& path) {
    const std::vector<Fault> faults = faultsToldBy([&] { patched({{path, "1"}}); });
    if (faults.empty()) return std::string("changed");
    EXPECT_EQ(faults[0].key, path);
    return faults[0].what;
  };
  EXPECT_EQ(told("object.masses_kg[5]"), "is beyond the 5 elements that are there");
  EXPECT_TRUE(holds(refusalOf([] {
                      patched({{"environment", "[]"}, {"environment[*].when", "1"}});
                    }),
                    "changes nothing: the list is empty"));
  EXPECT_EQ(told("object.masses_kg[4]"), "changed") << "the last";
  EXPECT_EQ(told("object.masses_kg[0"), "has a [ without ]");
  for (const char* inside : {"x", "1x", "-1", ""})
    EXPECT_EQ(told("object.masses_kg[" + std::string(inside) + "]"), "has no number in [" + std::string(inside) + "]");
  for (const char* path : {"", ".", "a..b", "task.", ".task"}) EXPECT_EQ(told(path), "has an empty key") << path;
  EXPECT_EQ(told("task.duration_s.of"), "looks for of in what is no object");
  EXPECT_EQ(told("object.masses_kg.first"), "looks for first in what is no object");
  for (const char* path : {"task[0]", "name[0]"}) EXPECT_EQ(told(path), "looks for an element of what is no array");
  EXPECT_THROW(patched({{"task.duraton_s", "1"}}), FaultError) << "an unknown key is the reader's to refuse";
}

TEST(Patch, GoesThroughArraysInObjectsInArrays) {
  const auto changed = [](const std::string& path) {
    const std::string text = patchedText(R"({"a": [{"b": [1, 2]}, {"b": [3, 4]}], "c": null})", "x", std::vector<Patch>{{path, "9"}});
    std::string compact;
    for (const char c : text)
      if (c != ' ' && c != '\n') compact += c;
    return compact;
  };
  EXPECT_EQ(changed("a[1].b[0]"), R"({"a":[{"b":[1,2]},{"b":[9,4]}],"c":null})");
  EXPECT_EQ(changed("a[*].b[1]"), R"({"a":[{"b":[1,9]},{"b":[3,9]}],"c":null})");
  EXPECT_EQ(changed("a[0]b[0]"), R"({"a":[{"b":[9,2]},{"b":[3,4]}],"c":null})") << "the point may be left out";
  EXPECT_EQ(changed("a[0]"), R"({"a":[9,{"b":[3,4]}],"c":null})");
  EXPECT_EQ(changed("c.d.e"), R"({"a":[{"b":[1,2]},{"b":[3,4]}],"c":{"d":{"e":9}}})") << "what was not there is made";
}

TEST(Patch, AValueIsWrittenAsItWasRead) {
  for (const std::string text : {"null", "true", "false", "1.5", "-3", R"("a")", R"("a\"b\\c")", R"("a\nb\tc")", R"({"a\n\"":"ü"})", "[]",
                                 "[1]", "[1,[2,\"x\"],{}]", "{}", R"({"a":1})", R"({"a":1,"b":{"c":[null,true]}})"})
    EXPECT_EQ(valueText(parseJson(text, "x")), text);
}

TEST(Patch, OfAFileAreKeysWithTheirValues) {
  FaultList faults("x");
  const std::vector<Patch> patches = readPatches(parseJson(R"({"a.b": 1, "c[0]": [2, 3]})", "x"), "change", faults);
  ASSERT_EQ(patches.size(), 2u);
  EXPECT_EQ(patches[0].path + "=" + patches[0].value, "a.b=1");
  EXPECT_EQ(patches[1].path + "=" + patches[1].value, "c[0]=[2,3]");
  EXPECT_TRUE(faults.empty());
  EXPECT_TRUE(readPatches(parseJson("[1]", "x"), "change", faults).empty());
  EXPECT_FALSE(faults.empty());
}

}  // namespace
}  // namespace reachlab::experiment
