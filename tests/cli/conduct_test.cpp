// What conducting a session from the command line leaves on the disk, whoever does it inside.
#include <gtest/gtest.h>

#include <regex>

#include "sim/record/log/run_log.h"
#include "tests/cli/program.h"
#include "tests/record/configuration_keys.h"
#include "tests/session/recorded_runs.h"

namespace reachlab::cli {
namespace {

using test::Ended;
using test::reach;

class Conduct : public InAFolder {
 protected:
  std::vector<record::RunLog> recordedLogs() const { return session::test::logsIn({.data = folder_.path()}); }
};

TEST_F(Conduct, ThePlansBlocksAreRunsOfTheirOwnEachWithItsLabelAndItsRowsInTheDataset) {
  const std::string plan = folder_.write("plan.json", R"({ "schema_version": 1, "trials": 2, "blocks": [
    { "experiment": "chain-slow", "condition": "slow", "practice": true }, { "experiment": "dingwell" },
    { "experiment": "chain-slow", "condition": "slow", "trials": 1 } ] })");
  const Ended ended = reach("run " + plan + " --device simulated:noise=0 --seed 4 --fast --data " + folder_.path());
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_FALSE(holds(ended.err, "seed="));
  const std::vector<record::RunLog> logs = recordedLogs();
  ASSERT_EQ(logs.size(), 3u);
  const char *tasks[] = {"chainslow", "dingwell", "chainslow"}, *conditions[] = {"slow", "dingwell", "slow"};
  const std::string scans = test::contentOf(folder_ / "sub-01/ses-01/sub-01_ses-01_scans.tsv");
  for (int k = 0; k < 3; ++k) {
    const record::RunLog& log = logs[static_cast<std::size_t>(k)];
    record::expectRecorded(log.configuration(),
                           {{"run", k + 1}, {"block", k + 1}, {"task", tasks[k]}, {"condition", conditions[k]}, {"practice", k == 0}});
    EXPECT_EQ(log.trials().size(), k == 2 ? 1u : 2u);
    EXPECT_TRUE(log.healthy());
    EXPECT_TRUE(log.closed());
    const std::string name = std::string("task-") + tasks[k] + "_tracksys-haptic_run-0" + std::to_string(k + 1);
    EXPECT_TRUE(holds(scans, name + "_motion.tsv"));
    EXPECT_TRUE(holds(ended.err, "run " + std::to_string(k + 1) + ": " + conditions[k]));
  }
  EXPECT_TRUE(std::filesystem::exists(folder_ / "dataset_description.json"));
  for (const auto& [device, warned] : {std::pair{"simulated:noise=0", false}, {"simulated", true}, {"simulated:noise=1", true}}) {
    const Ended again = reach("run " + plan + " --device " + device + " --fast --resume --data " + folder_.path());
    EXPECT_TRUE(says(again, 0, "nothing is left to do"));
    EXPECT_EQ(bool(holds(again.err, "recorded with the device simulated:noise=0, and is resumed with")), warned) << again.err;
  }
  EXPECT_EQ(recordedLogs().size(), 3u);
}

TEST_F(Conduct, TheRecordSaysWithWhatAndWhenItWasMade) {
  test::printed("run chain-moderate --device simulated:noise=0 --trials 1 --seed 2 --fast --data " + folder_.path());
  const std::vector<record::RunLog> logs = recordedLogs();
  ASSERT_EQ(logs.size(), 1u);
  const record::RunConfiguration& c = logs[0].configuration();
  record::expectRecorded(c, {{"device", "simulated:noise=0"}, {"virtual_hand", true}, {"method", "exact"}, {"clock", "virtual"}});
  EXPECT_NE(c.firstHand.name, "");
  EXPECT_NE(c.firstHand.version, "");
  EXPECT_GT(c.firstHand.maxForce, 0);
  EXPECT_NE(c.methodReason, "");
  EXPECT_TRUE(c.softwareVersion.starts_with("reachlab ")) << c.softwareVersion;
  EXPECT_NE(c.buildDescription, "");
  EXPECT_TRUE(c.computer.starts_with("Linux ")) << c.computer;
  EXPECT_TRUE(std::regex_match(c.startedUtc, std::regex(R"(20\d\d-\d\d-\d\dT\d\d:\d\d:\d\d\.\d\d\dZ)"))) << c.startedUtc;
  EXPECT_EQ(c.table.massCount, 5);
  EXPECT_EQ(c.table.parameterCount, 1);
  for (const record::RecordedEvent& event : logs[0].events()) EXPECT_FALSE(holds(event.text, "ticks/s")) << "virtual time has no timing";
}

}  // namespace
}  // namespace reachlab::cli
