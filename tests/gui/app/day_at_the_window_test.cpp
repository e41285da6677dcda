// What an experimenter and a subject meet in a day: keys, fields, the subject's screen, questions, the layout.
#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollArea>
#include <QSpinBox>
#include <QTableWidget>
#include <QToolButton>

#include "analysis/analysis.h"
#include "gui/session/remembered_session.h"
#include "gui/scene/scene_overlay.h"
#include "gui/subject/subject_window.h"
#include "sim/experiment/experiment.h"
#include "sim/record/log/run_log.h"
#include "test_paths.h"
#include "tests/analysis/whole_dataset.h"
#include "tests/gui/answer_box.h"
#include "tests/gui/at_the_window.h"

namespace reachlab::gui::app {
namespace {

class Day : public AtTheWindow {
 protected:
  Day() { request_.trials = 3; }
  void key(Qt::Key key, Qt::KeyboardModifiers with = {}) const { QTest::keyClick(window_->windowHandle(), key, with); }
  void clickIntoScene() const {
    const QPoint at = window_->view().mapTo(window_.get(), QPoint(500, 300));
    QTest::mouseClick(window_->windowHandle(), Qt::LeftButton, {}, at);
  }
  // By a simulated hand. The run stays open.
  bool doARunOfOneTrial() {
    request_.device = "simulated:noise=0";
    request_.fast = true;
    request_.trials = 1;
    open().nextTrial();
    return QTest::qWaitFor([&] { return window_->session().lastTrial() && !window_->session().underWay(); }, 20000);
  }
};

TEST_F(Day, AClickIntoTheSceneLeavesTheFieldAndSpaceIsTheTrialsAgain) {
  MainWindow& window = open();
  auto* masses = find<QLineEdit>("masses");
  masses->setFocus();
  masses->selectAll();
  for (const Qt::Key k : {Qt::Key_1, Qt::Key_Space, Qt::Key_1}) key(k);
  EXPECT_EQ(masses->text(), "1 1") << "while it is typed in, a blank is a blank";
  clickIntoScene();
  EXPECT_FALSE(masses->hasFocus());
  EXPECT_EQ(window.session().experiment().object.masses, (std::vector<double>{1, 1}));
  key(Qt::Key_Space);
  EXPECT_NE(window.session().run(), nullptr);
  EXPECT_EQ(masses->text(), "1 1");
}

TEST_F(Day, EnterKeepsAnEntryAndGivesTheKeysBack) {
  MainWindow& window = open();
  auto* masses = find<QLineEdit>("masses");
  masses->setFocus();
  masses->selectAll();
  for (const Qt::Key k : {Qt::Key_2, Qt::Key_Return}) key(k);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !masses->hasFocus(); }, 2000));
  EXPECT_EQ(window.session().experiment().object.masses, (std::vector<double>{2}));
  EXPECT_EQ(window.view().plan().massRadius.size(), 1u);
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(window.session().experiment().object.masses.size(), 5u) << "undone from the scene";
  masses->setFocus();
  key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(window.session().experiment().object.masses, (std::vector<double>{2})) << "redone from a field with nothing of its own to redo";
  masses->setFocus();
  masses->selectAll();
  for (const Qt::Key k : {Qt::Key_X, Qt::Key_Return}) key(k);
  QTest::qWait(20);
  EXPECT_TRUE(masses->hasFocus()) << "a wrong entry is mended where it stands";
}

TEST_F(Day, AStrayKeyNeitherStartsNorRepeatsATrial) {
  request_.device = "simulated:noise=0";
  request_.fast = true;
  request_.trials = 1;
  MainWindow& window = open();
  auto* kind = find<QComboBox>("objectKind");
  kind->setFocus();
  key(Qt::Key_R);
  EXPECT_EQ(window.session().run(), nullptr);
  clickIntoScene();
  key(Qt::Key_Space);
  ASSERT_TRUE(waitForTrialsEnd());
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window.session().underWay(); }, 5000));
  const std::string log = window.session().run()->logPath();
  key(Qt::Key_R);
  key(Qt::Key_Space);
  ASSERT_NE(window.session().run(), nullptr);
  EXPECT_EQ(window.session().run()->logPath(), log) << "the run is over: no key opens another by the way";
  EXPECT_EQ(window.session().run()->trialCount(), 1u);
  key(Qt::Key_R, Qt::ControlModifier);
  EXPECT_EQ(window.session().run()->trialCount(), 2u);
}

// The words that are on the screen, those of the overlay; what is painted comes from them alone.
QString wordsOn(const scene::SceneOverlay& overlay) {
  const scene::OverlayState& s = overlay.state();
  return QStringList{s.counter, s.instruction, s.detail, s.task}.join(QLatin1Char('|'));
}

TEST_F(Day, TheSubjectsScreenHasTheKeysAndShowsNoNumberNameOrKey) {
  MainWindow& window = open();
  window.screens().toggleSubject();
  subject::SubjectWindow* screen = subjectsScreen();
  ASSERT_NE(screen, nullptr);
  ASSERT_TRUE(QTest::qWaitForWindowExposed(screen));
  QApplication::setActiveWindow(screen);
  EXPECT_TRUE(screen->isFullScreen());
  EXPECT_EQ(screen->cursor().shape(), Qt::BlankCursor);
  const auto* overlay = screen->findChild<scene::SceneOverlay*>();
  const QRegularExpression forOthers("\\d|Space|mm|chain|\\bF\\b");
  const auto look = [&] {
    EXPECT_FALSE(overlay->state().rulersShown);
    EXPECT_FALSE(wordsOn(*overlay).contains(forOthers)) << wordsOn(*overlay).toStdString();
  };
  look();
  QTest::keyClick(screen->windowHandle(), Qt::Key_Space);
  ASSERT_NE(window.session().run(), nullptr) << "the experimenter's keys work here";
  ASSERT_TRUE(waitForPhase(trial::Phase::Armed));
  QTest::qWait(50);
  look();
  QTest::keyClick(screen->windowHandle(), Qt::Key_Escape);
  ASSERT_TRUE(waitForTrialsEnd());
  EXPECT_EQ(window.session().lastTrial()->result.outcome, trial::Outcome::Aborted);
  EXPECT_TRUE(screen->isVisible()) << "Esc aborts the trial and leaves the screen";
  QTest::qWait(50);
  look();
  QTest::keyPress(screen->windowHandle(), Qt::Key_F11);  // the window is gone before the key comes up
  QTest::qWait(50);
  EXPECT_EQ(subjectsScreen(), nullptr);
}

TEST_F(Day, AChangeInMidRunIsAskedAboutAndDroppedIfTheRunIsToGoOn) {
  MainWindow& window = open();
  ASSERT_TRUE(armsTrial());
  auto* masses = find<QLineEdit>("masses");
  EXPECT_TRUE(starts(answered("Continue it", [&] { type(masses, "1 1"); }), "0 of 3 trials are done."));
  EXPECT_NE(window.session().run(), nullptr);
  EXPECT_EQ(masses->text(), "5 x 0.6") << "what holds is shown again";
  answered("End the run", [&] { type(masses, "1 1"); });
  EXPECT_EQ(window.session().experiment().object.masses, (std::vector<double>{1, 1}));
  // Taking the edit back is an edit too.
  ASSERT_TRUE(armsTrial());
  EXPECT_TRUE(holds(answered("Continue it", [&] { find<QAction>("undo")->trigger(); }), "Undo ends the run"));
  EXPECT_NE(window.session().run(), nullptr);
  EXPECT_EQ(window.session().experiment().object.masses.size(), 2u);
  answered("End the run", [&] { find<QAction>("undo")->trigger(); });
  EXPECT_EQ(window.session().experiment().object.masses.size(), 5u);
}

TEST_F(Day, ClosingAsksWhileARunIsOpenOrAChangeUnsaved) {
  MainWindow& window = open();
  EXPECT_FALSE(window.isWindowModified());
  auto* masses = find<QLineEdit>("masses");
  masses->setText("1 1");
  Q_EMIT masses->editingFinished();
  EXPECT_TRUE(window.isWindowModified());
  EXPECT_TRUE(holds(answered("Cancel", [&] { EXPECT_FALSE(window.close()); }), "was changed"));
  window.edits().undo();
  EXPECT_FALSE(window.isWindowModified());
  ASSERT_TRUE(armsTrial());
  answered("Continue it", [&] { EXPECT_FALSE(window.close()); });
  EXPECT_NE(window.session().run(), nullptr);
  const std::string log = window.session().run()->logPath();
  answered("End the run", [&] { EXPECT_TRUE(window.close()); });
  EXPECT_EQ(window.session().run(), nullptr);
  const record::RunLog read = record::RunLog::open(log);
  EXPECT_EQ(read.trials().at(0).result.outcome, trial::Outcome::Interrupted);
  EXPECT_TRUE(read.closed());
}

// What a widget needs to show its words in full.
QString cutTexts(const QWidget& window) {
  QStringList cut;
  const QString long_ = "12 of 15 succeeded (80 %), 2 did not count: 1 × too fast, 2 × still moving";
  for (const QWidget* widget : window.findChildren<QWidget*>()) {
    if (!widget->isVisible() || widget->visibleRegion().isEmpty()) continue;
    QString text;
    int needed = 0;
    if (const auto* label = qobject_cast<const QLabel*>(widget); label != nullptr && !label->wordWrap() && !label->text().isEmpty()) {
      text = label->text();
      needed = label->sizeHint().width();
    } else if (const auto* button = qobject_cast<const QAbstractButton*>(widget); button != nullptr && !button->text().isEmpty()) {
      text = button->text();
      needed = button->sizeHint().width() - (qobject_cast<const QToolButton*>(widget) != nullptr ? 0 : 8);
    } else if (const auto* field = qobject_cast<const QLineEdit*>(widget)) {
      text = field->text().isEmpty() ? field->placeholderText() : QString();
      needed = text.isEmpty() ? 0 : field->fontMetrics().horizontalAdvance(text) + 14;
    }
    if (widget->objectName() == QLatin1String("tally")) needed = widget->fontMetrics().horizontalAdvance(long_);
    if (widget->width() < needed) cut << QStringLiteral("%1 (%2 of %3 px)").arg(text).arg(widget->width()).arg(needed);
  }
  return cut.join(", ");
}

// The sizes of usual screens, less a title bar. A screen of 3840 x 2160 at a scale of 2 has the second (ctest gui_scale_2).
TEST_F(Day, NoTextIsCutAndTheTrialsButtonsAreSeenAtEverySize) {
  MainWindow& window = open();
  for (const QSize& size : {QSize(1366, 738), QSize(1920, 1050)}) {
    window.resize(size);
    QTest::qWait(100);
    ASSERT_EQ(window.size(), size) << "the display is too small for this test";
    EXPECT_EQ(cutTexts(window).toStdString(), "") << size.width();
    for (const char* name : {"next", "abort", "repeat", "end", "tally", "note"}) {
      const auto* widget = window.findChild<QWidget*>(QLatin1String(name));
      ASSERT_NE(widget, nullptr) << name;
      EXPECT_EQ(widget->visibleRegion().boundingRect(), widget->rect()) << name << " is covered at " << size.width();
    }
    const auto* session = find<QDockWidget>("sessionDock")->widget();
    EXPECT_GE(session->height(), session->sizeHint().height()) << "the dock of the session has its full height at " << size.width();
  }
}

TEST_F(Day, SpaceBeginsARecordingOnlyInTheSceneOrOnStart) {
  MainWindow& window = open();
  QCheckBox* box = nullptr;
  for (QCheckBox* found : window.findChildren<QCheckBox*>())
    if (found->text().startsWith("start the next trial after")) box = found;
  ASSERT_NE(box, nullptr);
  box->setFocus();
  key(Qt::Key_Space);
  EXPECT_TRUE(box->isChecked()) << "Space is the box's";
  EXPECT_EQ(window.session().run(), nullptr);
  find<QPushButton>("next")->setFocus();
  key(Qt::Key_Space);
  EXPECT_NE(window.session().run(), nullptr) << "Start has the keys";
}

TEST_F(Day, AMessageStaysIfItIsAnErrorAndClosesItselfIfItIsNews) {
  MainWindow& window = open();
  window.say("The disk is full.");
  window.tell("The picture is written.");
  EXPECT_EQ(window.message(), "The picture is written.");
  EXPECT_TRUE(window.findChild<QWidget*>("messages")->isVisible());
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.message() == "The disk is full."; }, 30000));
  window.nextTrial();
  EXPECT_EQ(window.message(), QString()) << "the next trial clears what was said before it";
}

TEST_F(Day, TheEndOfARunShowsItsCountsAndLeadsToTheNextSubject) {
  ASSERT_TRUE(doARunOfOneTrial());
  MainWindow& window = *window_;
  auto* title = find<QLabel>("cardTitle");
  ASSERT_TRUE(QTest::qWaitFor([&] { return title->isVisible(); }, 5000));
  EXPECT_EQ(title->text().toStdString(), "Run 1 is complete");
  EXPECT_TRUE(find<QLabel>("cardText")->text().contains(QString::fromStdString(request_.place.data)));
  EXPECT_TRUE(find<QLabel>("cardText")->text().startsWith(find<QLabel>("tally")->text()));
  find<QPushButton>("endNextSubject")->click();
  EXPECT_FALSE(title->isVisible());
  EXPECT_EQ(window.session().run(), nullptr);
  EXPECT_EQ(window.sessionDock().request().place.subject, "02");
}

TEST_F(Day, ARunThatIsEndedEarlyAsksAndSaysWhereItIsSaved) {
  MainWindow& window = open();
  ASSERT_TRUE(armsTrial());
  EXPECT_TRUE(holds(answered("Continue it", [&] { window.endRun(); }), QString::fromStdString(request_.place.data)));
  EXPECT_NE(window.session().run(), nullptr);
  answered("End the run", [&] { window.endRun(); });
  EXPECT_EQ(window.session().run(), nullptr);
  EXPECT_EQ(window.message(), QStringLiteral("Run 1 is saved in %1.").arg(QString::fromStdString(request_.place.data)));
}

TEST_F(Day, CtrlEEndsTheRunFromAFieldToo) {
  ASSERT_TRUE(doARunOfOneTrial());
  find<QLineEdit>("note")->setFocus();
  key(Qt::Key_E, Qt::ControlModifier);
  EXPECT_EQ(window_->session().run(), nullptr);
}

TEST_F(Day, ARunWhoseDatasetCannotBeWrittenIsNotCalledSaved) {
  MainWindow& window = open();
  ASSERT_TRUE(armsTrial());
  const QString log = QString::fromStdString(window.session().run()->logPath());
  ASSERT_TRUE(QDir().mkpath(QString::fromStdString(request_.place.data) + "/participants.tsv"));  // no file can have this name now
  answered("End the run", [&] { window.endRun(); });
  EXPECT_TRUE(holds(window.message(), QStringLiteral("The finished trials are safe in %1.").arg(log)));
  EXPECT_TRUE(holds(window.message(), "participants.tsv"));
}

TEST(SessionDock, CountsALabelUp) {
  const std::pair<const char*, const char*> labels[] = {{"01", "02"}, {"09", "10"}, {"99", "100"}, {"P9", "P10"}, {"pilot", "pilot2"}};
  for (const auto& [label, next] : labels) EXPECT_EQ(docks::labelAfter(QLatin1String(label)).toStdString(), next);
}

TEST_F(Day, AnotherSubjectDoesNotHaveTheAgeSexAndHandednessOfTheSubjectBefore) {
  request_.participant = {.age = 25, .sex = "F", .handedness = "L"};
  open();
  EXPECT_EQ(window_->sessionDock().request().participant, request_.participant);
  type(find<QLineEdit>("subject"), "02");
  EXPECT_EQ(window_->sessionDock().request().participant, record::Participant());
}

TEST_F(Day, SubjectDeviceFolderAndTrialsAreRememberedWhenTheyChange) {
  open();
  find<QLineEdit>("subject")->setText("17");
  find<QComboBox>("device")->setCurrentText("virtual:omni");
  find<QLineEdit>("data")->setText(folder_.filePath("other"));
  find<QSpinBox>("trialCount")->setValue(7);
  // The window is not closed: a kill would lose nothing.
  const session::SessionRequest again = rememberedRequest({});
  EXPECT_EQ(again.place.subject, "17");
  EXPECT_EQ(again.device, "virtual:omni");
  EXPECT_EQ(again.place.data, folder_.filePath("other").toStdString());
  EXPECT_EQ(rememberedTrials(), 7);
  const std::pair<QString, QString> folders[] = {{"there", QDir::current().filePath("there")},
                                                 {"~/mydata", QDir::home().filePath("mydata")}};
  for (const auto& [typed, meant] : folders) {
    find<QLineEdit>("data")->setText(typed);
    EXPECT_EQ(rememberedRequest({}).place.data, meant.toStdString()) << "wherever the next start is";
  }
  EXPECT_EQ(window_->sessionDock().request().place.data, QDir::home().filePath("mydata").toStdString());
}

TEST_F(Day, FitsASmallScreen) {
  MainWindow& window = open();
  const QSize least = window.minimumSizeHint().expandedTo(window.minimumSize());
  EXPECT_LE(least.width(), 1280);
  EXPECT_LE(least.height(), 690);
  window.resize(1280, 690);
  QTest::qWait(50);
  EXPECT_EQ(window.size(), QSize(1280, 690));
  for (const auto* area : window.findChildren<QScrollArea*>())
    if (area->isVisible()) {
      EXPECT_GE(area->width(), area->widget()->minimumSizeHint().width()) << "nothing is cut off at the side of a dock that scrolls";
    }
}

TEST_F(Day, TheLayoutIsRememberedAndCanBePutBack) {
  MainWindow& first = open();
  first.resize(1300, 800);
  find<QDockWidget>("taskDock")->hide();
  first.addDockWidget(Qt::LeftDockWidgetArea, find<QDockWidget>("objectDock"));
  EXPECT_TRUE(first.close());
  MainWindow& second = open();
  EXPECT_EQ(second.size(), QSize(1300, 800));
  EXPECT_FALSE(find<QDockWidget>("taskDock")->isVisible());
  EXPECT_EQ(second.dockWidgetArea(find<QDockWidget>("objectDock")), Qt::LeftDockWidgetArea);
  find<QAction>("resetLayout")->trigger();
  EXPECT_TRUE(find<QDockWidget>("taskDock")->isVisible());
  EXPECT_EQ(second.dockWidgetArea(find<QDockWidget>("objectDock")), Qt::RightDockWidgetArea);
}

// One law, one number: what the window shows of a run is what the analysis of its recording gives, to the digits that are shown.
TEST_F(Day, EpsilonOfTheRunIsTheAnalysissAndFailedTrialsStayOut) {
  request_.what = "dingwell";
  request_.device = "simulated";
  request_.trials = 8;
  request_.fast = true;
  MainWindow& window = open();
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.predictionsReady(); }, 60000));
  auto* table = window.predictions().findChild<QTableWidget*>();
  int succeeded = 0, failed = 0;
  for (int trial = 0; trial < 8; ++trial) {
    const QString before = table->item(0, 2)->text();
    window.nextTrial();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window.session().underWay() && window.session().lastTrial(); }, 60000));
    QTest::qWait(100);
    ++(window.session().lastTrial()->result.outcome == trial::Outcome::Success ? succeeded : failed);
  }
  auto* trials = find<QTableWidget>("trials");
  ASSERT_EQ(trials->rowCount(), 8);
  EXPECT_EQ(trials->item(0, 0)->text(), "8") << "the newest on top";
  int ticks = 0, times = 0;
  for (int row = 0; row < 8; ++row) {
    ticks += trials->item(row, 1)->text() == "✓";
    times += !trials->item(row, 2)->text().isEmpty() && !trials->item(row, 3)->text().isEmpty();
  }
  EXPECT_EQ(ticks, succeeded);
  EXPECT_EQ(times, 8);
  EXPECT_EQ(trials->item(0, 3)->text(), table->item(0, 2)->text()) << "the last trial's, beside the criterion that is ticked";
  Q_EMIT trials->cellDoubleClicked(6, 0);
  EXPECT_EQ(find<QLineEdit>("note")->text(), "trial 2: ");
  find<QLineEdit>("note")->clear();
  QStringList shown;
  for (int i = 0; i < predict::kCriterionCount; ++i) shown << table->item(i, 3)->text();
  window.session().endRun();
  ASSERT_GT(succeeded, 0);
  EXPECT_GT(failed, 0) << "the seed is to give both";

  const analysis::Analysis analysed = analysis::analyzeTrials(analysis::openDataset(request_.place.data).input, {});
  const analysis::ConditionResult& result = analysed.results.at(0);
  for (const analysis::EpsilonPlace& place : result.handEpsilon) {
    const predict::Criterion criterion = result.signals[place.criterion].criterion;
    EXPECT_EQ(shown.at(static_cast<int>(criterion)).toStdString(), QString::number(place.epsilon, 'f', 4).toStdString())
        << predict::nameOf(criterion);
  }
  EXPECT_GE(result.handEpsilon.size(), 3u);
}

// The rows of the dock go back to their values while one of them is still answering Enter.
TEST_F(Day, AShapeThatIsNotToChangeInAnOpenRunGoesBack) {
  request_.what = "ellipse";
  MainWindow& window = open();
  ASSERT_TRUE(armsTrial());
  auto* radius = find<QDoubleSpinBox>("value_b_m");
  const double before = radius->value();
  answered("Continue it", [&] { type(radius, "0.04"); });
  EXPECT_NE(window.session().run(), nullptr);
  EXPECT_EQ(radius->value(), before);
}

TEST_F(Day, AChangeInATrialEndsItSoThatNoTrialIsJudgedByAnotherScene) {
  MainWindow& window = open();
  ASSERT_TRUE(armsTrial());
  const std::string log = window.session().run()->logPath();
  answered("End the run", [&] { type(find<QLineEdit>("taskTarget"), "3"); });
  EXPECT_EQ(window.session().run(), nullptr);
  EXPECT_EQ(window.session().experiment().task->target, std::vector<double>{3});
  const record::RunLog read = record::RunLog::open(log);
  ASSERT_EQ(read.trials().size(), 1u);
  EXPECT_EQ(read.trials()[0].result.outcome, trial::Outcome::Interrupted);
}

TEST_F(Day, ACompleteRunStaysCompleteWhenItsRepeatIsTakenBack) {
  ASSERT_TRUE(doARunOfOneTrial());
  MainWindow& window = *window_;
  const std::string log = window.session().run()->logPath();
  key(Qt::Key_R, Qt::ControlModifier);
  find<QToolButton>("undoRepeat")->click();
  EXPECT_TRUE(find<QLabel>("cardTitle")->isVisible());
  key(Qt::Key_Space);
  ASSERT_NE(window.session().run(), nullptr);
  EXPECT_EQ(window.session().run()->logPath(), log);
  window.resumeSession();
  EXPECT_EQ(window.session().run(), nullptr);
  EXPECT_TRUE(holds(window.message(), "every trial of this session is recorded"));
}

TEST_F(Day, WhatRestsIsNotDrawnAgain) {
  MainWindow& window = open();
  ASSERT_TRUE(armsTrial());
  // However long the settling takes: once it rests, no picture is drawn in forty frames.
  std::int64_t before = -1;
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return std::exchange(before, window.view().picturesDrawn()) == window.view().picturesDrawn(); }, 20000));
  before = window.view().picturesDrawn();
  for (int frame = 0; frame < 40; ++frame) QTest::qWait(16);
  EXPECT_LE(window.view().picturesDrawn(), before + 1);
}

}  // namespace
}  // namespace reachlab::gui::app
