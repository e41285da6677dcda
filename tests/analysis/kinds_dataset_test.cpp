#include <filesystem>

#include "analysis/dataset.h"
#include "sim/experiment/experiment.h"
#include "tests/session/kinds_block.h"

// Kinds of trials are conditions of the analysis.
namespace reachlab::analysis {
namespace {

using session::test::Kinds;

TEST_F(Kinds, TheAnalysisTakesEachTrialInItsConditionFromLogsAndFromBidsFilesAlone) {
  std::vector<std::string> kinds;
  for (const char* subject : {"01", "02"}) {
    request_.place.subject = subject;
    ASSERT_TRUE(record());
    const std::vector<std::string> own = kindsOf(logs().at(0));
    kinds.insert(kinds.end(), own.begin(), own.end());
  }
  const auto read = [&] {
    std::vector<std::string> conditions;
    const DatasetIndex index =
        readDataset(request_.place.data, {[&](TrialData&& trial, std::size_t) { conditions.push_back(trial.key.condition); }});
    EXPECT_EQ(index.conditions.size(), 3u);
    for (const Condition& condition : index.conditions)
      EXPECT_EQ(condition.experiment().object.viscosity, condition.name == "thick" ? 8 : 0) << condition.name;
    return conditions;
  };
  EXPECT_EQ(read(), kinds);
  std::filesystem::remove_all(request_.place.data + "/sourcedata");
  EXPECT_EQ(read(), kinds);
}

}  // namespace
}  // namespace reachlab::analysis
