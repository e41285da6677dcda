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
#include "tests/analysis/whole_dataset.h"
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

TEST(Dataset, OfLogsHasEveryTrialWithItsResult) {
  const TemporaryFolder folder;
  recordRun(folder.path(), {.experiment = "chain-moderate", .trials = 4});
  recordRun(folder.path(), {.experiment = "chain-moderate", .session = "02", .trials = 2, .practice = true});
  recordRun(folder.path(), {.experiment = "chain-fast", .device = kQuiet, .subject = "02", .trials = 1});
  const Dataset dataset = openDataset(folder.path());
  ASSERT_EQ(dataset.runs.size(), 3u);
  ASSERT_EQ(dataset.input.trials.size(), 7u);
  EXPECT_EQ(dataset.input.conditions.size(), 2u);
  EXPECT_TRUE(dataset.notes.empty());
  std::size_t i = 0;
  for (const char* file :
       {"sub-01_ses-01_task-chainmoderate_run-01", "sub-01_ses-02_task-chainmoderate_run-01", "sub-02_ses-01_task-chainfast_run-01"}) {
    const record::RunLog log = record::RunLog::open(folder.path() + "/sourcedata/" + file + "_log.reach");
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

TEST(Dataset, ExperimentsOfOneNameAreToldApartByWhatDiffers) {
  const TemporaryFolder folder;
  experiment::Experiment e = experiment::readExperiment("dingwell");
  e.name = "mine";
  const auto record = [&](const char* session) {
    const std::string file = folder.path() + "/mine.json";
    std::ofstream(file) << experiment::toJson(e);
    recordRun(folder.path() + "/data", {.experiment = file, .device = kQuiet, .session = session, .trials = 1});
  };
  record("01");
  e.task->duration += 0.25;
  record("02");
  record("03");
  e.object.masses = {2.5};
  record("04");
  const Dataset dataset = openDataset(folder.path() + "/data");
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

TEST(Dataset, WhoseEventsAreNoTableOfEventsIsRefusedAndNotARunWithoutTrials) {
  const TemporaryFolder folder;
  removeLogs(folder.path(), recordRun(folder.path(), {.experiment = "chain-moderate", .trials = 2}));
  ASSERT_EQ(analyzeTrials(openDataset(folder.path()).input, fewCriteria()).trials.size(), 2u);
  const std::string events = fileOf(folder.path(), "_events.tsv");
  for (const std::string& text : {std::string(), std::string(2000, '\xff'), std::string(2000, '\0'), std::string("onset\tduration\n")}) {
    std::ofstream(events, std::ios::binary) << text;
    EXPECT_THROW(analyzeTrials(openDataset(folder.path()).input, fewCriteria()), FaultError) << text.substr(0, 40);
  }
}

// Each dataset below was read as if nothing had happened: other units, another order, and decimal commas.
TEST(Dataset, OfBidsFilesThatAnotherProgramHasChangedIsRefusedWhereItsNumbersWouldBeOthers) {
  const TemporaryFolder folder;
  removeLogs(folder.path(), recordRun(folder.path(), {.experiment = "chain-moderate", .trials = 2}));
  const auto refusalOf = [&](const std::string& ending, const std::regex& text, const std::string& instead) -> std::string {
    const std::string file = fileOf(folder.path(), ending), before = record::readWholeFile(file);
    const std::string after = std::regex_replace(before, text, instead);
    EXPECT_NE(before, after);
    std::ofstream(file, std::ios::binary) << after;
    const std::string refusal =
        reachlab::refusalOf<FaultError>([&] { (void)analyzeTrials(openDataset(folder.path()).input, fewCriteria()); });
    std::ofstream(file, std::ios::binary) << before;
    return refusal;
  };
  EXPECT_EQ(refusalOf("_motion.tsv", std::regex("\n"), "\r\n"), "") << "the ends of lines are no number";
  EXPECT_NE(refusalOf("_channels.tsv", std::regex("\tm\t"), "\tmm\t").find("hand_pos_x in m"), std::string::npos);
  EXPECT_NE(refusalOf("_channels.tsv", std::regex("hand_pos_y"), "hand_pos_z").find("hand_pos_y in m"), std::string::npos);
  EXPECT_NE(refusalOf("_motion.tsv", std::regex("\\."), ",").find("_motion.tsv:1"), std::string::npos) << "in its first line";
  EXPECT_NE(refusalOf("_motion.tsv", std::regex("\\."), ",").find("is not a number"), std::string::npos);
  EXPECT_NE(refusalOf("_events.tsv", std::regex("\\."), ",").find("is not a number"), std::string::npos);
  EXPECT_NE(refusalOf("_events.tsv", std::regex("failure"), "faliure").find("is 'faliure', which is unknown"), std::string::npos);
  EXPECT_NE(refusalOf("_events.tsv", std::regex("\trecorded\t"), "\tPractice\t").find("is 'Practice'"), std::string::npos);
  EXPECT_NE(refusalOf("_events.tsv", std::regex("\n"), "\n9").find("and the recording at"), std::string::npos) << "90 s later";
}

TEST(Dataset, OfBidsFilesWithARowThatWasNotSeenHasTheTrialWithoutIt) {
  const TemporaryFolder folder;
  removeLogs(folder.path(), recordRun(folder.path(), {.experiment = "chain-moderate", .device = kQuiet, .trials = 1}));
  const std::string motion = fileOf(folder.path(), "_motion.tsv");
  const auto trialNow = [&] { return analyzeTrials(openDataset(folder.path()).input, fewCriteria()).trials.at(0); };
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
TEST(Dataset, OfASessionsBidsFilesHasTheExperimentOfItsDataset) {
  const TemporaryFolder folder;
  removeLogs(folder.path(), recordRun(folder.path(), {.experiment = "chain-moderate", .trials = 1}));
  for (const std::string& part : {folder.path(), folder.path() + "/sub-01", folder.path() + "/sub-01/ses-01"})
    EXPECT_TRUE(holds(openDataset(part).notes.at(0), "with the experiments in code/experiments/")) << part;
}

// A dataset and its copy would count twice.
TEST(Dataset, OfBidsFilesOfSeveralDatasetsIsRefused) {
  const TemporaryFolder folder;
  for (const char* part : {"/data", "/second"})
    removeLogs(folder.path() + part, recordRun(folder.path() + part, {.experiment = "chain-moderate", .trials = 1}));
  EXPECT_TRUE(holds(refusalOf([&] { (void)openDataset(folder.path()); }), "holds several datasets"));
}

// The sidecar says how often rows come, or else their times do; a single row has none to tell it by.
TEST(Dataset, OfBidsFilesThatDoNotSayHowOftenHasTheRateOfItsRows) {
  const TemporaryFolder folder;
  removeLogs(folder.path(), recordRun(folder.path(), {.experiment = "chain-moderate", .trials = 1}));
  const std::string motion = fileOf(folder.path(), "_motion.tsv"), sidecar = fileOf(folder.path(), "_motion.json");
  auto about = nlohmann::json::parse(std::ifstream(sidecar));
  about.at("SamplingFrequency") = 0.5;
  std::ofstream(sidecar) << about.dump();
  const Dataset slow = openDataset(folder.path());
  EXPECT_EQ(slow.runs.at(0).configuration.samplingHz, 0.5) << "said, however slow";
  EXPECT_NE(slow.notes.at(0).find("code/experiments"), std::string::npos) << "not the shipped experiment: " << slow.notes[0];
  ASSERT_EQ(about.erase("SamplingFrequency"), 1u);
  std::ofstream(sidecar) << about.dump();
  EXPECT_EQ(openDataset(folder.path()).runs.at(0).configuration.samplingHz, 100);
  std::ifstream rows(motion);
  std::string first, second;
  std::getline(rows, first), std::getline(rows, second);
  rows.close();
  std::ofstream(motion) << first << '\n';
  EXPECT_EQ(openDataset(folder.path()).runs.at(0).configuration.samplingHz, 100);
}

TEST(Dataset, OfSimulatedAndRealHandsSaysThatItMixesThem) {
  const TemporaryFolder folder;
  recordRun(folder.path(), {.experiment = "chain-moderate", .trials = 2});
  EXPECT_TRUE(openDataset(folder.path()).notes.empty());
  recordRun(folder.path(),
            {.experiment = "chain-moderate", .device = "replay:" REACHLAB_SOURCE_DIR "/resources/reaches", .subject = "02", .trials = 2});
  const Dataset mixed = openDataset(folder.path());
  ASSERT_EQ(mixed.notes.size(), 1u);
  EXPECT_NE(mixed.notes[0].find("(replay, simulated)"), std::string::npos) << mixed.notes[0];
}

TEST(FileName, OfAConditionHasLettersNumbersAndSingleHyphens) {
  EXPECT_EQ(fileNameOf("slow, light"), "slow-light");
  EXPECT_EQ(fileNameOf("Pace 2 -- (far)"), "Pace-2-far");
  EXPECT_EQ(fileNameOf(" /../x"), "x");
  EXPECT_EQ(fileNameOf("???"), "condition");
}

TEST(Dataset, ThatIsNoneIsRefusedInOneSentence) {
  const TemporaryFolder folder;
  EXPECT_THROW(openDataset(folder.path()), FaultError);
  EXPECT_THROW(openDataset(folder.path() + "/nowhere"), FaultError);
}

TEST(Dataset, WithADamagedLogKeepsWhatIsGoodAndSaysSo) {
  const TemporaryFolder folder;
  const std::string log = recordRun(folder.path(), {.experiment = "chain-moderate", .trials = 4});
  std::filesystem::resize_file(log, std::filesystem::file_size(log) / 2);
  const Dataset dataset = openDataset(folder.path());
  EXPECT_FALSE(dataset.input.trials.empty());
  EXPECT_EQ(dataset.notes.size(), 1u);
  EXPECT_NO_THROW(analyzeTrials(dataset.input, fewCriteria()));
}

TEST(Analysis, WritesTheSameBytesEachTimeAndEveryNumberOfAFigure) {
  const TemporaryFolder folder;
  recordRun(folder.path(), {.experiment = "chain-moderate", .trials = 5, .seed = 3});
  Dataset dataset = openDataset(folder.path());
  const Analysis analysis = analyzeTrials(dataset.input, fewCriteria());
  const ReportHeader header{"dataset", "0.1.0", "reach analyze dataset"};
  const AnalysisFiles first = writeAnalysis(analysis, dataset, header, folder.path() + "/one");
  const AnalysisFiles second = writeAnalysis(analysis, dataset, header, folder.path() + "/two");
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

  const std::string profiles = record::readWholeFile(folder.path() + "/one/profiles.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::count(profiles.begin(), profiles.end(), '\n')), 1 + 101 * analysis.results[0].used);
}

// Programs that write the same results at the same moment: each ends well, and the tables that are left belong together.
TEST(Analysis, WrittenByThreeAtOnceIsOneOfThem) {
  const TemporaryFolder folder;
  recordRun(folder.path(), {.experiment = "chain-moderate", .trials = 2});
  const Dataset dataset = openDataset(folder.path());
  std::vector<Analysis> analyses;
  for (const double cutoff : {6.0, 8.0, 10.0}) {
    AnalysisOptions options = fewCriteria();
    options.measure.cutoff = cutoff;
    analyses.push_back(analyzeTrials(dataset.input, options));
  }
  const std::string out = folder.path() + "/out";
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
