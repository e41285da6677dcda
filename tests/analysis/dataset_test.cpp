#include "analysis/dataset.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <thread>

#include "analysis/report/write_analysis.h"
#include "analysis/trials/experiment_difference.h"
#include "base/fault.h"
#include "sim/experiment/experiment.h"
#include "sim/record/log/whole_file.h"
#include "test_paths.h"
#include "tests/analysis/recorded.h"
#include "tests/analysis/written_tables.h"
#include "tests/refusal.h"

namespace reachlab::analysis {
namespace {

constexpr const char* kQuiet = "simulated:noise=0";

/// The exported file of a run whose name ends so.
std::string fileOf(const std::string& folder, const std::string& ending) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().string().ends_with(ending)) return entry.path().string();
  return "no such file";
}

std::string textOfNumber(double value) { return nlohmann::ordered_json(value).dump(); }

class Datasets : public RecordedDataset {};

TEST_F(Datasets, OfLogsHasEveryTrialWithItsResult) {
  record({.trials = 4});
  record({.session = "02", .trials = 2, .practice = true});
  record({.experiment = "chain-fast", .device = kQuiet, .subject = "02", .trials = 1});
  const Dataset dataset = opened();
  ASSERT_EQ(dataset.runs.size(), 3u);
  ASSERT_EQ(dataset.input.trials.size(), 7u);
  EXPECT_EQ(dataset.input.conditions.size(), 2u);
  EXPECT_TRUE(dataset.notes.empty());
  std::size_t i = 0;
  for (const char* file :
       {"sub-01_ses-01_task-chainmoderate_run-01", "sub-01_ses-02_task-chainmoderate_run-01", "sub-02_ses-01_task-chainfast_run-01"}) {
    const record::RunLog log = record::RunLog::open(folder_.path() + "/sourcedata/" + file + "_log.reach");
    for (const record::RecordedTrial& trial : log.trials()) {
      EXPECT_EQ(dataset.input.trials[i].result.outcome, trial.result.outcome);
      EXPECT_EQ(dataset.input.trials[i].key.trial, trial.trial);
      EXPECT_NEAR(dataset.input.trials[i].taskEnd - dataset.input.trials[i].taskOnset, trial.result.movementTime, 1.5e-3);
      ++i;
    }
  }
  EXPECT_TRUE(dataset.input.trials[4].practice);
  AnalysisOptions options = fewCriteria();
  options.includePractice = true;
  const Analysis analysis = analyzeTrials(dataset.input, options);  // where the plan gave none, sessions are days
  EXPECT_EQ(analysis.trials[0].key.day, 1);
  for (const AnalyzedTrial& trial : analysis.trials) EXPECT_EQ(trial.key.day, trial.key.session == "02" ? 2 : 1);
}

TEST_F(Datasets, ExperimentsOfOneNameAreToldApartByWhatDiffers) {
  experiment::Experiment e = experiment::readExperiment("dingwell");
  e.name = "mine";
  const auto record = [&](const char* session) {
    const std::string file = folder_.write("mine.json", experiment::toJson(e));
    recordRun(data_, {.experiment = file, .device = kQuiet, .session = session, .trials = 1});
  };
  record("01");
  e.task->duration += 0.25;
  record("02");
  record("03");
  e.object.masses = {2.5};
  record("04");
  const Dataset dataset = openDataset(data_);
  ASSERT_EQ(dataset.input.conditions.size(), 3u);
  EXPECT_EQ(dataset.input.conditions[0].name, "mine");
  const std::string longer = "duration " + textOfNumber(e.task->duration) + " s";
  EXPECT_EQ(dataset.input.conditions[1].name, "mine (" + longer + ")");
  EXPECT_EQ(dataset.input.conditions[2].name, "mine (masses 2.5 kg, " + longer + ")");
  EXPECT_EQ(dataset.input.conditionOf, (std::vector<std::size_t>{0, 1, 1, 2}));
  ASSERT_EQ(dataset.notes.size(), 2u);
  EXPECT_NE(dataset.notes[0].find(longer), std::string::npos) << dataset.notes[0];
}

TEST(Differences, AreOfWhatIsAskedAndNotOfHowItIsWritten) {
  const experiment::Experiment e = experiment::readExperiment("chain-moderate");
  const experiment::Experiment written =
      experiment::parseExperiment(experiment::toJson(e), "chain-moderate", experiment::definitionTextOf(e));
  EXPECT_EQ(differences(e, written), std::vector<std::string>{});
  experiment::Experiment other = e;
  other.coupling.reset();
  other.object.masses.assign(5, 0.5);
  other.task->tolerance.velocity = 0.02;
  EXPECT_EQ(differences(e, other), (std::vector<std::string>{"masses 5 x 0.5 kg", "tolerance velocity 0.02 m/s", "no coupling"}));
}

TEST_F(Datasets, WhoseEventsAreNoTableOfEventsIsRefusedAndNotARunWithoutTrials) {
  removeLogs(folder_.path(), record({.trials = 2}));
  ASSERT_EQ(analyzeTrials(opened().input, fewCriteria()).trials.size(), 2u);
  const std::string events = fileOf(folder_.path(), "_events.tsv");
  for (const std::string& text : {std::string(), std::string(2000, '\xff'), std::string(2000, '\0'), std::string("onset\tduration\n")}) {
    std::ofstream(events, std::ios::binary) << text;
    EXPECT_THROW(analyzeTrials(opened().input, fewCriteria()), FaultError) << text.substr(0, 40);
  }
}

// Each dataset below was read as if nothing had happened: other units, another order, and decimal commas.
TEST_F(Datasets, OfBidsFilesThatAnotherProgramHasChangedIsRefusedWhereItsNumbersWouldBeOthers) {
  removeLogs(folder_.path(), record({.trials = 2}));
  const auto refusalOf = [&](const std::string& ending, const std::regex& text, const std::string& instead) -> std::string {
    const std::string file = fileOf(folder_.path(), ending), before = record::readWholeFile(file);
    const std::string after = std::regex_replace(before, text, instead);
    EXPECT_NE(before, after);
    std::ofstream(file, std::ios::binary) << after;
    const std::string refusal = reachlab::refusalOf<FaultError>([&] { (void)analyzeTrials(opened().input, fewCriteria()); });
    std::ofstream(file, std::ios::binary) << before;
    return refusal;
  };
  EXPECT_EQ(refusalOf("_motion.tsv", std::regex("\n"), "\r\n"), "") << "the ends of lines are no number";
  EXPECT_TRUE(holds(refusalOf("_channels.tsv", std::regex("\tm\t"), "\tmm\t"), "hand_pos_x in m"));
  EXPECT_TRUE(holds(refusalOf("_channels.tsv", std::regex("hand_pos_y"), "hand_pos_z"), "hand_pos_y in m"));
  EXPECT_TRUE(holds(refusalOf("_motion.tsv", std::regex("\\."), ","), "_motion.tsv:1")) << "in its first line";
  EXPECT_TRUE(holds(refusalOf("_motion.tsv", std::regex("\\."), ","), "is not a number"));
  EXPECT_TRUE(holds(refusalOf("_events.tsv", std::regex("\\."), ","), "is not a number"));
  EXPECT_TRUE(holds(refusalOf("_events.tsv", std::regex("failure"), "faliure"), "is 'faliure', which is unknown"));
  EXPECT_TRUE(holds(refusalOf("_events.tsv", std::regex("\trecorded\t"), "\tPractice\t"), "is 'Practice'"));
  EXPECT_TRUE(holds(refusalOf("_events.tsv", std::regex("\n"), "\n9"), "and the recording at")) << "90 s later";
}

TEST_F(Datasets, OfBidsFilesWithARowThatWasNotSeenHasTheTrialWithoutIt) {
  removeLogs(folder_.path(), record({.device = kQuiet, .trials = 1}));
  const std::string motion = fileOf(folder_.path(), "_motion.tsv");
  const auto trialNow = [&] { return analyzeTrials(opened().input, fewCriteria()).trials.at(0); };
  const double before = trialNow().measures.duration;
  const std::string whole = record::readWholeFile(motion);
  const record::ChannelTable table = readBidsRun(motion).configuration.table;
  const auto without = [&](const char* channel, const auto& isRow) {
    const std::regex cell("^((?:[^\t]*\t){" + std::to_string(table.indexOf(channel)) + "})[^\t]*");
    std::istringstream rows(whole);
    std::ofstream out(motion, std::ios::binary);
    int number = 0;
    for (std::string row; std::getline(rows, row); ++number) out << (isRow(number) ? std::regex_replace(row, cell, "$1n/a") : row) << '\n';
  };
  without("hand_pos_x", [](int number) { return number % 40 == 7; });
  EXPECT_NEAR(trialNow().measures.duration, before, 1e-3) << "its neighbours tell where the hand was";
  without("hand_pos_x", [](int number) { return number >= 150 && number < 161; });
  EXPECT_EQ(trialNow().exclusion, "hand not seen for more than 0.1 s");
  without("mass5_vel_x", [](int number) { return number == 150; });
  EXPECT_EQ(trialNow().exclusion, "object not known in all samples");
}

// A session's folder is analysed with the experiments of its dataset, and not with those of their names that are shipped.
TEST_F(Datasets, OfASessionsBidsFilesHasTheExperimentOfItsDataset) {
  removeLogs(folder_.path(), record({.trials = 1}));
  for (const std::string& part : {folder_.path(), folder_.path() + "/sub-01", folder_.path() + "/sub-01/ses-01"})
    EXPECT_TRUE(holds(openDataset(part).notes.at(0), "with the experiments in code/experiments/")) << part;
}

// A dataset and its copy would count twice.
TEST_F(Datasets, OfBidsFilesOfSeveralDatasetsIsRefused) {
  for (const char* part : {"/data", "/second"}) removeLogs(folder_.path() + part, recordRun(folder_.path() + part, {.trials = 1}));
  EXPECT_TRUE(holds(refusalOf([&] { (void)opened(); }), "holds several datasets"));
}

// The sidecar says how often rows come, or else their times do; a single row has none to tell it by.
TEST_F(Datasets, OfBidsFilesThatDoNotSayHowOftenHasTheRateOfItsRows) {
  removeLogs(folder_.path(), record({.trials = 1}));
  const std::string motion = fileOf(folder_.path(), "_motion.tsv"), sidecar = fileOf(folder_.path(), "_motion.json");
  auto about = nlohmann::json::parse(std::ifstream(sidecar));
  about.at("SamplingFrequency") = 0.5;
  std::ofstream(sidecar) << about.dump();
  const Dataset slow = opened();
  EXPECT_EQ(slow.runs.at(0).configuration.samplingHz, 0.5) << "said, however slow";
  EXPECT_NE(slow.notes.at(0).find("code/experiments"), std::string::npos) << "not the shipped experiment: " << slow.notes[0];
  ASSERT_EQ(about.erase("SamplingFrequency"), 1u);
  std::ofstream(sidecar) << about.dump();
  EXPECT_EQ(opened().runs.at(0).configuration.samplingHz, 100);
  std::ifstream rows(motion);
  std::string first, second;
  std::getline(rows, first), std::getline(rows, second);
  rows.close();
  std::ofstream(motion) << first << '\n';
  EXPECT_EQ(opened().runs.at(0).configuration.samplingHz, 100);
}

TEST_F(Datasets, OfSimulatedAndRealHandsSaysThatItMixesThem) {
  record({.trials = 2});
  EXPECT_TRUE(opened().notes.empty());
  record({.device = "replay:" REACHLAB_SOURCE_DIR "/resources/reaches", .subject = "02", .trials = 2});
  const Dataset mixed = opened();
  ASSERT_EQ(mixed.notes.size(), 1u);
  EXPECT_NE(mixed.notes[0].find("(replay, simulated)"), std::string::npos) << mixed.notes[0];
  record({.experiment = "chain-fast", .device = kQuiet, .subject = "02", .trials = 1});
  EXPECT_TRUE(holds(opened().notes.back(), "subject 02: trials of different devices")) << "in whichever conditions";
}

TEST(FileName, OfAConditionHasLettersNumbersAndSingleHyphens) {
  EXPECT_EQ(fileNameOf("slow, light"), "slow-light");
  EXPECT_EQ(fileNameOf("Pace 2 -- (far)"), "Pace-2-far");
  EXPECT_EQ(fileNameOf(" /../x"), "x");
  EXPECT_EQ(fileNameOf("???"), "condition");
}

TEST_F(Datasets, ThatIsNoneIsRefusedInOneSentence) {
  EXPECT_THROW(opened(), FaultError);
  EXPECT_THROW(openDataset(folder_.path() + "/nowhere"), FaultError);
}

TEST_F(Datasets, WithADamagedLogKeepsWhatIsGoodAndSaysSo) {
  const std::string log = record({.trials = 4});
  std::filesystem::resize_file(log, std::filesystem::file_size(log) / 2);
  const Dataset dataset = opened();
  EXPECT_FALSE(dataset.input.trials.empty());
  EXPECT_EQ(dataset.notes.size(), 1u);
  EXPECT_NO_THROW(analyzeTrials(dataset.input, fewCriteria()));
}

class WrittenAnalyses : public RecordedDataset {};

TEST_F(WrittenAnalyses, WritesTheSameBytesEachTimeAndEveryNumberOfAFigure) {
  record({.trials = 5, .seed = 3});
  Dataset dataset = opened();
  const Analysis analysis = analyzeTrials(dataset.input, fewCriteria());
  const ReportHeader header{"dataset", "0.1.0", "reach analyze dataset"};
  const AnalysisFiles first = writeAnalysis(analysis, dataset, header, folder_.path() + "/one");
  const AnalysisFiles second = writeAnalysis(analysis, dataset, header, folder_.path() + "/two");
  for (const auto member : {&AnalysisFiles::tables, &AnalysisFiles::figures}) {
    ASSERT_EQ((first.*member).size(), (second.*member).size());
    for (std::size_t i = 0; i < (first.*member).size(); ++i)
      EXPECT_EQ(record::readWholeFile((first.*member)[i]), record::readWholeFile((second.*member)[i]));
  }
  const std::string report = record::readWholeFile(first.report);
  EXPECT_EQ(report, record::readWholeFile(second.report));

  // Self-contained, ids unique, numbers finite, text escaped.
  EXPECT_EQ(report.find("<script"), std::string::npos);
  EXPECT_EQ(report.find("src=\"http"), std::string::npos);
  EXPECT_EQ(report.find(">nan"), std::string::npos);
  std::set<std::string> ids;
  const std::regex id(" id=\"([^\"]+)\"");
  for (auto it = std::sregex_iterator(report.begin(), report.end(), id); it != std::sregex_iterator(); ++it)
    EXPECT_TRUE(ids.insert((*it)[1]).second) << (*it)[1];

  const std::string profiles = record::readWholeFile(folder_.path() + "/one/profiles.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::count(profiles.begin(), profiles.end(), '\n')), 1 + 101 * analysis.results[0].used);
}

// Programs that write the same results at the same moment: each ends well, and the tables that are left belong together.
TEST_F(WrittenAnalyses, WrittenByThreeAtOnceIsOneOfThem) {
  record({.trials = 2});
  const Dataset dataset = opened();
  std::vector<Analysis> analyses;
  for (const double cutoff : {6.0, 8.0, 10.0}) {
    AnalysisOptions options = fewCriteria();
    options.measure.cutoff = cutoff;
    analyses.push_back(analyzeTrials(dataset.input, options));
  }
  const std::string out = folder_.path() + "/out";
  for (int round = 0; round < 3; ++round) {
    {
      std::vector<std::jthread> programs;
      for (const Analysis& analysis : analyses)
        programs.emplace_back([&] { EXPECT_NO_THROW(writeAnalysis(analysis, dataset, {"d", "0", "c"}, out)); });
    }
    std::vector<std::string> methods;
    for (const double cutoff : {6.0, 8.0, 10.0}) {
      const std::string words = fmt::format("{} Hz in each pass", cutoff);
      if (record::readWholeFile(out + "/report.html").find(words) == std::string::npos) continue;
      EXPECT_NE(record::readWholeFile(out + "/conditions.csv").find(fmt::format(",0.01,{},", cutoff)), std::string::npos) << cutoff;
      methods.push_back(words);
    }
    EXPECT_EQ(methods.size(), 1u);
  }
}

}  // namespace
}  // namespace reachlab::analysis
