// One command compiles one formula once, whoever needs it: protocol, scene, device, prediction, recording, dataset.
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace reachlab::test {
namespace {

const std::string kFormula = "0 | a*cos(phi) | a*sin(phi)/2";

std::string experimentFile(const TemporaryFolder& folder, const std::string& name,
                           const std::string& kind = R"("kind": "point", "masses_kg": [1])") {
  const std::string constraint = R"j({"curve": ["0", "a*cos(phi)", "a*sin(phi)/2"], "shape": {"a": 0.1}})j";
  return folder.write(name + ".json", experimentOn(constraint, reachFrom("0.3", "2.0", "1", "0.02"), kind));
}

/// By `reach` with a counter that the linker has put before the compiler of formulas.
std::vector<std::string> compiledBy(const std::string& arguments) {
  const Ended ended = endOf("REACHLAB_TELL_COMPILATIONS=1 \"" REACHLAB_BINARY_DIR "/tests/reach_counting\" " + arguments);
  EXPECT_EQ(ended.exitCode, 0) << arguments << "\n" << ended.err;
  std::vector<std::string> formulas;
  std::istringstream lines(ended.err);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("compiled ")) formulas.push_back(line.substr(9));
  return formulas;
}

}  // namespace

TEST(Compilations, OfAFormulaAreOneInACommandOfAnyKind) {
  const TemporaryFolder folder;
  const std::string typed = experimentFile(folder, "typed"), data = (folder / "data").string(),
                    chain = experimentFile(folder, "chain", R"("kind": "chain", "masses_kg": [0.5, 0.5], "stiffness_n_per_m": [600])"),
                    heavy = experimentFile(folder, "heavy", R"("kind": "point", "masses_kg": [10])");
  const std::string plan = folder.write("plan.json", R"({ "schema_version": 1, "trials": 2, "blocks": [
    { "experiment": "typed.json", "practice": true }, { "experiment": "typed.json" } ] })");
  const std::string run = " --device simulated --trials 3 --fast --data " + data;
  for (const std::string& arguments :
       {"run " + typed + run + " --seed 1", "run " + typed + run + " --seed 2", "run " + chain + run + "-chain --seed 1",
        "predict " + typed + " --criterion min-hand-jerk", "simulate " + typed + " --hand min-jerk --until 0.1", "validate " + typed,
        "validate " + heavy + " --device virtual:omni", "validate " + plan + " --device virtual:omni",
        "replay " + data + "/sourcedata/sub-01_ses-01_task-typed_run-01_log.reach --check",
        "analyze " + data + " --criterion min-hand-jerk --criterion min-hand-force"})
    EXPECT_EQ(compiledBy(arguments), std::vector<std::string>{kFormula}) << arguments;
  EXPECT_EQ(compiledBy("predict dingwell --criterion min-hand-jerk --sweep duration_s=0.5:2:0.25").size(), 1u);
}

}  // namespace reachlab::test
