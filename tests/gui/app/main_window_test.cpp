#include "gui/app/main_window.h"

#include <QAction>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSet>
#include <QTableWidget>
#include <QTreeWidget>
#include <regex>
#include <set>

#include "devices/mapping/mapping.h"
#include "gui/scene/scene_actors.h"
#include "gui/scene/scene_overlay.h"
#include "gui/scene/trial_texts.h"
#include "sim/experiment/experiment.h"
#include "sim/record/log/run_log.h"
#include "tests/gui/answer_box.h"
#include "tests/gui/at_the_window.h"

namespace reachlab::gui::app {
namespace {

// An object that a steady pointer brings to rest: well damped, and a wide window in time, so that a stall of the machine spoils nothing.
constexpr const char* kEasy = R"({ "schema_version": 1, "name": "easy", "constraint": { "name": "line", "shape": { "length_m": 0.2 } },
  "object": { "kind": "chain", "masses_kg": [0.2, 0.2], "stiffness_n_per_m": [900], "damping_n_s_per_m": [12] },
  "coupling": { "stiffness_n_per_m": 900, "damping_n_s_per_m": 25 },
  "timing": { "max_missed_ticks": 10000000, "max_gap_s": 7200 },
  "task": { "start": [0], "target": [6.283185307179586], "duration_s": 10.2, "timeout_s": 60,
            "tolerance": { "position_m": 0.012, "velocity_m_per_s": 0.03, "time_s": 9.9 } } })";

class Window : public AtTheWindow {
 protected:
  Window() {
    request_.what = write("easy.json", kEasy);
    request_.trials = 3;
    request_.timingCheckSeconds = 0;
  }
  // The pointer goes through the window system's queue, as a real one does; places are the scene's.
  QPoint inWindow(const QPoint& inScene) const { return window_->view().mapTo(window_.get(), inScene); }
  void press(Qt::MouseButton button, const QPoint& at) const { QTest::mousePress(window_->windowHandle(), button, {}, inWindow(at)); }
  void moveTo(const QPoint& at) const { QTest::mouseMove(window_->windowHandle(), inWindow(at)); }
  void release(Qt::MouseButton button, const QPoint& at) const { QTest::mouseRelease(window_->windowHandle(), button, {}, inWindow(at)); }
};

TEST_F(Window, StartsWithItsDocksAndAPicture) {
  MainWindow& window = open();
  std::set<QString> titles;
  for (const auto* dock : window.findChildren<QDockWidget*>()) {
    EXPECT_TRUE(dock->isVisible() || !window.tabifiedDockWidgets(const_cast<QDockWidget*>(dock)).isEmpty())
        << dock->windowTitle().toStdString();
    titles.insert(dock->windowTitle());
  }
  EXPECT_EQ(titles.size(), 11u);
  const QImage picture = window.view().grabScene();
  QSet<QRgb> inks;
  for (int y = 0; y < picture.height(); y += 3)
    for (int x = 0; x < picture.width(); x += 3) inks.insert(picture.pixel(x, y));
  EXPECT_GT(inks.size(), 100);  // an empty picture has one, the background alone some dozens
  EXPECT_EQ(window.session().run(), nullptr);
}

TEST_F(Window, AReachByThePointerTurnsTheSemaphoreGreenSucceedsAndIsRecorded) {
  // However slowly this machine draws, the pointer arrives before T + dT.
  std::string easy = std::regex_replace(std::string(kEasy), std::regex("10\\.2"), "600.2");
  easy = std::regex_replace(easy, std::regex("\"time_s\": 9\\.9"), "\"time_s\": 599.9");
  write("easy.json", easy);
  MainWindow& window = open();
  QTest::keyClick(&window, Qt::Key_Space);
  ASSERT_EQ(window.message().toStdString(), "time T: is 600.2 s; more than 60 s is hardly meant")
      << "a warning that the run is not stopped by";
  ASSERT_TRUE(waitForPhase(trial::Phase::Armed));
  scene::SceneView& view = window.view();
  const QPoint from = view.pixelOf(view.plan().start).toPoint(), to = view.pixelOf(view.plan().target).toPoint();
  std::set<trial::Semaphore> seen{window.overlay().semaphore};
  press(Qt::LeftButton, from);
  constexpr int kMoves = 60;
  for (int i = 1; i <= kMoves; ++i) {
    const double s = static_cast<double>(i) / kMoves, share = s * s * s * (10 - 15 * s + 6 * s * s);
    moveTo(from + (QPointF(to - from) * share).toPoint());
    QTest::qWait(12);
    seen.insert(window.overlay().semaphore);
  }
  ASSERT_TRUE(waitForPhase(trial::Phase::Done));
  release(Qt::LeftButton, to);
  ASSERT_TRUE(waitForTrialsEnd());
  const trial::TrialResult result = window.session().lastTrial()->result;
  EXPECT_EQ(result.outcome, trial::Outcome::Success) << trial::nameOf(result.reason) << " by " << result.by;
  EXPECT_TRUE(seen.contains(trial::Semaphore::Neutral));
  EXPECT_TRUE(seen.contains(trial::Semaphore::Green));
  EXPECT_GT(window.plot().pointCount(), 20u);
  EXPECT_TRUE(holds(find<QLabel>("tally")->text(), "1 of 1"));

  // What the screen shows is what the record holds.
  const std::string log = window.session().run()->logPath();
  window.session().note("ärgerlich laut");
  window.session().endRun();
  EXPECT_TRUE(window.message().isEmpty() || window.message().endsWith("hardly meant")) << window.message().toStdString();
  const record::RunLog read = record::RunLog::open(log);
  EXPECT_TRUE(read.healthy());
  ASSERT_EQ(read.trials().size(), 1u);
  EXPECT_EQ(read.trials()[0].result.outcome, result.outcome);
  EXPECT_EQ(read.trials()[0].result.movementTime, result.movementTime);
  EXPECT_EQ(read.configuration().experimentText, easy);
  bool noted = false;
  for (const record::RecordedEvent& event : read.events()) noted = noted || event.text == "ärgerlich laut";
  EXPECT_TRUE(noted);
}

TEST_F(Window, TheTaskIsToldBeforeTheFirstTrialAndGoesWhenItRuns) {
  MainWindow& window = open();
  EXPECT_EQ(window.overlay().task.section(QLatin1Char('\n'), 0, 0).toStdString(),
            "Bring both masses to the small yellow sphere (within 12 mm) and to rest there (below 30 mm/s), 0.3 to 20.1 s after your hand "
            "starts to move.");
  EXPECT_TRUE(window.overlay().task.contains("F puts them side by side"));
  QTest::keyClick(&window, Qt::Key_F);
  EXPECT_FALSE(window.overlay().task.contains("hide"));
  ASSERT_TRUE(armsTrial());
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.overlay().task.isEmpty(); }, 5000));
}

TEST(TaskText, SaysWhatIsJudgedAndALatestTimeAloneWhereThereIsNoEarliest) {
  experiment::Experiment e;
  e.object.masses = {1};
  EXPECT_EQ(scene::taskText(e, false), QString());
  e.task = experiment::Task{};
  e.task->duration = 1.5;
  e.task->tolerance = {0.005, 0.02, 8.5};
  EXPECT_EQ(
      scene::taskText(e, false).toStdString(),
      "Bring the mass to the small yellow sphere (within 5 mm) and to rest there (below 20 mm/s), at most 10 s after your hand starts to "
      "move.");
  EXPECT_EQ(scene::overlayOf({}, *e.task, 1, true).detail.toStdString(), "reach in at most 10.00 s");
  EXPECT_EQ(scene::overlayOf({}, *e.task, 1, true).counter.toStdString(), "1 trial");
}

TEST(Overlay, IsGreyWhereATrialDoesNotCount) {
  haptics::TickState state;
  state.phase = trial::Phase::Done;
  state.semaphore = trial::Semaphore::Green;
  state.result.outcome = trial::Outcome::Success;
  EXPECT_EQ(scene::overlayOf(state, {}, 1, true).semaphore, trial::Semaphore::Green);
  for (const auto& [outcome, reason] :
       {std::pair{trial::Outcome::Interrupted, trial::Reason::Timing}, {trial::Outcome::Aborted, trial::Reason::Experimenter}}) {
    state.result.outcome = outcome;
    state.result.reason = reason;
    const scene::OverlayState shown = scene::overlayOf(state, {}, 1, true);
    EXPECT_EQ(shown.semaphore, trial::Semaphore::Neutral) << trial::nameOf(reason);
    EXPECT_EQ(shown.tone, scene::OverlayState::Tone::Plain) << trial::nameOf(reason);
  }
}

TEST(Strip, TellsWhyATrialFailedOnAFullHdScreenAtAScaleOf2) {
  QAction next("&Next trial"), abort("&Abort"), repeat("&Repeat"), end("&End run");
  for (const auto& [action, keys] : {std::pair{&next, "Space"}, {&abort, "Esc"}, {&repeat, "Ctrl+R"}, {&end, "Ctrl+E"}})
    action->setShortcut(QKeySequence(keys));
  SessionStrip strip(&next, &abort, &repeat, &end);
  strip.resize(960, strip.sizeHint().height());
  record::RunConfiguration run;
  run.condition = "chain-moderate";
  strip.showRun(run);
  strip.count({.outcome = trial::Outcome::Failure, .reason = trial::Reason::TimeShort});
  strip.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&strip));
  const auto* tally = child<QLabel>(strip, "tally");
  EXPECT_GE(tally->width(), tally->fontMetrics().horizontalAdvance(tally->text())) << tally->text().toStdString();
}

TEST_F(Window, FieldsSpeakPlainWordsAndUnits) {
  MainWindow& window = open();
  QStringList labels;
  for (const auto* label : window.findChildren<QLabel*>()) labels << label->text();
  for (const char* text : {"length", "start phi [1]", "target phi [1]"}) EXPECT_TRUE(labels.contains(QLatin1String(text))) << text;
  EXPECT_FALSE(labels.contains("length_m"));
  request_.what = "free-point";
  MainWindow& free = open();
  labels.clear();
  for (const auto* label : free.findChildren<QLabel*>()) labels << label->text();
  EXPECT_TRUE(labels.contains("start x y z [m]"));
  find<SessionStrip>("sessionStrip")->count({.outcome = trial::Outcome::Failure, .reason = trial::Reason::TimeShort});
  EXPECT_TRUE(find<QLabel>("tally")->text().contains("1 × too fast"));
}

TEST_F(Window, AWindowInTimeWithoutABeginningLeavesThePlotToTheReach) {
  EXPECT_NEAR(open().plot().shownTimes().second, 20.35, 1e-12);  // T + dT and a quarter of a second
  experiment::Experiment ellipse = experiment::openExperiment("ellipse").experiment();
  ellipse.task->tolerance.time = 8.5;  // 1.5 s, at most 10
  request_.what = write("ellipse.json", experiment::toJson(ellipse));
  MainWindow& window = open();
  EXPECT_NEAR(window.plot().shownTimes().second, 3, 1e-12);
  const scene::ScenePlan& plan = window.view().plan();
  EXPECT_TRUE(window.view().rect().contains(window.view().pixelOf(scene::penEnd(plan.start, plan.handRadius)).toPoint()));
}

TEST_F(Window, MassesPutSideBySideAreAllInThePictureFromTheSameSide) {
  request_.what = "chain-moderate";
  MainWindow& window = open();
  const scene::SceneView& view = window.view();
  press(Qt::RightButton, {400, 300});
  moveTo({430, 290});
  release(Qt::RightButton, {430, 290});
  const auto side = [&] { return (view.camera().position - view.camera().focus) / norm(view.camera().position - view.camera().focus); };
  const Vec3 before = side();
  QTest::keyClick(&window, Qt::Key_F);
  EXPECT_LT(norm(side() - before), 1e-9);
  const QRect inside = view.rect().adjusted(20, 20, -20, -20);
  for (const Vec3& shift : view.plan().massShift)
    for (const Vec3& place : {view.plan().start, view.plan().target}) EXPECT_TRUE(inside.contains(view.pixelOf(place + shift).toPoint()));
}

TEST_F(Window, RightDragTurnsTheCameraAndLeavesTheHand) {
  MainWindow& window = open();
  const scene::Camera before = window.view().camera();
  const Vec3 hand = ownHand(window.view().frame());
  press(Qt::RightButton, {200, 200});
  moveTo({260, 180});
  release(Qt::RightButton, {260, 180});
  EXPECT_GT(norm(window.view().camera().position - before.position), 1e-3);
  EXPECT_EQ(ownHand(window.view().frame()), hand);
}

TEST_F(Window, AWrongEntryIsNamedWhileItIsTypedAndClearsWhenItIsRight) {
  MainWindow& window = open();
  auto* masses = find<QLineEdit>("masses");
  auto* faults = find<QLabel>("objectFaults");
  const struct {
    const char *text, *says;
  } entries[] = {{"0.6 x", "masses: \"x\" is no number"},
                 {"a b", "masses: \"a\" is no number"},
                 {"0.6 kg", "masses: \"kg\" is no number"},
                 {"0.6 -0.6", "mass 2: -0.6 kg; allowed: more than 0"},
                 {"0 x 0.6", "masses: none; allowed: 1 to 512"}};
  for (const auto& entry : entries) {
    type(masses, entry.text, false);
    EXPECT_TRUE(faults->isVisible()) << entry.text;
    EXPECT_TRUE(starts(faults->text(), QLatin1String(entry.says)));
    EXPECT_NE(masses->styleSheet(), QString());
    QTest::keyClick(masses, Qt::Key_Return);
    EXPECT_TRUE(starts(faults->text(), QLatin1String(entry.says)));
    EXPECT_EQ(window.session().experiment().object.masses, (std::vector<double>{0.2, 0.2}));
  }
  type(masses, "0.2 0.2", false);
  EXPECT_FALSE(faults->isVisible());
  EXPECT_EQ(masses->styleSheet(), QString());
  type(find<QLineEdit>("stiffness"), "900 900", false);
  EXPECT_TRUE(starts(faults->text(), "springs: 2 numbers; allowed: 1"));
  auto* via = find<QLineEdit>("taskVia");
  type(via, "0.1 0", false);
  EXPECT_EQ(find<QLabel>("taskFaults")->text().toStdString(), "via: 2 numbers; allowed: 0 to 60, in groups of 3");
  type(via, "0.1 0 0");
  EXPECT_EQ(window.session().experiment().task->via, (std::vector<Vec3>{{0.1, 0, 0}}));
  type(via, "");
  auto* start = find<QLineEdit>("taskStart");
  type(start, "0 1", false);
  EXPECT_EQ(find<QLabel>("taskFaults")->text().toStdString(), "start: 2 numbers; allowed: 1 (phi)");
  auto* duration = find<QDoubleSpinBox>("taskDuration");
  type(duration, "-3", false);
  EXPECT_TRUE(find<QLabel>("taskFaults")->text().contains("time T: -3 s; allowed: 0.05 to 60 s"));
  QTest::keyClick(duration, Qt::Key_Return);
  EXPECT_TRUE(find<QLabel>("taskFaults")->text().contains("; 10.2 s is kept"));
  EXPECT_EQ(duration->value(), 10.2);
  type(start, "0", false);
  EXPECT_FALSE(find<QLabel>("taskFaults")->text().contains("start"));
}

TEST_F(Window, MassesOverOneAnotherAreCountedInTheScene) {
  MainWindow& window = open();
  const auto* overlay = window.view().findChild<scene::SceneOverlay*>();
  ASSERT_NE(overlay, nullptr);
  EXPECT_EQ(overlay->label(), "2 masses");
  QTest::keyClick(&window, Qt::Key_F);
  EXPECT_EQ(overlay->label(), QString());  // side by side each is seen
  QTest::keyClick(&window, Qt::Key_F);
  EXPECT_EQ(overlay->label(), "2 masses");
}

TEST_F(Window, AKindThatIsRefusedLeavesTheMassesAlone) {
  MainWindow& window = open();
  auto* kind = find<QComboBox>("objectKind");
  const auto choose = [&](const char* name) {
    kind->setCurrentText(QLatin1String(name));
    Q_EMIT kind->activated(kind->currentIndex());
  };
  choose("body");
  EXPECT_EQ(find<QLabel>("objectFaults")->text().toStdString(),
            R"(kind: is body, which moves free; allowed: constraint { "name": "free" })");
  choose("chain");
  EXPECT_FALSE(find<QLabel>("objectFaults")->isVisible());
  EXPECT_EQ(window.session().experiment().object.masses, (std::vector<double>{0.2, 0.2}));
}

TEST_F(Window, ADecimalCommaInABoxIsToldAndNeverDropped) {
  MainWindow& window = open();
  auto* stiffness = find<QDoubleSpinBox>("couplingStiffness");
  auto* faults = find<QLabel>("couplingFaults");
  for (const char* wrong : {"0,6", "1,000", "6 kg"}) {
    type(stiffness, wrong, false);
    EXPECT_TRUE(faults->isVisible()) << wrong;
    EXPECT_TRUE(holds(faults->text(), QLatin1Char('"') + QLatin1String(wrong) + QLatin1Char('"')));
    QTest::keyClick(stiffness, Qt::Key_Return);
    EXPECT_EQ(stiffness->value(), 900) << wrong;
  }
  EXPECT_EQ(window.session().experiment().coupling->stiffness, 900);
  type(stiffness, "5e2");
  EXPECT_EQ(window.session().experiment().coupling->stiffness, 500);
}

TEST_F(Window, AWrongFieldIsAskedAboutBeforeARunBeginsOrAFileIsSaved) {
  MainWindow& window = open();
  type(find<QLineEdit>("masses"), "5 x 0,8", false);
  EXPECT_TRUE(starts(answered("Cancel", [&] { window.nextTrial(); }), "masses: "));
  EXPECT_EQ(window.session().run(), nullptr);
  answered("Cancel", [&] { EXPECT_FALSE(window.saveExperiment()); });
  answered("Start", [&] { window.nextTrial(); });
  ASSERT_NE(window.session().run(), nullptr) << window.message().toStdString();
  EXPECT_EQ(window.session().experiment().object.masses, (std::vector<double>{0.2, 0.2}));
}

TEST_F(Window, AFilesNumberBeyondTheRangeOfItsFieldIsShownAsItIs) {
  experiment::Experiment slow = experiment::readExperiment(request_.what);
  slow.task->duration = 90;
  request_.what = write("slow.json", experiment::toJson(slow));
  open();
  auto* duration = find<QDoubleSpinBox>("taskDuration");
  EXPECT_EQ(duration->value(), 90);
  type(duration, "80");
  EXPECT_EQ(window_->session().experiment().task->duration, 80);
  window_->edits().setClean();
  window_->openExperiment("ellipse");
  EXPECT_EQ(duration->maximum(), 60) << "the range of the field is back";
}

TEST_F(Window, ItGoesWithAnEntryUnderWay) {
  open();
  type(find<QLineEdit>("stiffness"), "850", false);
  window_.reset();  // the field is left while the window goes
}

TEST_F(Window, AGermanUsersExperimentHasTheSameBytes) {
  MainWindow& window = open();
  auto* stiffness = find<QDoubleSpinBox>("couplingStiffness");
  stiffness->setValue(612.5);
  EXPECT_TRUE(stiffness->text().startsWith("612.5"));
  const std::string text = experiment::toJson(window.session().experiment());
  EXPECT_NE(text.find("612.5"), std::string::npos);
  EXPECT_EQ(experiment::parseExperiment(text, "edited").coupling->stiffness, 612.5);
}

TEST_F(Window, PredictionsStandOnThePlotAndAreComparedWithASimulatedTrial) {
  experiment::Experiment lenient = experiment::readExperiment("dingwell");
  lenient.timing = experiment::kNoTimingLimits;  // a busy machine spoils nothing here
  request_.what = write("dingwell.json", experiment::toJson(lenient));
  request_.device = "simulated:noise=0";
  MainWindow& window = open();
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.predictionsReady(); }, 20000));
  auto* criteria = window.predictions().findChild<QTableWidget*>("criteria");
  ASSERT_NE(criteria, nullptr);
  for (int i = 0; i < predict::kCriterionCount; ++i) {
    const auto criterion = static_cast<predict::Criterion>(i);
    const bool wanted = criterion == predict::Criterion::MinHandJerk || criterion == predict::Criterion::MinHandForceChange;
    criteria->item(i, 0)->setCheckState(wanted ? Qt::Checked : Qt::Unchecked);
  }
  window.nextTrial();
  ASSERT_TRUE(waitForTrialsEnd());
  EXPECT_EQ(window.session().lastTrial()->result.outcome, trial::Outcome::Success);
  QTest::qWait(100);
  auto* table = window.predictions().findChild<QTableWidget*>();
  ASSERT_NE(table, nullptr);
  const auto forecasts = plot::forecastAll(window.session().compiled());
  EXPECT_EQ(table->item(0, 1)->text(), QString::number(forecasts[0].prediction->handPeak, 'f', 4));  // m/s, as everywhere
  // The simulated subject plans least hand jerk: that row's error is the smallest.
  const double jerk = table->item(0, 2)->text().toDouble(), forceChange = table->item(4, 2)->text().toDouble();
  EXPECT_FALSE(table->item(0, 2)->text().isEmpty());
  EXPECT_LT(jerk, 1e-3) << "a hand without noise is on its plan";
  EXPECT_LT(jerk, forceChange);
}

TEST_F(Window, WhatAnyHandsDeviceCannotGiveIsSaidWhenARunBegins) {
  request_.what = "chain-two-hands";
  request_.device = "virtual:highforce + virtual:omni,scale=0.5";
  MainWindow& window = open();
  ASSERT_TRUE(startsTrial());
  EXPECT_TRUE(holds(window.message(), "hand 2: workspace"));
  EXPECT_TRUE(holds(window.message(), "hand 2: continuous force")) << "all of them";
  EXPECT_FALSE(holds(window.message(), "hand 1"));
}

TEST_F(Window, AMappingThatIsKeptForTheSubjectIsTakenAndSaid) {
  request_.device = "virtual:premium15";
  request_.place.data = (folder_.path() + "/data").toStdString();
  const QString file = folder_.path() + "/data/sourcedata/mappings/sub-01_virtual-premium15.json";
  devices::saveMapping({1.5, {}, {}, false}, file.toStdString());
  MainWindow& window = open();
  ASSERT_TRUE(startsTrial());
  EXPECT_TRUE(holds(window.message(), file));
  EXPECT_NE(window.session().run()->configuration().firstHand.mapping.find("1.5"), std::string::npos);
}

TEST_F(Window, ADeviceThatIsChosenInItsDockIsTheHandUntilARunHasIt) {
  MainWindow& window = open();
  find<QPushButton>("devicesButton")->click();
  auto* rows = find<QTreeWidget>("deviceRows");
  ASSERT_TRUE(QTest::qWaitFor([&] { return rows->isVisible() && rows->topLevelItemCount() > 0; }, 5000));
  const auto omni = rows->findItems("virtual:omni", Qt::MatchExactly | Qt::MatchRecursive, 0);
  ASSERT_EQ(omni.size(), 1);
  rows->setCurrentItem(omni.front());
  find<QPushButton>("deviceUse")->click();
  EXPECT_EQ(window.sessionDock().device(), "virtual:omni");
  ASSERT_TRUE(startsTrial());
  EXPECT_FALSE(find<QPushButton>("deviceUse")->isEnabled());
  window.session().endRun();
  EXPECT_TRUE(find<QPushButton>("deviceUse")->isEnabled());
}

TEST_F(Window, ADiskThatRefusesIsOneSentenceAndTheWindowGoesOn) {
  request_.place.data = "/dev/null/data";
  MainWindow& window = open();
  window.nextTrial();
  EXPECT_TRUE(holds(window.message(), "/dev/null/data"));
  EXPECT_EQ(window.session().run(), nullptr);
  find<QLineEdit>("data")->setText(folder_.path() + "/good");
  window.nextTrial();
  EXPECT_EQ(window.message().toStdString(), "");
  EXPECT_NE(window.session().run(), nullptr);
}

TEST_F(Window, ABadLabelOrAgeIsMarkedAtItsFieldAndStartingIsRefusedInTheSameWords) {
  MainWindow& window = open();
  auto* faults = find<QLabel>("sessionFaults");
  EXPECT_FALSE(faults->isVisible());
  const struct {
    const char *field, *wrong, *says, *right;
  } entries[] = {{"subject", "anna-b", "subject: \"anna-b\" is not a label; allowed: up to 60 letters and digits", "annab"},
                 {"session", "", "session: \"\" is not a label; allowed: up to 60 letters and digits", "2"},
                 {"age", "old", "age: \"old\" is no age; allowed: 0 to 130 years, or nothing", "34"},
                 {"age", "131", "age: \"131\" is no age; allowed: 0 to 130 years, or nothing", ""},
                 {"data", "", "data in: is empty; allowed: a folder", nullptr}};
  for (const auto& entry : entries) {
    auto* field = find<QLineEdit>(entry.field);
    const QString right = entry.right ? QString::fromLatin1(entry.right) : field->text();
    field->setText(QString::fromLatin1(entry.wrong));
    EXPECT_TRUE(faults->isVisible()) << entry.field;
    EXPECT_EQ(faults->text().toStdString(), entry.says);
    EXPECT_NE(field->styleSheet(), QString());
    window.nextTrial();
    EXPECT_EQ(window.message().toStdString(), entry.says);
    EXPECT_EQ(window.session().run(), nullptr);
    EXPECT_EQ(field->text(), QString::fromLatin1(entry.wrong));
    field->setText(right);
    EXPECT_FALSE(faults->isVisible()) << entry.field;
  }
  window.nextTrial();
  EXPECT_EQ(window.message().toStdString(), "");
  ASSERT_NE(window.session().run(), nullptr);
  EXPECT_NE(window.session().run()->logPath().find("sub-annab_ses-2"), std::string::npos);
}

}  // namespace
}  // namespace reachlab::gui::app
