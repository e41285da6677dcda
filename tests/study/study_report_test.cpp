#include "analysis/study/report.h"

#include <gtest/gtest.h>

#include <thread>
#include <atomic>
#include <cmath>
#include <random>
#include <sstream>

#include "base/fault.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/whole_file.h"
#include "tests/in_a_folder.h"
#include "tests/refusal.h"
#include "tests/study/made_study.h"

namespace reachlab::study {
namespace {

constexpr double kSuccess = 1, kFailure = 2, kAborted = 3;  // places among the words of outcome

std::string lineWith(const std::string& file, const std::string& begin) {
  std::istringstream lines(record::readWholeFile(file));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(begin)) return line;
  return "";
}

StudyFolder folderOf(const std::string& path, const std::string& more) {
  return makeFolder(parseDesign(R"({ "schema_version": 1, "name": "made", "experiment": "chain-moderate", )" + more + "}", "made.json"),
                    path);
}

class StudyReports : public InAFolder {
 protected:
  // Of a plan of these blocks, in whose first and only chunk are these rows.
  StudyReport reportOfPlan(const std::string& blocks, const std::vector<std::vector<double>>& rows) const {
    const std::string plan = folder_.write("plan.json", R"({ "schema_version": 1, "trials": 10, "blocks": [)" + blocks + "] }");
    const StudyFolder study = makeFolder(parseDesign(R"({ "schema_version": 1, "name": "made", "plan": ")" + plan +
                                                         R"(", "subjects": 1, "vary": { "handmass_kg": [0.5] }, "measures": ["by"] })",
                                                     "made.json"),
                                         folder_ / "study");
    writeChunk(study.path, 0, study.fingerprint, chunkOf(rows));
    return makeReport(study, {});
  }
};
class StudyFolders : public InAFolder {};

// Columns: point, subject, trial, seed, the varied one, outcome, reason, by.
TEST_F(StudyReports, CountsSuccessByValueAndByStretch) {
  const StudyFolder study = folderOf(
      folder_.path(), R"("subjects": 2, "trials": 25, "chunk_trials": 50, "vary": { "handmass_kg": [0.5, 2] }, "measures": ["by"])");
  ASSERT_EQ(study.chunks.count(), 2);
  for (int chunk = 0; chunk < 2; ++chunk) {
    std::vector<std::vector<double>> rows;
    for (int subject = 1; subject <= 2; ++subject)
      for (int trial = 1; trial <= 25; ++trial)
        rows.push_back({static_cast<double>(chunk), static_cast<double>(subject), static_cast<double>(trial), 7, chunk == 0 ? 0.5 : 2.0,
                        trial % 5 == 0             ? kAborted
                        : trial > 10 && chunk == 1 ? kSuccess
                                                   : kFailure,
                        0, 0});
    if (chunk == 1) {
      EXPECT_THROW(makeReport(study, {}), FaultError) << "half of it is not there";
    }
    writeChunk(folder_.path(), chunk, study.fingerprint, chunkOf(rows));
  }
  const StudyReport report = makeReport(study, {});
  EXPECT_EQ(report.name, "made");
  EXPECT_EQ(report.points, 2);
  EXPECT_EQ(report.subjects, 2);
  EXPECT_EQ(report.trials, 100);
  ASSERT_EQ(report.success.size(), 2u);
  EXPECT_EQ(report.success[0].key, "handmass_kg");
  EXPECT_EQ(report.success[0].value, "0.5");
  EXPECT_EQ(report.success[1].number, 2);
  EXPECT_EQ(report.success[0].trials, 40u) << "aborted ones do not count";
  EXPECT_EQ(report.success[0].successes, 0u);
  EXPECT_EQ(report.success[1].successes, 24u);
  ASSERT_EQ(report.learning.size(), 3u);
  EXPECT_EQ(report.learning[0].firstTrial, 1u);
  EXPECT_EQ(report.learning[0].lastTrial, 9u) << "the tenth was aborted";
  EXPECT_EQ(report.learning[1].firstTrial, 11u);
  EXPECT_EQ(report.learning[1].lastTrial, 19u);
  EXPECT_EQ(report.learning[1].successes, 16u);
  EXPECT_EQ(report.learning[1].trials, 32u);
  EXPECT_EQ(report.learning[2].lastTrial, 24u);
  ASSERT_EQ(report.notes.size(), 1u);
  EXPECT_NE(report.notes[0].find("need the measure score"), std::string::npos);
  EXPECT_TRUE(report.power.empty());
}

/// People of two truths: scores of (1), (3), the reference; the truth's are lower by so much. The third row of columns: effective samples,
/// scores of the person's own mean, which are `misfit` below those of the truth.
StudyFolder madePower(const std::string& path, double by, int subjects, int trials, double misfit = -0.03, int withoutSuccess = 0) {
  StudyFolder study = folderOf(path, R"("subjects": )" + std::to_string(subjects) + R"(, "trials": )" + std::to_string(trials) +
                                         R"(, "vary": { "subject.criterion": ["min-hand-jerk", "min-crackle"] }, "measures": ["score"],
                                          "criteria": ["min-hand-jerk", "min-crackle", "min-hand-force"])");
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0, 0.2);
  std::vector<std::vector<double>> rows;
  for (int point = 0; point < 2; ++point)
    for (int subject = 1; subject <= subjects; ++subject)
      for (int trial = 1; trial <= trials; ++trial) {
        const double nearer = -by + normal(random), farther = normal(random);
        const double jerk = point == 0 ? nearer : farther, crackle = point == 0 ? farther : nearer;
        rows.push_back({static_cast<double>(point), static_cast<double>(subject), static_cast<double>(trial), 1, static_cast<double>(point),
                        kSuccess, 0, jerk, crackle, std::nan(""), 1 + normal(random), 12, nearer - misfit + 0.2 * normal(random)});
        if (subject > withoutSuccess) continue;
        rows.back()[5] = kFailure;
        std::fill(rows.back().begin() + 7, rows.back().end(), std::nan(""));
      }
  writeChunk(path, 0, study.fingerprint, chunkOf(rows));
  return study;
}

TEST_F(StudyReports, OfClearTruthsNamesThemAtTheSmallestDesign) {
  const StudyReport report = makeReport(madePower(folder_.path(), 2, 24, 22), {.studies = 10, .subjects = {}, .trials = {}});
  // A ladder of 5 6 7 8 10 12 people (half of those there are) and 10 12 15 20 22 trials, for each truth.
  ASSERT_EQ(report.power.size(), 2u * 6 * 5);
  EXPECT_EQ(report.power[0].truth, "min-crackle") << "in the order of their names";
  EXPECT_EQ(report.power[0].subjects, 5u);
  EXPECT_EQ(report.power[0].trials, 10u);
  EXPECT_EQ(report.power[29].subjects, 12u);
  EXPECT_EQ(report.power[29].trials, 22u);
  for (const PowerAt& at : report.power) {
    EXPECT_EQ(at.studies, 10u);
    EXPECT_EQ(at.right, 10u);
    EXPECT_EQ(at.wrong, 0u);
    EXPECT_EQ(at.cell, "");
  }
  ASSERT_EQ(report.smallest.size(), 4u);
  EXPECT_EQ(report.smallest[0].level, 0.8);
  EXPECT_EQ(report.smallest[1].level, 0.95);
  for (const SmallestDesign& least : report.smallest) EXPECT_TRUE(least.subjects == 5 && least.trials == 10);
  ASSERT_EQ(report.confusion.size(), 1u);
  const Confusion& confusion = report.confusion[0];
  EXPECT_EQ(confusion.subjects, 12u);
  EXPECT_EQ(confusion.trials, 22u);
  EXPECT_EQ(confusion.named.studies, 10);
  ASSERT_EQ(confusion.named.candidates.size(), 3u) << "(4) has no scores: (1), (3), the reference";
  EXPECT_EQ(confusion.named.counts[0], (std::vector<std::size_t>{10, 0, 0, 0}));
  EXPECT_EQ(confusion.named.counts[1], (std::vector<std::size_t>{0, 10, 0, 0}));
  EXPECT_EQ(confusion.named.counts[2], (std::vector<std::size_t>{0, 0, 0, 0}));
}

TEST_F(StudyReports, DrawsNoDesignsThatTheStudyDoesNotHave) {
  const StudyFolder study = madePower(folder_.path(), 2, 24, 22);
  for (const std::size_t trials : {9, 23}) EXPECT_THROW(makeReport(study, {.studies = 1, .subjects = {5}, .trials = {trials}}), FaultError);
  for (const std::size_t subjects : {4, 25})
    EXPECT_THROW(makeReport(study, {.studies = 1, .subjects = {subjects}, .trials = {22}}), FaultError);
}

// A laboratory cannot choose subjects who will succeed: of 24 of whom 4 never do, five who do are drawn in 36 % of the studies.
TEST_F(StudyReports, DrawsPeopleWithoutSuccessesToo) {
  const StudyReport report = makeReport(madePower(folder_.path(), 2, 24, 22, -0.03, 4), {.studies = 200, .subjects = {5}, .trials = {22}});
  ASSERT_EQ(report.power.size(), 2u);
  for (const PowerAt& at : report.power) EXPECT_NEAR(static_cast<double>(at.right), 73, 25) << at.truth;
}

TEST_F(StudyReports, CountsNeitherPracticeNorCatchTrials) {
  std::vector<std::vector<double>> rows;  // point, subject, session, day, block, condition, practice, catch, trial, seed, axis, outcome …
  for (int trial = 1; trial <= 4; ++trial)
    rows.push_back({0, 1, 1, 1, 1, 0, trial == 1 ? 1.0 : 0.0, trial == 2 ? 1.0 : 0.0, static_cast<double>(trial), 7, 0.5,
                    trial == 4 ? kFailure : kSuccess, 0, 0});
  const StudyReport report = reportOfPlan(R"({ "experiment": "chain-slow", "trials": 4 })", rows);
  ASSERT_EQ(report.success.size(), 1u);
  EXPECT_EQ(report.success[0].trials, 2u);
  EXPECT_EQ(report.success[0].successes, 1u);
}

// A plan has the conditions A, B and A again: the trials of its third block follow those of the first.
TEST_F(StudyReports, NumbersTheTrialsOfAConditionOverItsBlocks) {
  std::vector<std::vector<double>> rows;
  for (int block = 1; block <= 3; ++block)
    for (int trial = 1; trial <= 10; ++trial)
      rows.push_back({0, 1, 1, 0, 1.0 * block, block == 2 ? 1.0 : 0.0, 0, 0, 1.0 * trial, 7, 0.5, block == 3 ? kSuccess : kFailure, 0, 0});
  const StudyReport report = reportOfPlan(R"({ "experiment": "chain-slow", "condition": "a" },
      { "experiment": "chain-slow", "condition": "b" }, { "experiment": "chain-slow", "condition": "a" })",
                                          rows);
  ASSERT_EQ(report.learning.size(), 3u);
  EXPECT_EQ(report.learning[1].firstTrial, 11u);
  EXPECT_EQ(report.learning[1].successes, 10u);
  EXPECT_EQ(report.learning[0].successes, 0u);
}

TEST_F(StudyReports, OfTruthsThatCannotBeToldIsUndecided) {
  const StudyReport report = makeReport(madePower(folder_.path(), 0.02, 12, 12), {.studies = 8, .subjects = {5, 6}, .trials = {12, 10}});
  ASSERT_EQ(report.power.size(), 8u);
  for (const PowerAt& at : report.power) EXPECT_LE(at.right, 2u);
  for (const SmallestDesign& least : report.smallest) EXPECT_TRUE(least.subjects == 0 && least.trials == 0);
  EXPECT_EQ(report.confusion.at(0).trials, 12u) << "the largest that was asked for";
}

// Nothing is concluded from people whose own mean describes them far better than their nearest candidate.
TEST_F(StudyReports, TakesPoorFitsForNoConclusion) {
  const StudyReport report = makeReport(madePower(folder_.path(), 2, 10, 10, 0.6), {.studies = 5, .subjects = {}, .trials = {}});
  for (const PowerAt& at : report.power) EXPECT_EQ(at.right + at.wrong, 0u);
}

TEST_F(StudyReports, DrawsNothingFromFewerThanFive) {
  const StudyReport report = makeReport(madePower(folder_.path(), 2, 4, 12), {});
  EXPECT_TRUE(report.power.empty());
  ASSERT_EQ(report.notes.size(), 2u);
  EXPECT_EQ(report.notes[0], "min-crackle: 4 virtual subjects with 10 successes; nothing is drawn from fewer than five");
  const TemporaryFolder five;
  EXPECT_EQ(makeReport(madePower(five.path(), 2, 5, 10), {.studies = 2, .subjects = {}, .trials = {}}).power.size(), 2u);
}

TEST_F(StudyReports, SaysWhereNothingReachesTheLevelAndWhatIsNoted) {
  StudyReport report;
  report.name = "n", report.points = 3, report.subjects = 4, report.trials = 50;
  report.smallest = {{"min-crackle", "a=1", 0.95, 0, 0}};
  report.power = {{"min-crackle", "a=1", 5, 10, 8, 6, 1}};
  report.success = {{"a", "1", 1, 3, 8}, {"a", "2", 2, 0, 0}, {"w", "word", 0, 1, 2}};
  report.learning = {{"", 1, 10, 3, 8}, {"", 11, 20, 5, 8}};
  report.notes = {"look"};
  writeReport(report, folder_.path());
  EXPECT_EQ(lineWith(folder_.path() + "/report.md", "| min-crackle"), "| min-crackle | a=1 | 95 % | none of those looked at | |");
  EXPECT_EQ(lineWith(folder_.path() + "/report.md", "Note:"), "Note: look.");
  EXPECT_EQ(lineWith(folder_.path() + "/report.md", "| a | 1"), "| a | 1 | 37.5 | 8.5 to 75.5 | 8 |");
  EXPECT_EQ(lineWith(folder_.path() + "/report.md", "| a | 2"), "| a | 2 | 0.0 | 0.0 to 100.0 | 0 |");
  EXPECT_EQ(lineWith(folder_.path() + "/report.md", "|  | 16"), "|  | 16 | 50.0 |");
  EXPECT_EQ(lineWith(folder_.path() + "/smallest.csv", "min-crackle"), "min-crackle,a=1,95,,");
  EXPECT_EQ(lineWith(folder_.path() + "/power.csv", "min-crackle"), "min-crackle,a=1,5,10,8,6,1,75");
  EXPECT_EQ(lineWith(folder_.path() + "/learning.csv", ",11"), lineWith(folder_.path() + "/learning.csv", ",11,20,5,8,62.5,"));
  EXPECT_NE(lineWith(folder_.path() + "/report.md", "![power](power.svg)"), "");
}

TEST_F(StudyFolders, GivesEachShareItsChunks) {
  const Shard second{2, 3};
  for (int chunk = 0; chunk < 9; ++chunk) EXPECT_EQ(second.has(chunk), chunk % 3 == 1) << chunk;
  EXPECT_TRUE(Shard{}.has(5));
  const StudyFolder study = folderOf(folder_.path(), R"("subjects": 7, "trials": 1, "chunk_trials": 1)");
  for (const int chunk : {1, 4}) writeChunk(folder_.path(), chunk, study.fingerprint, chunkOf({{0, 1}}));
  EXPECT_EQ(chunksToDo(study).missing, (std::vector<std::int64_t>{0, 2, 3, 5, 6}));
  EXPECT_EQ(chunksToDo(study).there, 2);
  EXPECT_EQ(chunksToDo(study, second).missing, std::vector<std::int64_t>{});
  EXPECT_EQ(chunksToDo(study, second).there, 2);
  EXPECT_FALSE(mergeTables(study));
  EXPECT_FALSE(areTablesThere(study));
  const auto writeAll = [&](const char* last) {
    for (const char* name : {"trials.csv.gz", "trials.h5"}) folder_.write(name, "x");
    folder_.write("trials.json", last);
  };
  writeAll("");
  EXPECT_FALSE(areTablesThere(study)) << "one of them is empty";
  writeAll("{}");
  EXPECT_TRUE(areTablesThere(study));
  std::filesystem::remove(folder_ / "trials.json");
  const StudyStatus status = statusOf(study);
  EXPECT_TRUE(status.chunks == 7 && status.chunksDone == 2 && status.trials == 7 && status.trialsDone == 2 && !status.tables);
  std::filesystem::resize_file(chunkPath(folder_.path(), 4), 10);
  EXPECT_TRUE(holds(reachlab::refusalOf([&] { (void)statusOf(study); }), "is damaged; delete it"));
}

TEST_F(StudyFolders, CountsTheTrialsOfEachPoint) {
  const StudyFolder study = folderOf(folder_.path(), R"("subjects": 2, "vary": { "trials": [4, 6] }, "chunk_trials": 6)");
  writeChunk(folder_.path(), 0, study.fingerprint, chunkOf({{0, 1}}));
  EXPECT_EQ(statusOf(study).trials, 20);
  EXPECT_EQ(statusOf(study).trialsDone, 4);
}

// Chunks a minute apart, after a pause of an hour: only what went on since then tells the rate.
TEST_F(StudyFolders, TellsItsRateFromTheLastPauseOn) {
  const StudyFolder study = folderOf(folder_.path(), R"("subjects": 40, "trials": 30, "chunk_trials": 60)");
  const auto begin = std::filesystem::file_time_type::clock::now() - std::chrono::hours(5);
  int chunk = 0;
  for (const int minutes : {0, 1, 70, 71, 73}) {
    writeChunk(folder_.path(), chunk, study.fingerprint, chunkOf({{0, 1}}));
    std::filesystem::last_write_time(chunkPath(folder_.path(), chunk++), begin + std::chrono::minutes(minutes));
  }
  const StudyStatus status = statusOf(study);
  EXPECT_EQ(status.trialsDone, 300);
  EXPECT_NEAR(status.rate, 120 / 180.0, 1e-9) << "two chunks in three minutes, after the first of them";
  EXPECT_NEAR(status.secondsLeft, 900 / status.rate, 1e-6);
  std::filesystem::last_write_time(chunkPath(folder_.path(), 3), begin + std::chrono::minutes(80));
  std::filesystem::last_write_time(chunkPath(folder_.path(), 4), begin + std::chrono::minutes(90));
  EXPECT_EQ(statusOf(study).rate, 0) << "ten minutes are a pause";
}

TEST_F(StudyFolders, KeepsItsDesignAndRefusesAnother) {
  const StudyFolder made = folderOf(folder_.path(), R"("subjects": 3, "vary": { "handmass_kg": [1, 2] })");
  const StudyFolder opened = openFolder(folder_.path());
  EXPECT_EQ(opened.fingerprint, made.fingerprint);
  EXPECT_EQ(opened.design.subjects, 3);
  EXPECT_EQ(opened.design.experimentTexts, made.design.experimentTexts);
  EXPECT_EQ(opened.chunks.pairs, 6);
  EXPECT_NO_THROW(folderOf(folder_.path(), R"("subjects": 3, "vary": { "handmass_kg": [1, 2] })"));
  EXPECT_THROW(folderOf(folder_.path(), R"("subjects": 4)"), ResourceError);
  EXPECT_THROW(openFolder(folder_.path() + "/none"), FaultError);
  record::writeFileAtomically(folder_.path() + "/study.json", "{}");
  EXPECT_THROW(openFolder(folder_.path()), FaultError);
}

// Many programs at once: a folder is of the one design that was there first, and every other one is told so.
TEST_F(StudyFolders, BegunByTwoStudiesAtOnceIsOfOneOfThem) {
  for (int round = 0; round < 40; ++round) {
    std::atomic<int> made{0};
    std::string winner;
    {
      std::vector<std::jthread> programs;
      for (int subjects = 1; subjects <= 4; ++subjects)
        programs.emplace_back([&, subjects] {
          try {
            folderOf(folder_.path(), R"("subjects": )" + std::to_string(subjects));
            if (made++ == 0) winner = std::to_string(subjects);
          } catch (const ResourceError&) {}
        });
    }
    ASSERT_EQ(made, 1) << round;
    EXPECT_EQ(std::to_string(openFolder(folder_.path()).design.subjects), winner);
  }
}

}  // namespace
}  // namespace reachlab::study
