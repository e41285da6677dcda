// What the window records: under whose name, of which plan, and that it is what the command line records.
#include <QAction>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QTableWidget>
#include <csignal>
#include <filesystem>
#include <regex>
#include <set>

#include "analysis/dataset.h"
#include "analysis/tables.h"
#include "base/json/json_tree.h"
#include "base/text_file.h"
#include "gui/session/session_overlay.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"
#include "sim/record/log/run_log.h"
#include "tests/analysis/whole_dataset.h"
#include "tests/cli/program.h"
#include "tests/gui/answer_box.h"
#include "tests/gui/at_the_window.h"
#include "tests/record/configuration_keys.h"
#include "tests/session/recorded_runs.h"

namespace reachlab::gui::app {
namespace {

namespace fs = std::filesystem;

class RecordingWindow : public AtTheWindow {
 protected:
  RecordingWindow() {
    request_.device = "simulated:noise=0";
    request_.fast = true;  // a trial is computed when it is looked for
  }
  MainWindow& open() { return make(); }
  SessionController& session() { return window_->session(); }
  // Space, and the frame that sees the trial's end.
  void doTrial() {
    window_->nextTrial();
    ASSERT_EQ(window_->message().toStdString(), "");
    session().poll();
  }
  void choose(const char* shipped) {
    for (QAction* action : window_->findChildren<QAction*>())
      if (action->text() == QLatin1String(shipped)) return action->trigger();
    FAIL() << "no such entry: " << shipped;
  }
  std::vector<record::RunLog> logs() const { return session::test::logsIn(request_.place); }
};

std::string shippedText(const std::string& name) { return readTextFile(experiment::resourceFolder() + "/experiments/" + name + ".json"); }

TEST_F(RecordingWindow, AnotherExperimentIsRecordedUnderItsOwnLabelConditionAndLogName) {
  request_.trials = 1;
  open();
  doTrial();
  choose("dingwell");
  EXPECT_EQ(session().run(), nullptr) << "the run of the other experiment is over";
  EXPECT_EQ(session().experiment().name, "dingwell");
  doTrial();
  EXPECT_EQ(session().run()->configuration().condition, "dingwell");
  window_->edits().undo();
  EXPECT_EQ(session().experiment().name, "chain-moderate");
  doTrial();
  session().endRun();
  const std::vector<record::RunLog> found = logs();
  ASSERT_EQ(found.size(), 3u);
  const char *names[] = {"chain-moderate", "dingwell", "chain-moderate"}, *labels[] = {"chainmoderate", "dingwell", "chainmoderate"};
  for (std::size_t k = 0; k < 3; ++k) {
    const record::RunConfiguration& c = found[k].configuration();
    record::expectRecorded(c, {{"task", labels[k]}, {"condition", names[k]}, {"experiment_name", names[k]}, {"run", k + 1}});
    EXPECT_EQ(c.experimentText, shippedText(names[k]));
    EXPECT_EQ(c.trials.size(), 1u);
    EXPECT_NE(found[k].path().find(std::string("_task-") + labels[k] + "_run-0"), std::string::npos) << found[k].path();
    EXPECT_TRUE(found[k].closed());
  }
}

TEST_F(RecordingWindow, AnEditedExperimentIsRecordedAsItWasEdited) {
  request_.trials = 1;
  open();
  experiment::Experiment edited = session().experiment();
  edited.coupling->stiffness = 555;
  EXPECT_TRUE(session().tryEdit(edited).empty());
  doTrial();
  session().endRun();
  experiment::Experiment recorded = record::recordedExperiment(logs().at(0).configuration()).experiment();
  recorded.constraint.definition.clear();  // the recording brings its own, the window looks it up
  EXPECT_EQ(recorded.coupling->stiffness, 555);
  EXPECT_EQ(recorded, session().experiment());
}

TEST_F(RecordingWindow, ARunNumberThatWasAskedForHoldsForOneRun) {
  request_.trials = 1;
  request_.run = 5;
  open();
  doTrial();
  doTrial();
  session().endRun();
  const std::vector<record::RunLog> found = logs();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].configuration().run, 5);
  EXPECT_EQ(found[1].configuration().run, 6);
}

TEST_F(RecordingWindow, APlanIsOpenedFromTheMenuAndLeftForAnExperiment) {
  const std::string file = write("two.json", R"({ "schema_version": 1, "trials": 1, "blocks": [
      { "experiment": "chain-slow", "condition": "a" }, { "experiment": "dingwell", "condition": "b" } ] })");
  request_.trials = 2;
  open();
  doTrial();
  EXPECT_TRUE(starts(answered("End the run", [&] { window_->openExperiment(QString::fromStdString(file)); }),
                     "1 of 2 trials are done. Opening another experiment ends the run"));
  EXPECT_TRUE(session().isPlan());
  EXPECT_FALSE(window_->sessionDock().request().trials.has_value());
  EXPECT_EQ(session().experiment().name, "chain-slow");
  doTrial();
  const scene::OverlayState between = overlayOf(session(), false, false);
  EXPECT_EQ(between.counter.toStdString(), "Block 1 of 2, trial 1 of 1");
  ASSERT_TRUE(between.rest.has_value());
  EXPECT_EQ(between.rest->title.toStdString(), "The block is done. Space begins the next block.");
  EXPECT_EQ(between.rest->blocksDone, 1);
  EXPECT_EQ(between.rest->blocks, 2);
  ASSERT_TRUE(subjectsOverlayOf(session(), {}, 0).rest.has_value());
  EXPECT_EQ(subjectsOverlayOf(session(), {}, 0).rest->title, "Rest a little");
  doTrial();
  EXPECT_EQ(overlayOf(session(), false, false).counter.toStdString(), "Block 2 of 2, trial 1 of 1");
  EXPECT_EQ(overlayOf(session(), false, false).detail, "The session is complete");
  EXPECT_EQ(session().experiment().name, "dingwell");
  window_->nextTrial();
  EXPECT_EQ(window_->message(), "The session is complete.");
  window_->nextTrial();
  EXPECT_EQ(window_->message(), "The session is complete.") << "it is not begun again by accident";
  choose("ellipse");
  EXPECT_FALSE(session().isPlan());
  doTrial();
  session().endRun();
  const std::vector<record::RunLog> found = logs();
  ASSERT_EQ(found.size(), 4u);
  record::expectRecorded(found[1].configuration(), {{"condition", "a"}, {"plan_name", "two"}});
  record::expectRecorded(found[2].configuration(), {{"condition", "b"}, {"block", 2}});
  record::expectRecorded(found[3].configuration(), {{"condition", "ellipse"}, {"plan_name", ""}});
  EXPECT_EQ(found[3].configuration().trials.size(), 2u);
}

TEST_F(RecordingWindow, AFileThatCannotBeReadIsOneSentenceAndNothingChanges) {
  open();
  window_->openExperiment(folder_.path() + "/none.json");
  EXPECT_TRUE(holds(window_->message(), "none.json"));
  EXPECT_EQ(session().experiment().name, "chain-moderate");
  EXPECT_EQ(window_->edits().count(), 0);
}

// A day at the laboratory that ends when the program is killed. The test below starts it as a separate process, so ctest does not run it.
TEST_F(RecordingWindow, DISABLED_DiesInTheSecondBlockOfThePapersPlan) {
  request_.what = "paper";
  request_.place.data = qgetenv("REACHLAB_TEST_DATA").toStdString();
  request_.place.subject = "03";
  request_.participant = {.age = 31.5, .sex = "M", .handedness = "R"};
  open();
  for (int trial = 0; trial < 107; ++trial) doTrial();
  window_->nextTrial();  // and in the middle of the next
  std::raise(SIGKILL);
}

TEST_F(RecordingWindow, ThePapersPlanIsDoneBlockByBlockAndResumedAfterAKill) {
  QProcess victim;
  startAgain(victim, "RecordingWindow.DISABLED_*",
             {{"REACHLAB_TEST_DATA", QString::fromStdString(request_.place.data)},
              {"REACHLAB_TEST_CONFIG", qEnvironmentVariable("XDG_CONFIG_HOME")}});
  ASSERT_TRUE(victim.waitForFinished(300000));
  ASSERT_EQ(victim.exitStatus(), QProcess::CrashExit);
  request_.place.subject = "03";
  const std::vector<record::RunLog> before = logs();
  ASSERT_EQ(before.size(), 2u);
  EXPECT_EQ(before[0].trials().size(), 100u);
  EXPECT_TRUE(before[0].closed());
  EXPECT_GE(before[1].trials().size(), 7u);
  EXPECT_FALSE(before[1].closed());

  // Another experiment and another subject are open, and the window offers the session that was cut short.
  request_.place.subject = "99";
  open();
  window_->offerResume();
  EXPECT_EQ(find<QLabel>("cardTitle")->text().toStdString(), "Resume session 01 of subject 03 at trial 8 of 100?");
  EXPECT_TRUE(holds(find<QLabel>("cardText")->text(), "Device simulated:noise=0, seed 1."));
  find<QPushButton>("resumeYes")->click();
  EXPECT_EQ(session().run(), nullptr) << "the first trial waits for Space";
  EXPECT_EQ(window_->sessionDock().request().place.subject, "03");
  EXPECT_EQ(window_->sessionDock().request().participant, before[1].configuration().participant);
  EXPECT_EQ(before[1].configuration().participant.age, 31.5);
  request_.place.subject = "03";
  // Another device asks, and nothing begins when the answer is no.
  window_->sessionDock().setDevice("mouse");
  EXPECT_TRUE(holds(answered("Cancel", [&] { window_->nextTrial(); }), "recorded with the device simulated:noise=0"));
  EXPECT_EQ(session().run(), nullptr);
  window_->sessionDock().setDevice("simulated:noise=0");
  EXPECT_EQ(session().experiment().name, before[1].configuration().experimentName);
  for (int trial = 0; trial < 193; ++trial) {
    doTrial();
    if (trial == 0) {
      EXPECT_EQ(session().run()->configuration().firstRun, 2);
    }
  }
  window_->nextTrial();
  EXPECT_EQ(window_->message(), "The session is complete.");
  std::set<std::pair<int, int>> done;
  const std::vector<record::RunLog> found = logs();
  ASSERT_EQ(found.size(), 4u) << "block 1, block 2 cut short, the rest of block 2, block 3";
  for (const record::RunLog& log : found)
    for (const record::RecordedTrial& trial : log.trials()) {
      if (trial.result.outcome == trial::Outcome::Interrupted) continue;
      EXPECT_TRUE(done.insert({log.configuration().block, trial.planned.index}).second);
    }
  EXPECT_EQ(done.size(), 300u);
  EXPECT_EQ(found[2].configuration().seed, before[1].configuration().seed);
  EXPECT_EQ(found[2].configuration().block, 2);
  EXPECT_EQ(found[3].configuration().block, 3);
  std::set<std::string> conditions{found[0].configuration().condition, found[1].configuration().condition,
                                   found[3].configuration().condition};
  EXPECT_EQ(conditions, (std::set<std::string>{"slow", "moderate", "fast"}));
}

TEST_F(RecordingWindow, AResumedRunKeepsItsNameAndContinuesItsNumbers) {
  request_.trials = 3;
  open();
  doTrial();
  // As a kill leaves it: the run is still remembered.
  QSettings settings;
  std::map<QString, QVariant> left;
  for (const QString& key : settings.allKeys())
    if (key.startsWith("openRun/")) left[key] = settings.value(key);
  session().endRun();
  for (const auto& [key, value] : left) settings.setValue(key, value);
  settings.sync();
  request_.what = "dingwell";
  open();
  window_->offerResume();
  find<QPushButton>("resumeYes")->click();
  EXPECT_EQ(window_->windowTitle(), QStringLiteral("chain-moderate[*] – Reachlab"));
  doTrial();
  EXPECT_EQ(session().run()->configuration().experimentName, "chain-moderate");
  EXPECT_EQ(overlayOf(session(), false, false).counter.toStdString(), "Trial 2 of 3");
}

// A text without what tells the time.
std::string timeless(std::string text) {
  return std::regex_replace(text, std::regex(R"(20\d\d-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?Z?)"), "TIME");
}

// The configuration says when the run was started; every other byte of the log is the same: records, their order, where blocks are cut, links.
void expectSameBytes(const std::string& a, const std::string& b) {
  EXPECT_EQ(fs::file_size(a), fs::file_size(b));
  record::LogReader readerA(a), readerB(b);
  record::RecordView recordA, recordB;
  while (readerA.next(recordA)) {
    ASSERT_TRUE(readerB.next(recordB));
    ASSERT_EQ(recordA.type, recordB.type) << recordA.sequence;
    ASSERT_EQ(recordA.offset, recordB.offset) << recordA.sequence;
    std::string bytesA(recordA.payload.begin(), recordA.payload.end()), bytesB(recordB.payload.begin(), recordB.payload.end());
    if (recordA.type == record::RecordType::Configuration) bytesA = timeless(bytesA), bytesB = timeless(bytesB);
    ASSERT_EQ(bytesA, bytesB) << "record " << recordA.sequence << " of type " << static_cast<int>(recordA.type);
  }
  EXPECT_FALSE(readerB.next(recordB));
  EXPECT_EQ(readerA.goodEnd(), fs::file_size(a)) << "to the end";
}

TEST_F(RecordingWindow, RecordsByteForByteWhatTheCommandLineRecords) {
  const std::string plan =
      write("plan.json", R"({ "schema_version": 1, "order_seed": 4, "trials": 3, "foreperiod_s": [0.1, 0.3], "catch_share": 0.34,
      "blocks": [ { "experiment": "chain-moderate", "condition": "a", "practice": true }, { "experiment": "epitrochoid" } ] })");
  request_.what = plan;
  request_.device = "simulated";
  open();
  for (int trial = 0; trial < 6; ++trial) doTrial();
  session().endRun();
  session::SessionRequest other = request_;
  other.place.data = (folder_.path() + "/other").toStdString();
  const test::Ended reach = test::reach("run " + plan + " --device simulated --seed 1 --fast --data " + other.place.data);
  ASSERT_EQ(reach.exitCode, 0) << reach.err;

  const std::vector<session::RunOnDisk> ours = session::recordedRuns(request_.place), theirs = session::recordedRuns(other.place);
  ASSERT_EQ(ours.size(), 2u);
  ASSERT_EQ(theirs.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(fs::path(ours[k].path).filename(), fs::path(theirs[k].path).filename());
    expectSameBytes(ours[k].path, theirs[k].path);
  }
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(request_.place.data)) {
    if (!entry.is_regular_file() || entry.path().extension() == ".reach") continue;
    const fs::path relative = fs::relative(entry.path(), request_.place.data);
    EXPECT_EQ(timeless(readTextFile(entry.path().string())), timeless(readTextFile((other.place.data / relative).string()))) << relative;
    ++files;
  }
  EXPECT_GE(files, 16);
  for (const auto& entry : fs::recursive_directory_iterator(other.place.data))
    files -= entry.is_regular_file() && entry.path().extension() != ".reach";
  EXPECT_EQ(files, 0) << "as many files there";
}

TEST_F(RecordingWindow, TheFittedEpsilonOfTheRunIsThatOfTheAnalysis) {
  request_.device = "simulated";
  request_.trials = 16;
  open();
  for (int i = 0; i < 16; ++i) doTrial();
  const auto* table = window_->findChild<QTableWidget*>("criteria");
  ASSERT_NE(table, nullptr);
  const auto analysed = analysis::analyzeTrials(analysis::openDataset(session().run()->logPath()).input, {});
  const auto rows = analysis::fitRows(analysed);
  ASSERT_FALSE(rows.empty()) << "the simulated hand succeeds ten times of sixteen with this seed";
  const auto shows = [&] {
    for (const analysis::FitRow& row : rows)
      for (int i = 0; i < predict::kCriterionCount; ++i)
        if (predict::nameOf(static_cast<predict::Criterion>(i)) == row.criterion &&
            table->item(i, 4)->text() != QString::number(row.fit->epsilonOfAll, 'f', 4))
          return false;
    return true;
  };
  EXPECT_TRUE(QTest::qWaitFor(shows, 30000));
}

}  // namespace
}  // namespace reachlab::gui::app
