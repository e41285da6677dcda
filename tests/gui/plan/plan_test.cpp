// A plan composed, begun, rested in, broken off and resumed by who sits at the window.
#include <gtest/gtest.h>

#include <QApplication>
#include <QComboBox>
#include <QDir>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>
#include <fstream>

#include "base/text_file.h"
#include "gui/app/main_window.h"
#include "gui/docks/session_dock.h"
#include "gui/plan/plan_composer.h"
#include "gui/plan/start_page.h"
#include "gui/widgets/named.h"
#include "sim/experiment/resources.h"
#include "sim/record/trial_marks.h"
#include "sim/session/programme.h"
#include "tests/gui/answer_box.h"
#include "tests/gui/at_the_window.h"
#include "tests/refusal.h"

namespace reachlab::gui::plan {
namespace {

TEST(PlanComposer, ComposesAPlanThatReadsBackEqual) {
  const QTemporaryDir folder;
  PlanComposer dialog;
  dialog.show();
  EXPECT_FALSE(dialog.faults().isEmpty()) << "an empty plan is none";
  EXPECT_FALSE(child<QPushButton>(dialog, "planUse")->isEnabled());
  QTest::keyClicks(child<QLineEdit>(dialog, "planName"), QStringLiteral("mine"));
  QTest::mouseClick(child<QPushButton>(dialog, "planAdd"), Qt::LeftButton);
  child<QComboBox>(dialog, "planExperiment")->setEditText(QStringLiteral("chain-slow"));
  QTest::keyClicks(child<QLineEdit>(dialog, "planCondition"), QStringLiteral("slow"));
  child<QSpinBox>(dialog, "planTrials")->setValue(5);
  QTest::keyClicks(child<QPlainTextEdit>(dialog, "planInstructions"), QStringLiteral("Slowly."));
  QTest::mouseClick(child<QPushButton>(dialog, "planCopy"), Qt::LeftButton);
  auto* condition = child<QLineEdit>(dialog, "planCondition");
  condition->selectAll();
  QTest::keyClicks(condition, QStringLiteral("fast"));
  QTest::mouseClick(child<QPushButton>(dialog, "planUp"), Qt::LeftButton);
  ASSERT_EQ(dialog.plan().blocks.size(), 2u);
  EXPECT_EQ(dialog.plan().blocks[0].condition, "fast");
  EXPECT_EQ(dialog.plan().blocks[1].condition, "slow");
  EXPECT_TRUE(dialog.faults().isEmpty()) << dialog.faults().join(QLatin1Char('\n')).toStdString();
  EXPECT_TRUE(child<QLabel>(dialog, "planPreview")->text().contains(QStringLiteral("fast → slow")));
  const QString file = folder.filePath(QStringLiteral("mine.json"));
  dialog.saveTo(file);
  const session::Plan read = session::readPlan(file.toStdString());
  EXPECT_EQ(read.name, "mine");
  ASSERT_EQ(read.blocks.size(), 2u);
  EXPECT_EQ(read.blocks[1].instructions, "Slowly.");
  EXPECT_EQ(read.blocks[1].trials, 5);
  EXPECT_EQ(session::toJson(read), session::toJson(dialog.plan()));
  dialog.close();
  EXPECT_FALSE(dialog.isVisible()) << "it is saved, and nothing is asked";
}

TEST(PlanComposer, FitsOnASmallScreenAndIsNeverLargerThanTheScreen) {
  PlanComposer dialog;
  dialog.show();
  EXPECT_LE(dialog.minimumSizeHint().width(), 1024);
  EXPECT_LE(dialog.minimumSizeHint().height(), 700);
  widgets::resizeOnScreen(dialog, {100'000, 100'000});
  const QSize screen = dialog.screen()->availableGeometry().size();
  EXPECT_LE(dialog.width(), screen.width());
  EXPECT_LT(dialog.height(), screen.height()) << "there is room for the title bar";
}

TEST(PlanComposer, EnterEndsAnEntryAndAWrongNumberIsTold) {
  PlanComposer dialog;
  session::Plan plan;
  plan.name = "p";
  plan.blocks.emplace_back().experiment = "chain-slow";
  plan.blocks.back().trials = 24;
  dialog.setPlan(plan, QStringLiteral("/dev/null/p.json"));
  dialog.show();
  const auto* faults = child<QLabel>(dialog, "planFaults");
  QTest::keyClick(child<QLineEdit>(dialog, "planCondition"), Qt::Key_Return);
  EXPECT_EQ(faults->text(), QString()) << "it is not saved";
  for (const auto& [name, words] : {std::pair{"planRest", "rest before it"}, {"planRingRadius", "radius of the ring"}}) {
    child<QComboBox>(dialog, "planTargets")->setCurrentIndex(1);
    auto* number = child<QDoubleSpinBox>(dialog, name);
    number->selectAll();
    QTest::keyClicks(number, QStringLiteral("1,5"));
    const QString told = QStringLiteral("block 1: %1: \"1,5").arg(QLatin1String(words));
    EXPECT_TRUE(starts(faults->text(), told));
    EXPECT_FALSE(child<QPushButton>(dialog, "planUse")->isEnabled());
    QTest::keyClick(number, Qt::Key_Return);
    EXPECT_TRUE(starts(faults->text(), told));
    number->selectAll();
    QTest::keyClicks(number, QStringLiteral("1.5"));
    QTest::keyClick(number, Qt::Key_Return);
    EXPECT_EQ(faults->text(), QString());
    EXPECT_EQ(number->value(), 1.5);
  }
  EXPECT_EQ(dialog.plan().blocks[0].restSeconds, 1.5);
  EXPECT_TRUE(dialog.isVisible());
  answered("Discard", [&] { dialog.close(); });
}

TEST(PlanComposer, ClosesAChangedPlanOnlyWhenItIsDiscarded) {
  PlanComposer dialog;
  dialog.show();
  QTest::mouseClick(child<QPushButton>(dialog, "planAdd"), Qt::LeftButton);
  answered("Cancel", [&] { dialog.close(); });
  EXPECT_TRUE(dialog.isVisible());
  answered("Discard", [&] { dialog.close(); });
  EXPECT_FALSE(dialog.isVisible());
}

TEST(PlanComposer, NamesFilesSoThatThePlanFindsThemFromEveryFolder) {
  const QTemporaryDir folder;
  QDir(folder.path()).mkpath(QStringLiteral("plans/own"));
  const QString beside = folder.filePath(QStringLiteral("plans/own/a.json")), elsewhere = folder.filePath(QStringLiteral("b.json"));
  for (const QString& file : {beside, elsewhere})
    QFile::copy(QString::fromStdString(*experiment::shippedExperimentFile("chain-slow")), file);
  session::Plan plan;
  plan.name = "p";
  plan.orderSeed = 9'007'199'254'740'992;
  for (const QString& file :
       {QDir::current().relativeFilePath(beside), QDir::current().relativeFilePath(elsewhere), QStringLiteral("chain-fast")})
    plan.blocks.emplace_back().experiment = file.toStdString();
  plan.blocks[0].restSeconds = 86'400;
  PlanComposer dialog;
  dialog.setPlan(plan, {});
  dialog.show();
  const QString file = folder.filePath(QStringLiteral("plans/p.json"));
  child<QSpinBox>(dialog, "planTrials")->setValue(5);  // takes the whole block
  dialog.saveTo(file);
  const std::string text = readTextFile(file.toStdString());
  EXPECT_TRUE(holds(text, "\"own/a.json\"")) << text;
  EXPECT_TRUE(holds(text, '"' + elsewhere.toStdString() + '"')) << text;
  EXPECT_TRUE(holds(text, "\"chain-fast\"")) << text;
  EXPECT_TRUE(holds(text, "9007199254740992")) << text;
  EXPECT_TRUE(holds(text, "\"rest_s\": 86400")) << text;
  session::readProgramme(file.toStdString());
}

TEST(PlanComposer, RefusesAPlanThatCouldNotBeRunAndLeavesItsFileAsItWas) {
  const QTemporaryDir folder;
  const std::string file = folder.filePath(QStringLiteral("p.json")).toStdString();
  std::ofstream(file) << R"({"schema_version": 1, "blocks": [{"experiment": "centre-out", "condition": "a", "trials": 2}]})";
  const std::string before = readTextFile(file);
  PlanComposer dialog;
  dialog.setPlan(session::readPlan(file), QString::fromStdString(file));
  dialog.show();
  auto* use = child<QPushButton>(dialog, "planUse");
  const auto* faults = child<QLabel>(dialog, "planFaults");
  auto* experiment = child<QComboBox>(dialog, "planExperiment");
  experiment->setEditText(QStringLiteral("centre-oot"));
  use->click();
  EXPECT_TRUE(starts(faults->text(), "block 1: experiment: "));
  EXPECT_TRUE(holds(faults->text(), "centre-oot"));
  experiment->setEditText(QStringLiteral("centre-out"));
  EXPECT_EQ(faults->text(), QString());
  child<QPushButton>(dialog, "planAddKind")->click();
  auto* changes = child<QTableWidget>(dialog, "planKinds")->item(0, 4);
  changes->setText(QStringLiteral(R"("environment": [{ "kind": "viscos" }])"));
  use->click();
  EXPECT_TRUE(holds(faults->text(), "viscos"));
  EXPECT_TRUE(dialog.isVisible());
  EXPECT_EQ(readTextFile(file), before);
  changes->setText(QStringLiteral(R"("environment": [])"));
  use->click();
  EXPECT_FALSE(dialog.isVisible()) << faults->text().toStdString();
  EXPECT_NE(readTextFile(file), before);
}

TEST(PlanComposer, ShowsTheOrdersThatSubjectsWillHave) {
  const session::Programme paper = session::readProgramme("paper");
  const QString text = orderPreview(paper.plan, 3);
  EXPECT_TRUE(text.contains(QStringLiteral("subject 01, day 1")));
  EXPECT_TRUE(text.contains(QStringLiteral("subject 03, day 2")));
  const std::vector<int> order = session::blockOrder(paper.plan, "02", 1);
  QStringList names;
  for (const int k : order) names << QString::fromStdString(paper.plan.blocks[static_cast<std::size_t>(k)].condition);
  EXPECT_TRUE(text.contains(names.join(QStringLiteral(" → "))));
}

class PlannedSession : public AtTheWindow {
 protected:
  PlannedSession() {
    request_.what = write("two.json", R"({"schema_version": 1, "name": "two", "blocks": [
      {"experiment": "chain-moderate", "condition": "first", "trials": 2, "instructions": "Reach calmly."},
      {"experiment": "chain-fast", "condition": "second", "trials": 2, "rest_s": 600, "instructions": "Now fast."}]})");
    request_.device = "simulated:noise=0";
    request_.timingCheckSeconds = 0;
    open();
    EXPECT_TRUE(QTest::qWaitFor([&] { return page().isVisible(); }, 3000));
  }
  StartPage& page() { return *window_->findChild<StartPage*>(); }
  QString summary() { return find<QLabel>("startSummary")->text(); }
  QString next() { return find<QLabel>("startNext")->text(); }
  void go() { QTest::mouseClick(find<QPushButton>("startGo"), Qt::LeftButton); }
  void waitForTrials(int count) {
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return window_->session().lastTrial() && window_->session().lastTrial()->trial == count && !window_->session().underWay(); },
        60000));
  }
};

TEST_F(PlannedSession, BeginsOnItsStartPageRestsAndResumes) {
  app::MainWindow* window = window_.get();
  EXPECT_EQ(window->windowTitle(), QStringLiteral("two[*] – Reachlab"));
  EXPECT_EQ(summary(), QStringLiteral("0 of 2 blocks done"));
  EXPECT_TRUE(holds(next(), "block 1, first, with 2 trials"));
  EXPECT_TRUE(next().contains(QStringLiteral("Reach calmly.")));
  go();
  ASSERT_NE(window->session().run(), nullptr) << window->message().toStdString();
  EXPECT_FALSE(page().isVisible());
  EXPECT_TRUE(window->overlay().task.startsWith(QStringLiteral("Reach calmly."))) << "until the first reach";
  waitForTrials(1);
  EXPECT_TRUE(holds(answered("End the run", [&] { window->endRun(); }), "1 of 2 trials are done. End run ends the run"))
      << "broken off after a trial";
  ASSERT_TRUE(QTest::qWaitFor([&] { return page().isVisible(); }, 3000));
  EXPECT_TRUE(page().resumes());
  EXPECT_TRUE(holds(next(), "block 1, first, with trial 2 of 2"));
  go();
  ASSERT_NE(window->session().run(), nullptr) << window->message().toStdString();
  EXPECT_EQ(window->session().run()->configuration().firstRun, 1);
  waitForTrials(1);
  // The block is done: the plan rests ten minutes.
  EXPECT_GT(window->session().restLeft(), 590);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window->overlay().rest.has_value(); }, 5000));
  EXPECT_GT(window->overlay().rest->secondsLeft, 590) << "a countdown over the scene";
  EXPECT_EQ(window->overlay().rest->instructions, QStringLiteral("Now fast."));
  EXPECT_EQ(window->overlay().rest->blocksDone, 1);
  EXPECT_EQ(window->overlay().rest->blocks, 2);
  EXPECT_EQ(window->session().instructions(), QStringLiteral("Now fast."));
  window->nextTrial();
  EXPECT_TRUE(holds(window->message(), "rests"));
  EXPECT_EQ(window->session().run()->configuration().block, 1);
  window->endRun();
  ASSERT_TRUE(QTest::qWaitFor([&] { return page().isVisible(); }, 3000));
  EXPECT_EQ(summary(), QStringLiteral("1 of 2 blocks done"));
  // Another subject has done nothing yet.
  auto* subject = find<QLineEdit>("startSubject");
  find<QLineEdit>("age")->setText(QStringLiteral("31"));
  type(subject, "07");
  ASSERT_TRUE(QTest::qWaitFor([&] { return summary() == QStringLiteral("0 of 2 blocks done"); }, 3000));
  EXPECT_EQ(window->sessionDock().request().place.subject, "07");
  EXPECT_EQ(window->sessionDock().request().participant, record::Participant()) << "it is another person";
}

TEST_F(PlannedSession, TheSubjectReadsTheInstructionsBeforeABlockBegins) {
  window_->screens().toggleSubject();
  const auto read = [] { return subjectsScreen()->view().overlay().state().task; };
  EXPECT_EQ(read(), QStringLiteral("Reach calmly."));
  go();
  waitForTrials(1);
  window_->nextTrial();
  waitForTrials(2);
  EXPECT_TRUE(read().isEmpty()) << read().toStdString();
  window_->endRun();
  EXPECT_EQ(read(), QStringLiteral("Now fast."));
}

TEST_F(PlannedSession, ABlockOfWhichNothingCountsIsNotSkippedBySpace) {
  app::MainWindow* window = window_.get();
  window->openExperiment(
      QString::fromStdString(write("again.json", R"({"schema_version": 1, "name": "again", "repeat_aborted": true, "blocks": [
      {"experiment": "chain-moderate", "condition": "first", "trials": 2}, {"experiment": "chain-fast", "condition": "second", "trials": 2}]})")));
  ASSERT_TRUE(QTest::qWaitFor([&] { return page().isVisible(); }, 3000));
  go();
  ASSERT_NE(window->session().run(), nullptr) << window->message().toStdString();
  window->abortTrial();
  waitForTrials(1);
  answered("End the run", [&] { window->endRun(); });
  ASSERT_TRUE(QTest::qWaitFor([&] { return page().isVisible(); }, 3000));
  EXPECT_TRUE(holds(next(), "block 1, first"));
  ASSERT_TRUE(startsTrial());
  EXPECT_EQ(window->session().run()->configuration().block, 1);
}

TEST_F(PlannedSession, TrialsAreFlaggedAndARepeatIsTakenBack) {
  app::MainWindow* window = window_.get();
  go();
  waitForTrials(1);
  const std::string log = window->session().run()->logPath();
  QTest::mouseClick(find<QToolButton>("flagTrial"), Qt::LeftButton);
  const record::RunMarks marks = record::readMarks(log);
  ASSERT_EQ(marks.trials.size(), 1u);
  EXPECT_TRUE(marks.trials[0].flagged);
  EXPECT_EQ(marks.trials[0].trial, 1);
  QTest::mouseClick(find<QToolButton>("flagTrial"), Qt::LeftButton);
  EXPECT_TRUE(record::readMarks(log).trials.empty()) << "and taken back";
  QTest::keyClick(window, Qt::Key_R, Qt::ControlModifier);
  EXPECT_EQ(window->session().run()->trialCount(), 3u);
  QTest::mouseClick(find<QToolButton>("undoRepeat"), Qt::LeftButton);
  EXPECT_EQ(window->session().run()->trialCount(), 2u);
  EXPECT_EQ(window->session().run()->trialsLeft(), 1u);
  QTest::mouseClick(find<QToolButton>("undoRepeat"), Qt::LeftButton);
  EXPECT_EQ(window->session().run()->trialsLeft(), 1u) << "the plan's own trials stay";
}

}  // namespace
}  // namespace reachlab::gui::plan
