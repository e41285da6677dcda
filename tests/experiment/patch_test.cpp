#include "sim/experiment/patch.h"

#include <gtest/gtest.h>

#include "base/fault.h"
#include "sim/experiment/experiment.h"

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

TEST(Patch, RefusesWhatIsNotThere) {
  for (const char* path :
       {"object.masses_kg[5]", "object.masses_kg.first", "name[0]", "object.masses_kg[x]", "object.masses_kg[0", "", "a..b", "task."}) {
    try {
      patched({{path, "1"}});
      ADD_FAILURE() << path;
    } catch (const FaultError& fault) {
      EXPECT_EQ(fault.faults.at(0).key, path);
    }
  }
  EXPECT_THROW(patched({{"task.duraton_s", "1"}}), FaultError) << "an unknown key is the reader's to refuse";
}

}  // namespace
}  // namespace reachlab::experiment
