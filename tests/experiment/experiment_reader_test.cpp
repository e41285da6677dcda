#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "sim/experiment/checked_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"
#include "tests/refusal.h"

using namespace reachlab;
using namespace reachlab::experiment;

namespace {

const std::string kGood = R"({
  "schema_version": 1,
  "constraint": { "name": "line", "shape": { "length_m": 0.2 } },
  // a comment
  "object": { "kind": "chain", "masses_kg": [0.6, 0.6], "stiffness_n_per_m": [600] },
  "coupling": { "stiffness_n_per_m": 600, "damping_n_s_per_m": 0 },
  "task": { "start": [0], "target": [6.283185307179586], "duration_s": 1.35,
            "tolerance": { "position_m": 0.012, "velocity_m_per_s": 0.012, "time_s": 0.5 } }
}
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string faultOf(const std::string& text) {
  return reachlab::refusalOf([&] { parseExperiment(text, "x.json"); });
}

}  // namespace

TEST(ExperimentReader, ATasksPlaceMayBeAConstant) {
  const Experiment read =
      parseExperiment(replaced(replaced(kGood, "6.283185307179586", "\"2*pi\""), "\"start\": [0]", "\"start\": [\"-pi/4\"]"), "x.json");
  EXPECT_EQ(read.task->target, std::vector<double>{2 * std::numbers::pi});
  EXPECT_EQ(read.task->start, std::vector<double>{-std::numbers::pi / 4});
  EXPECT_EQ(read.object.damping, std::vector<double>{0});
  EXPECT_EQ(faultOf(toJson(read)), "") << "written back as numbers";
  EXPECT_TRUE(holds(faultOf(replaced(kGood, "6.283185307179586", "\"2*phi\"")), "x.json:7:38: task.target[0]: unknown name 'phi'"));
  EXPECT_TRUE(holds(faultOf(replaced(kGood, "6.283185307179586", "\"1/0\"")), "task.target[0]: "));
}

TEST(ExperimentReader, EveryShippedExperimentReadsAndWritesBackEqual) {
  for (const std::string& name : shippedExperiments()) {
    const Experiment e = readExperiment(name);
    EXPECT_EQ(e.name, name);
    const Experiment again = parseExperiment(toJson(e), name);
    EXPECT_EQ(toJson(again), toJson(e)) << name;
    EXPECT_TRUE(check(e).faults.empty()) << name;
    EXPECT_GT(e.task->duration - e.task->tolerance.time, 0.1) << name << ": the lamp would be green from the onset";
  }
}

struct WrongText {
  const char *from, *to, *message;
};
class ExperimentReaderFaults : public testing::TestWithParam<WrongText> {};

TEST_P(ExperimentReaderFaults, AreNamedWithPlaceKeyAndWhatIsAllowed) {
  const WrongText& fault = GetParam();
  const std::string message = faultOf(replaced(kGood, fault.from, fault.to));
  EXPECT_TRUE(holds(message, fault.message));
}

INSTANTIATE_TEST_SUITE_P(
    Each, ExperimentReaderFaults,
    testing::Values(WrongText{"\"duration_s\"", "\"duration\"", "x.json:7:58: task.duration: is not known here; did you mean duration_s?"},
                    WrongText{"\"duration_s\": 1.35", "\"duration_s\": \"long\"",
                              "x.json:7:72: task.duration_s: is a string; allowed: 0.001 to 3600 s"},
                    WrongText{"\"stiffness_n_per_m\": [600]", "\"viscosity_n_s_per_m\": 0", "object.stiffness_n_per_m: is missing"},
                    WrongText{"1.35", "1e999", "x.json:7:72: this number is beyond the range of a double"},
                    WrongText{"1.35", "NaN", "x.json:7:"}, WrongText{"\"schema_version\": 1,", "", "schema_version: is missing"},
                    WrongText{"\"chain\"", "\"chian\"", "object.kind: is \"chian\"; allowed: point, chain, parallel, body or none"},
                    WrongText{"\"chain\", \"masses_kg\": [0.6, 0.6], \"stiffness_n_per_m\": [600]",
                              "\"parallel\", \"masses_kg\": [0.6, 0.6], \"stiffness_n_per_m\": [600, 60]",
                              "coupling: stands beside a parallel object"}));

// The first element says what is meant; the faults of the others are told as of that.
TEST(ExperimentReader, TakesAnInertiaForAMatrixWhereItsFirstElementIsARow) {
  const auto told = [](const std::string& inertia) {
    return faultOf(
        R"({"schema_version": 1, "constraint": {"name": "free"}, "object": {"kind": "body", "masses_kg": [1], "inertia_kg_m2": )" +
        inertia + R"(}, "coupling": {"stiffness_n_per_m": 600}})");
  };
  EXPECT_EQ(told("[0.1, 0.1, 0.1]"), "");
  EXPECT_EQ(told("[[0.1, 0, 0], [0, 0.1, 0], [0, 0, 0.1]]"), "");
  EXPECT_TRUE(holds(told("[[0.1, 0, 0], 0.1, 0.1]"), "inertia_kg_m2[1]: is a number; allowed: an array of 3 numbers"));
  EXPECT_TRUE(holds(told("[0.1, [0, 0.1, 0], 0.1]"), "inertia_kg_m2[1]: is an array"));
  EXPECT_TRUE(holds(told("[[0.1, 0, 0]]"), "inertia_kg_m2: has 1 rows; allowed: 3 rows"));
  EXPECT_TRUE(holds(told("[]"), "inertia_kg_m2: has 0 elements"));
}
