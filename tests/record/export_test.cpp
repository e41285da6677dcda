#include <gtest/gtest.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "base/table_text.h"
#include "sim/experiment/describe.h"
#include "sim/experiment/experiment.h"
#include "sim/record/export/bids.h"
#include "sim/record/export/column_dictionary.h"
#include "sim/record/export/hdf5_file.h"
#include "sim/record/export/matlab_file.h"
#include "sim/record/export/tidy_csv.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/whole_file.h"
#include "tests/record/made_run.h"

namespace reachlab::record {
namespace {

using nlohmann::json;

std::vector<std::vector<std::string>> cellsOf(const std::string& text, char separator) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, separator);) rows.back().push_back(cell);
  }
  return rows;
}

const auto firstHandMotion = [](const RunLog& log, const TakePiece& take) { motionTsv(log, take); };

class Exported : public testing::Test {
 protected:
  void SetUp() override {
    configuration_ = madeConfiguration();
    configuration_.participant = {31, "F", "L"};
    configuration_.practice = true;
    path_ = folder_ / "sourcedata/sub-01_ses-01_task-made_run-01_log.reach";
    writeMadeRun(path_, 3, configuration_);
  }
  TemporaryFolder folder_;
  RunConfiguration configuration_;
  std::string path_;
};

TEST_F(Exported, MotionCellsReadBackAsTheRecordedNumbers) {
  const RunLog log = RunLog::open(path_);
  const auto rows = cellsOf(textOf(firstHandMotion, log), '\t');
  const std::size_t x = configuration_.table.indexOf("hand_pos_x");
  for (std::size_t row = 0; row < rows.size(); ++row) {
    double value = 0;
    std::from_chars(rows[row][x].data(), rows[row][x].data() + rows[row][x].size(), value);
    EXPECT_EQ(value, MadeRun::valueAt(10 * row));
  }
}

TEST_F(Exported, ChannelsAreUniqueAndTheirTypesUnitsAndCountsAgree) {
  const auto rows = cellsOf(channelsTsv(configuration_), '\t');
  const json motion = json::parse(motionJson(RunLog::open(path_)));
  const std::map<std::string, std::set<std::string>> allowed{
      {"LATENCY", {"s"}}, {"POS", {"m"}}, {"VEL", {"m/s"}}, {"ACCEL", {"m/s^2"}}, {"MISC", {"s", "N", "J", "n/a", "1/s"}}};
  std::set<std::string> names, points;
  std::map<std::string, int> counts;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), rows[0].size());
    EXPECT_TRUE(names.insert(rows[i][0]).second) << rows[i][0];
    ++counts[rows[i][2]];
    ASSERT_TRUE(allowed.contains(rows[i][2])) << rows[i][2];
    EXPECT_TRUE(allowed.at(rows[i][2]).contains(rows[i][4])) << rows[i][0] << " in " << rows[i][4];
    if (rows[i][3] != "n/a") points.insert(rows[i][3]);
  }
  EXPECT_EQ(motion.at("MotionChannelCount"), rows.size() - 1);
  for (const auto& [key, value] : motion.items())
    if (key.ends_with("ChannelCount") && key != "MotionChannelCount") {
      EXPECT_EQ(value, counts[key.substr(0, key.size() - std::string("ChannelCount").size())]) << key;
    }
  EXPECT_EQ(counts["LATENCY"], 1);
  EXPECT_EQ(motion.at("TrackedPointsCount"), points.size());
  EXPECT_EQ(motion.at("TaskName"), "made") << "the same as task- in the file's name";
  EXPECT_EQ(motion.at("SamplingFrequencyEffective"), 100);
}

TEST_F(Exported, SamplesCsvHasUniqueColumnsThatCarryTheirUnits) {
  const auto rows = cellsOf(textOf(samplesCsv, RunLog::open(path_)), ',');
  std::set<std::string> columns(rows[0].begin(), rows[0].end());
  EXPECT_EQ(columns.size(), rows[0].size());
  for (const char* column :
       {"time_s", "hand_x_m", "hand_vx_m_per_s", "mass1_x_m", "mass2_ay_m_per_s2", "mass1_q1", "coupling_x_n", "device_force_z_n"})
    EXPECT_TRUE(columns.contains(column)) << column;
}

TEST_F(Exported, EveryColumnIsExplainedBesideItsTable) {
  std::vector<RunLog> runs;
  runs.push_back(RunLog::open(path_));
  const std::string out = folder_ / "csv";
  writeTidyCsv(runs, out);
  std::map<std::string, std::string> phases;
  for (const std::string name : {"trials", "sub-01_ses-01_task-made_run-01_samples"}) {
    const std::string header = readWholeFile(out + "/" + name + ".csv");
    const json dictionary = json::parse(readWholeFile(out + "/" + name + ".json"));
    const auto columns = cellsOf(header.substr(0, header.find('\n')), ',')[0];
    EXPECT_EQ(dictionary.size(), columns.size());
    for (const std::string& column : columns) EXPECT_NE(dictionary.at(column).at("Description"), "") << column;
    phases[name] = dictionary.at("phase").at("Description");
  }
  EXPECT_NE(phases["trials"], phases["sub-01_ses-01_task-made_run-01_samples"]) << "one name, two meanings: both are told";
  const json trials = json::parse(readWholeFile(out + "/trials.json"));
  EXPECT_EQ(trials.at("peak_hand_speed_m_per_s").at("Units"), "m/s");
  EXPECT_FALSE(trials.at("outcome").contains("Units"));
  EXPECT_EQ(trials.at("subject").at("Format"), "string");
}

TEST_F(Exported, ColumnNamesAndChannelsAgreeOnTheUnit) {
  for (const Channel& channel : configuration_.table.channels)
    EXPECT_EQ(unitOfColumn(channel.column), channel.units == "n/a" ? "" : channel.units) << channel.column;
}

TEST_F(Exported, WritingTheDatasetAgainKeepsWhatAPersonHasAddedToIt) {
  std::vector<RunLog> runs;
  runs.push_back(RunLog::open(path_));
  const std::string out = folder_ / "dataset";
  writeBids(runs, out);
  EXPECT_EQ(readWholeFile(out + "/participants.tsv"), "participant_id\tage\tsex\thandedness\nsub-01\t31\tF\tL\n");
  writeFileAtomically(out + "/participants.tsv", "participant_id\tage\tgroup\nsub-00\t20\tcontrol\nsub-01\tn/a\tpatient\n");
  writeFileAtomically(out + "/README.md", "mine\n");
  writeBids(runs, out);
  EXPECT_EQ(readWholeFile(out + "/participants.tsv"),
            "participant_id\tage\tgroup\tsex\thandedness\nsub-00\t20\tcontrol\tn/a\tn/a\nsub-01\t31\tpatient\tF\tL\n");
  EXPECT_EQ(readWholeFile(out + "/README.md"), "mine\n");
}

TEST(ExportedExperiment, SaysWhatWasMovedAndAsked) {
  const TemporaryFolder folder;
  RunConfiguration c = madeConfiguration();
  const experiment::Experiment recorded = experiment::readExperiment("chain-on-ellipse");
  c.experimentName = recorded.name;
  c.experimentText = recorded.text;
  c.definitionText = experiment::definitionTextOf(recorded);
  c.timing = recorded.timing;
  const std::string log = folder / "sourcedata/sub-01_ses-01_task-made_run-01_log.reach";
  writeMadeRun(log, 2, c);
  const RunLog run = RunLog::open(log);
  writeBidsRun(run, folder / ".");
  const std::string file = folder / experimentPath(c);
  const experiment::Experiment back = experimentFromJson(readWholeFile(file), file).experiment();
  EXPECT_EQ(experiment::toJson(back), experiment::toJson(recorded));
  EXPECT_FALSE(back.constraint.definition.empty()) << "the formula as it was then";
  const json j = json::parse(readWholeFile(file));
  EXPECT_EQ(j.at("run").at("device"), c.device);
  EXPECT_EQ(j.at("run").at("seed"), c.seed);
  const std::string words = json::parse(motionJson(run)).at("TaskDescription");
  EXPECT_EQ(experimentNameIn(words), c.experimentName);
  EXPECT_NE(words.find(experiment::describe(recorded)), std::string::npos) << words;
}

TEST_F(Exported, ARunOfNoTrialHasTablesWithoutRows) {
  const std::string empty = folder_ / "sourcedata/sub-02_ses-01_task-made_run-01_log.reach";
  writeMadeRun(empty, 0, configuration_);
  std::vector<RunLog> runs;
  runs.push_back(RunLog::open(empty));
  for (const auto& write : {writeHdf5, writeMatlab}) EXPECT_EQ(write(runs, folder_ / "").size(), 1u);
}

}  // namespace
}  // namespace reachlab::record
