// A recording looked at: by the mouse and the keys, as somebody does who has never seen it.
#include "gui/inspector/inspector.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMouseEvent>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollBar>
#include <QSlider>
#include <QTableWidget>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "analysis/tables.h"
#include "base/ticks.h"
#include "gui/inspector/profile_plot.h"
#include "gui/inspector/replay_view.h"
#include "sim/record/export/bids.h"
#include "sim/record/log/whole_file.h"
#include "test_paths.h"
#include "tests/analysis/recorded.h"
#include "tests/analysis/whole_dataset.h"
#include "tests/gui/answer_box.h"
#include "tests/gui/at_the_window.h"
#include "tests/refusal.h"

namespace reachlab::gui::inspector {
namespace {

class Inspecting : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    cache_ = qgetenv("XDG_CACHE_HOME");
    qputenv("PATH", QFileInfo(QStringLiteral(REACH_PROGRAM)).path().toLocal8Bit() + ":" + qgetenv("PATH"));
    qputenv("XDG_CACHE_HOME", QByteArray::fromStdString(folder_->path() + "/cache"));
    analysis::recordRun(data(), {.experiment = "chain-moderate", .trials = 24});
    analysis::recordRun(data(), {.experiment = "torus", .device = "simulated:noise=0", .subject = "02", .trials = 2});
  }
  static void TearDownTestSuite() {
    if (cache_.isNull()) qunsetenv("XDG_CACHE_HOME");
    else qputenv("XDG_CACHE_HOME", cache_);
    delete folder_;
  }
  static std::string data() { return folder_->path() + "/data"; }
  static std::string log() { return data() + "/sourcedata/sub-01_ses-01_task-chainmoderate_run-01_log.reach"; }

  Inspecting() {
    page_.resize(1500, 900);
    page_.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&page_));
    QApplication::setActiveWindow(&page_);  // there may be no window manager to do it
    page_.view().setFocus();
    QObject::connect(&page_, &InspectorPage::said, [this](const QString& words) { said_ = words; });
    QObject::connect(&page_, &InspectorPage::told, [this](const QString& words) { said_ = words; });
    page_.open(QString::fromStdString(data()));
    EXPECT_TRUE(QTest::qWaitFor([this] { return page_.table().rowCount() == 26; }, 10000));
    settle();
  }
  ~Inspecting() override { std::filesystem::remove(record::marksPathOf(log())); }
  void settle() {
    QTest::qWait(250);  // a choice is read a little later
    ASSERT_TRUE(QTest::qWaitFor([this] { return !page_.busy(); }, 60000));
    QTest::qWait(20);
  }
  template <typename T>
  T* find(const char* name) const {
    return child<T>(page_, name);
  }
  QPoint cell(int viewRow, int column = 0) const { return page_.view().visualRect(page_.view().model()->index(viewRow, column)).center(); }
  void choose(int first, int last) {
    QTest::mouseClick(page_.view().viewport(), Qt::LeftButton, {}, cell(first));
    QTest::mouseClick(page_.view().viewport(), Qt::LeftButton, Qt::ShiftModifier, cell(last));
    settle();
  }
  mutable InspectorPage page_;
  QString said_;
  static inline TemporaryFolder* folder_ = nullptr;
  static inline QByteArray cache_;
};

TEST_F(Inspecting, TheNumbersAreThoseOfTheAnalysis) {
  choose(0, 23);
  const analysis::Analysis study = analysis::analyzeTrials(analysis::openDataset(log()).input, {});
  const auto* table = find<QTableWidget>("inspectedCriteria");
  const auto rows = analysis::fitRows(study);
  ASSERT_FALSE(rows.empty());
  int compared = 0;
  for (const analysis::FitRow& row : rows)
    for (int i = 0; i < predict::kCriterionCount; ++i)
      if (predict::nameOf(static_cast<predict::Criterion>(i)) == row.criterion) {
        EXPECT_EQ(table->item(i, 2)->text(), QString::number(row.fit->epsilonOfAll, 'f', 4)) << row.criterion;
        ++compared;
      }
  EXPECT_GT(compared, 3);
  const analysis::ConditionResult& r = study.results[0];
  for (const analysis::EpsilonPlace& place : r.handEpsilon)
    EXPECT_EQ(table->item(static_cast<int>(r.signals[place.criterion].criterion), 1)->text(), QString::number(place.epsilon, 'f', 4));
  // And of each trial in the table.
  for (const analysis::AnalyzedTrial& trial : study.trials) {
    const int row = page_.table().rowOf(log(), trial.key.trial);
    const QString shown = page_.table().index(row, TrialTable::kPaper).data().toString();
    EXPECT_EQ(shown, trial.used() ? QString::number(trial.paperError[0], 'f', 4) : QString());
  }
}

TEST_F(Inspecting, LineRowAndReplayGoTogether) {
  choose(0, 4);
  ASSERT_EQ(page_.plot().lineCount(), 5);
  // The line of trial 3, clicked where it stands alone.
  const auto& signals = page_.inspection()->signals;
  const analysis::Movement& move = signals[2].movement;
  double best = 0;
  QPoint at;
  for (double t = 0.1; t < move.duration(); t += 0.01) {
    double apart = 1e9;
    const double own = analysis::valueAt(signals[2].handVelocity, 100, move.onset + t);
    for (std::size_t i = 0; i < 5; ++i)
      if (i != 2) apart = std::min(apart, std::abs(own - analysis::valueAt(signals[i].handVelocity, 100, signals[i].movement.onset + t)));
    if (apart > best) best = apart, at = page_.plot().pixelOf(t, own);
  }
  QWidget* canvas = page_.plot().childAt(at);
  ASSERT_NE(canvas, nullptr);
  QTest::mouseClick(canvas, Qt::LeftButton, {}, canvas->mapFrom(&page_.plot(), at));
  EXPECT_EQ(page_.plot().pickedLine(), 2);
  EXPECT_EQ(page_.view().currentIndex().row(), 2) << "the row goes with the line";
  EXPECT_EQ(page_.view().selectionModel()->selectedRows().size(), 5) << "and the choice stays";
  // The replay stands where the recording does.
  page_.replay().goTo(0.4);
  const record::RunLog run = record::RunLog::open(log());
  const record::RecordedTrial& trial = run.trials()[2];
  const record::SampleRows rows = run.rows(trial);
  const double since = page_.inspection()->input.trials[2].first + move.onset + 0.4;
  const std::size_t column = run.configuration().table.indexOf("mass5_pos_x");
  std::size_t row = 0;
  while (row + 1 < rows.size() && secondsBetween(trial.armedTick, std::max(trial.armedTick, rows.ticks[row + 1])) <= since) ++row;
  const double low = std::min(rows.at(row, column), rows.at(row + 1, column)),
               high = std::max(rows.at(row, column), rows.at(row + 1, column));
  EXPECT_GE(page_.replay().view().frame().masses[4].x, low - 1e-12);
  EXPECT_LE(page_.replay().view().frame().masses[4].x, high + 1e-12);
}

TEST_F(Inspecting, ANoteThatIsBeingTypedIsTheTrialsWhenALineIsClicked) {
  choose(0, 4);
  const int trial = page_.view().model()->index(page_.view().currentIndex().row(), TrialTable::kTrial).data().toInt();
  auto* note = find<QLineEdit>("trialNote");
  QTest::mouseClick(note, Qt::LeftButton);
  QTest::keyClicks(note, "talked");
  QWidget* canvas = page_.plot().childAt(page_.plot().pixelOf(0.2, 0.1));
  ASSERT_NE(canvas, nullptr);
  QTest::mouseClick(canvas, Qt::LeftButton);
  const record::RunMarks marks = record::readMarks(log());
  const record::TrialMark* mark = marks.find(trial);
  ASSERT_NE(mark, nullptr);
  EXPECT_EQ(mark->note, "talked");
}

TEST_F(Inspecting, TimeIsPlayedSteppedAndLooped) {
  choose(1, 1);
  auto* slider = find<QSlider>("replayTime");
  page_.replay().goTo(0);
  const double before = page_.replay().time();
  QTest::keyClick(&page_, Qt::Key_Period);
  EXPECT_NEAR(page_.replay().time() - before, 0.01, 0.0099) << "a row of 100 a second";
  QTest::keyClick(&page_, Qt::Key_Period);
  QTest::keyClick(&page_, Qt::Key_Comma);
  EXPECT_NEAR(page_.replay().time(), before + 0.01, 0.0099);
  slider->setValue(300);
  EXPECT_DOUBLE_EQ(page_.replay().time(), 0.3);
  find<QComboBox>("replaySpeed")->setCurrentIndex(5);
  QTest::mouseClick(find<QToolButton>("replayPlay"), Qt::LeftButton);
  EXPECT_TRUE(page_.replay().playing());
  EXPECT_EQ(page_.replay().speed(), 4);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !page_.replay().playing(); }, 20000)) << "it ends at the trial's end";
  EXPECT_EQ(slider->value(), slider->maximum());
  find<QCheckBox>("replayLoop")->click();
  QTest::keyClick(&page_, Qt::Key_P);
  bool back = false;
  double last = 0;
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        back = back || page_.replay().time() < last;
        last = page_.replay().time();
        return back && page_.replay().playing();
      },
      20000))
      << "over and over";
}

TEST_F(Inspecting, MarksAreMovedByTheMouseAndStandBesideTheRecording) {
  choose(1, 1);
  const std::string before = record::readWholeFile(log());
  const analysis::Movement move = page_.inspection()->signals[0].movement;
  const double first = page_.inspection()->input.trials[0].first;
  QPoint from, to;
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {  // a busy machine is still laying the axes out
        const QPoint known = from, knownTo = to;
        from = page_.plot().pixelOf(0, 0), to = page_.plot().pixelOf(0.12, 0);
        QTest::qWait(60);
        return from == known && to == knownTo && page_.plot().pixelOf(0, 0) == from && page_.plot().pixelOf(0.12, 0) == to;
      },
      10'000));
  QWidget* canvas = page_.plot().childAt(from);
  from = canvas->mapFrom(&page_.plot(), from);
  to = canvas->mapFrom(&page_.plot(), to);
  QTest::mousePress(canvas, Qt::LeftButton, {}, from);
  for (const QPoint& at : {(from + to) / 2, to}) {  // QTest's own move lets go of the button
    QMouseEvent drag(QEvent::MouseMove, at, Qt::NoButton, Qt::LeftButton, {});
    QApplication::sendEvent(canvas, &drag);
  }
  QTest::mouseRelease(canvas, Qt::LeftButton, {}, to);
  settle();
  const record::RunMarks marks = record::readMarks(log());
  const record::TrialMark* mark = marks.find(2);
  ASSERT_NE(mark, nullptr);
  ASSERT_TRUE(mark->onset.has_value());
  EXPECT_NEAR(*mark->onset, first + move.onset + 0.12, 0.005) << "later by what it was dragged, and a pixel is some milliseconds";
  EXPECT_FALSE(mark->offset.has_value());
  EXPECT_NEAR(page_.inspection()->signals[0].movement.onset, *mark->onset - first, 1e-12) << "the numbers follow";
  EXPECT_EQ(record::readWholeFile(log()), before) << "the recording is as it was";
  QTest::mouseClick(find<QPushButton>("marksByRule"), Qt::LeftButton);
  settle();
  EXPECT_TRUE(record::readMarks(log()).trials.empty());
  EXPECT_DOUBLE_EQ(page_.inspection()->signals[0].movement.onset, move.onset);
}

TEST_F(Inspecting, ATrialIsExcludedOnlyWithAReason) {
  choose(0, 23);
  QTest::mouseClick(find<QCheckBox>("exclude"), Qt::LeftButton, {}, QPoint(8, 8));
  EXPECT_TRUE(record::readMarks(log()).trials.empty());
  auto* reason = find<QLineEdit>("excludeReason");
  QTest::keyClicks(reason, "talked");
  QTest::keyClick(reason, Qt::Key_Return);
  settle();
  const record::RunMarks marks = record::readMarks(log());
  ASSERT_EQ(marks.trials.size(), 1u);
  EXPECT_EQ(marks.trials[0].excluded, "talked");
  EXPECT_TRUE(holds(find<QLabel>("inspectedWords")->text(), "excluded: talked"));
  auto* filter = find<QLineEdit>("inspectorFilter");
  QTest::keyClicks(filter, "excluded sub-01");
  ASSERT_EQ(page_.view().model()->rowCount(), 1);
  EXPECT_EQ(page_.view().model()->index(0, TrialTable::kTrial).data().toInt(), marks.trials[0].trial);
}

TEST_F(Inspecting, TheTableSortsByNumber) {
  page_.view().sortByColumn(TrialTable::kTrial, Qt::DescendingOrder);
  const auto number = [&](int row) { return page_.view().model()->index(row, TrialTable::kTrial).data().toInt(); };
  EXPECT_EQ(number(0), 24);
  EXPECT_EQ(number(1), 23) << "not 9, as words would";
  page_.view().sortByColumn(TrialTable::kTime, Qt::AscendingOrder);
  double last = 0;
  for (int row = 0; row < 26; ++row) {
    const double t = page_.view().model()->index(row, TrialTable::kTime).data(Qt::UserRole).toDouble();
    EXPECT_GE(t, last);
    last = t;
  }
}

TEST_F(Inspecting, FiguresAndTablesAreWritten) {
  choose(0, 11);
  const QString base = QString::fromStdString(folder_->path()) + "/out";
  page_.exportTo(base + ".svg");
  page_.exportTo(base + ".pdf");
  page_.exportTo(base + ".csv");
  const std::string svg = record::readWholeFile((base + ".svg").toStdString());
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_TRUE(record::readWholeFile((base + ".pdf").toStdString()).starts_with("%PDF"));
  const std::string csv = record::readWholeFile((base + ".csv").toStdString());
  std::size_t samples = 0;
  for (const analysis::TrialSignals& s : page_.inspection()->signals) samples += s.handVelocity.size();
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), samples + 1);
  page_.exportTable(base + "-table.csv");
  const std::string table = record::readWholeFile((base + "-table.csv").toStdString());
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 27);
  EXPECT_THROW(page_.exportTo(base + ".doc"), Error);
}

TEST_F(Inspecting, AFileWithoutAnEndingIsOfTheKindThatIsChosen) {
  QCoreApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
  choose(0, 3);
  const QString base = QString::fromStdString(folder_->path()) + "/bare";
  for (QAction* action : page_.findChildren<QAction*>())
    if (action->text().startsWith("Figure or lines"))
      triggerWith<QFileDialog>(action, [&](QFileDialog& dialog) {
        dialog.selectNameFilter("Figure as PDF (*.pdf)");
        dialog.findChild<QLineEdit*>("fileNameEdit")->setText(base);
      });
  EXPECT_TRUE(QFileInfo::exists(base + ".pdf")) << said_.toStdString();
  EXPECT_NE(refusalOf([&] { page_.exportTo(base + ".doc"); }).find(".csv"), std::string::npos);
}

TEST_F(Inspecting, WhatIsExportedIsWhatIsDrawn) {
  choose(0, 11);
  const std::string base = folder_->path() + "/drawn";
  const auto written = [&](const char* suffix) {
    page_.exportTo(QString::fromStdString(base + suffix));
    return record::readWholeFile(base + suffix);
  };
  const std::string dashed = "stroke-dasharray";  // as a prediction is
  EXPECT_NE(written(".svg").find(dashed), std::string::npos);
  find<QCheckBox>("inspectorPredicted")->setChecked(false);
  find<QCheckBox>("inspectorFitted")->setChecked(false);
  EXPECT_EQ(written(".svg").find(dashed), std::string::npos);
  // Scaled in time every movement begins at 0 and ends at the mean duration.
  find<QComboBox>("inspectorAxis")->setCurrentIndex(1);
  double sum = 0, latest = 0, earliest = 0;
  int found = 0;
  for (const analysis::TrialSignals& s : page_.inspection()->signals)
    if (s.movement.found) sum += s.movement.duration(), ++found;
  const QStringList rows = QString::fromStdString(written(".csv")).split(QLatin1Char('\n'), Qt::SkipEmptyParts).mid(1);
  for (const QString& row : rows) {
    const double time = row.section(QLatin1Char(','), 5, 5).toDouble();
    latest = std::max(latest, time), earliest = std::min(earliest, time);
  }
  EXPECT_NEAR(latest, sum / found, 1e-9);
  EXPECT_EQ(earliest, 0);
}

TEST_F(Inspecting, TheReportIsTheOneOfTheAnalysis) {
  page_.open(QString::fromStdString(log()));
  settle();
  QTest::mouseClick(find<QPushButton>("inspectorReport"), Qt::LeftButton);
  QTest::qWait(50);
  settle();
  const std::string folder = data() + "/sourcedata/sub-01_ses-01_task-chainmoderate_run-01_report";
  EXPECT_TRUE(holds(said_, QString::fromStdString(folder + "/report.html")));
  EXPECT_TRUE(std::filesystem::exists(folder + "/fits.csv"));
}

TEST_F(Inspecting, WhatIsNoRecordingIsSaid) {
  page_.open(QString::fromStdString(folder_->path() + "/cache"));
  ASSERT_TRUE(QTest::qWaitFor([this] { return !page_.busy(); }, 10000));
  QTest::qWait(40);
  EXPECT_TRUE(holds(said_, "neither logs"));
}

TEST_F(Inspecting, ADatasetWithoutLogsShowsItsMotionFiles) {
  const std::string copy = folder_->path() + "/exported";
  std::vector<record::RunLog> runs;
  for (const std::string& path : record::findLogs(data())) runs.push_back(record::RunLog::open(path));
  record::writeBids(runs, copy);
  page_.open(QString::fromStdString(copy));
  ASSERT_TRUE(QTest::qWaitFor([this] { return !page_.busy() && page_.table().rowCount() == 26; }, 20000)) << said_.toStdString();
  settle();
  EXPECT_TRUE(holds(said_, "no logs"));
  choose(0, 4);
  ASSERT_NE(page_.inspection(), nullptr) << said_.toStdString();
  EXPECT_EQ(page_.plot().lineCount(), 5);
  EXPECT_FALSE(page_.replay().view().frame().masses.empty());
  page_.replay().goTo(0.4);
  const Vec3 hand = ownHand(page_.replay().view().frame());
  EXPECT_GT(norm(hand - page_.replay().view().plan().start), 1e-3) << "it moves";
  QTest::mouseClick(find<QCheckBox>("flag"), Qt::LeftButton, {}, QPoint(8, 8));
  EXPECT_TRUE(holds(said_, "Marks are kept beside a recording's log"));
  EXPECT_FALSE(find<QCheckBox>("flag")->isChecked());
}

TEST_F(Inspecting, ALogThatIsCutOffNamesWhatItLost) {
  const std::string copy = folder_->path() + "/cut/sourcedata/" + std::filesystem::path(log()).filename().string();
  std::filesystem::create_directories(std::filesystem::path(copy).parent_path());
  std::filesystem::copy_file(log(), copy, std::filesystem::copy_options::overwrite_existing);
  const std::vector<record::RecordedTrial> trials = record::RunLog::open(log()).trials();
  std::filesystem::resize_file(copy, (trials[6].offset + trials[7].offset) / 2);
  page_.open(QString::fromStdString(folder_->path() + "/cut"));
  ASSERT_TRUE(QTest::qWaitFor([this] { return !page_.busy() && page_.table().rowCount() == 7; }, 20000)) << said_.toStdString();
  EXPECT_TRUE(holds(said_, "Trial 7 broke off. The planned trials 8 to 24 are not in it."));
  EXPECT_TRUE(find<QLabel>("inspectorCount")->text().contains("1 with losses"));
  settle();
}

// At the size of a small laptop: every column shows its numbers, and what is under way has its room.
TEST_F(Inspecting, ColumnsAndProgressFit) {
  for (const QSize& size : {QSize(1340, 640), QSize(1900, 960)}) {
    page_.resize(size);
    QTest::qWait(50);
    EXPECT_EQ(page_.size(), size) << "its content asks for no more";
    choose(0, 23);
    for (int column = 0; column < TrialTable::kMark; ++column) {
      const int room = page_.view().columnWidth(column);
      const auto* model = page_.view().model();
      const QFontMetrics metrics(page_.view().font());
      const int heading = QFontMetrics(page_.view().horizontalHeader()->font())
                              .horizontalAdvance(model->headerData(column, Qt::Horizontal, Qt::DisplayRole).toString());
      EXPECT_GE(room, heading + 4) << "heading of column " << column;
      for (int row = 0; row < 24 && column != TrialTable::kOutcome; ++row)  // its tool tip has all of the reason
        EXPECT_GE(room, metrics.horizontalAdvance(model->index(row, column).data().toString()) + 6)
            << "row " << row << ", column " << column;
    }
    EXPECT_EQ(page_.view().horizontalScrollBar()->maximum(), 0)
        << "all columns are seen: " << page_.view().horizontalHeader()->length() << " pixels in " << page_.view().viewport()->width();
    auto* progress = find<QProgressBar>("inspectorProgress");
    progress->setRange(0, 88'888);
    progress->setValue(88'888);
    progress->setFormat("fitting trial %v / %m");
    progress->show();
    find<QPushButton>("inspectorCancel")->show();
    QTest::qWait(50);
    EXPECT_EQ(page_.size(), size);
    EXPECT_GE(progress->width(), QFontMetrics(progress->font()).horizontalAdvance(progress->text()) + 8) << progress->text().toStdString();
    for (QWidget* button : page_.findChildren<QPushButton*>()) {
      if (button->isVisible()) {
        EXPECT_GE(button->width(), button->minimumSizeHint().width());
      }
    }
    progress->hide();
    find<QPushButton>("inspectorCancel")->hide();
  }
}

TEST(Replay, ShowsTheSceneFileOfItsExperiment) {
  const TemporaryFolder folder;
  folder.write("ball.wrl", "#VRML V2.0 utf8\nDEF mass1 Shape { geometry Sphere { radius 0.02 } }\n");
  const auto openWith = [](const std::string& scene) {
    experiment::SceneLook look;
    look.sceneFile = scene;
    return experiment::openExperimentText(experiment::withLook(experiment::openExperiment("dingwell").experiment(), look).text, "recorded");
  };
  ReplayView replay;
  QString said;
  QObject::connect(&replay, &ReplayView::said, [&](const QString& words) { said = words; });
  replay.show(openWith("ball.wrl"), QString::fromStdString(folder.path()), {}, {});
  ASSERT_TRUE(QTest::qWaitFor([&] { return replay.view().plan().model != nullptr; }, 10'000)) << said.toStdString();
  EXPECT_EQ(replay.view().plan().model->parts.front().name, "mass1");
  replay.show(openWith("gone.wrl"), QString::fromStdString(folder.path()), {}, {});
  ASSERT_TRUE(QTest::qWaitFor([&] { return !said.isEmpty(); }, 10'000));
  EXPECT_EQ(replay.view().plan().model, nullptr) << "the usual shapes";
}

class InspectPage : public AtTheWindow {};

TEST_F(InspectPage, BelongsToTheWindowAndKeepsTheTrialsKeysOff) {
  analysis::recordRun(request_.place.data, {.experiment = "chain-moderate", .trials = 2});
  app::MainWindow& window = open();
  QTest::keyClick(&window, Qt::Key_3, Qt::AltModifier);
  EXPECT_TRUE(window.inspecting());
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.inspector().table().rowCount() == 2; }, 10000)) << "what this session records";
  QTest::keyClick(&window, Qt::Key_Space);
  EXPECT_EQ(window.session().run(), nullptr);
  QTest::keyClick(&window, Qt::Key_1, Qt::AltModifier);
  EXPECT_FALSE(window.inspecting());
  EXPECT_TRUE(window.view().isVisible());
  window.openExperiment(QString::fromStdString(request_.place.data));
  EXPECT_TRUE(window.inspecting()) << "a folder that is opened is looked at";
}

}  // namespace
}  // namespace reachlab::gui::inspector
