#include "gui/app/experiment_files.h"

#include <QAction>
#include <QDir>
#include <QDockWidget>
#include <QDropEvent>
#include <QFileInfo>
#include <QLineEdit>
#include <QMimeData>
#include <QUrl>

#include "sim/dynamics/scene.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/scene_look.h"
#include "tests/gui/at_the_window.h"
#include "tests/refusal.h"

namespace reachlab::gui::app {
namespace {

TEST(Templates, EachIsAnExperimentThatCanBeRunUnderANameOfItsOwn) {
  for (const Template& from : kTemplates) {
    const experiment::CompiledExperiment made = newExperiment(from);
    EXPECT_EQ(made.experiment().name, "untitled") << from.title;
    EXPECT_NO_THROW((void)dynamics::compileScene(made)) << from.title;
    EXPECT_EQ(experiment::parseExperiment(made.experiment().text, "text").object.masses, made.experiment().object.masses);
  }
}

TEST(RecentFiles, AreTheNewestThatAreStillThere) {
  const QTemporaryDir folder;
  const auto file = [&](int number) {
    const QString path = folder.filePath(QStringLiteral("%1.json").arg(number));
    std::ofstream(path.toStdString()) << "{}";
    return path;
  };
  for (int i = 0; i < 10; ++i) rememberFile(file(i));
  rememberFile(file(5));
  const QStringList recent = recentFiles();
  EXPECT_EQ(recent.size(), 8);
  EXPECT_EQ(QFileInfo(recent[0]).fileName(), "5.json");
  EXPECT_EQ(QFileInfo(recent[1]).fileName(), "9.json");
  EXPECT_EQ(recent.count(recent[0]), 1);
  QFile::remove(recent[1]);
  EXPECT_EQ(recentFiles().size(), 7);
}

TEST(ManualPage, IsThereInTheSources) { EXPECT_TRUE(QFileInfo::exists(manualPage())) << manualPage().toStdString(); }

TEST(WritingAnExperiment, ThatCannotBeWrittenIsAFaultWithTheFilesName) {
  const experiment::Experiment e = experiment::openExperiment("ellipse").experiment();
  EXPECT_NE(refusalOf([&] { writeExperiment(e, "/dev/null/e.json"); }).find("/dev/null/e.json"), std::string::npos);
}

class Files : public AtTheWindow {
 protected:
  Files() {
    path_ = folder_.filePath("mine.json");
    writeExperiment(experiment::openExperiment("ellipse").experiment(), path_);
    request_.what = path_.toStdString();
  }
  void changeMasses(const char* to) {
    auto* masses = window_->findChild<QLineEdit*>("masses");
    masses->setText(QLatin1String(to));
    Q_EMIT masses->editingFinished();
  }

  QString path_;
};

TEST_F(Files, ASavedChangeIsInTheFileAndTheStarGoes) {
  MainWindow& window = open();
  changeMasses("2.5");
  EXPECT_TRUE(window.isWindowModified());
  QTest::keyClick(&window, Qt::Key_S, Qt::ControlModifier);
  EXPECT_FALSE(window.isWindowModified());
  EXPECT_EQ(experiment::openExperiment(path_.toStdString()).experiment().object.masses, (std::vector<double>{2.5}));
  window.edits().undo();
  EXPECT_TRUE(window.isWindowModified()) << "the file holds what was undone";
  window.edits().redo();
  EXPECT_FALSE(window.isWindowModified());
}

TEST_F(Files, ASavedChangeKeepsTheDescription) {
  request_.what = write("told.json", experiment::openExperiment("torus").experiment().text);
  open();
  changeMasses("2.5");
  QTest::keyClick(window_.get(), Qt::Key_S, Qt::ControlModifier);
  const experiment::Experiment saved = experiment::openExperiment(request_.what).experiment();
  EXPECT_EQ(saved.object.masses, (std::vector<double>{2.5}));
  EXPECT_NE(saved.text.find("One mass on a torus"), std::string::npos) << saved.text;
}

// A key or a button elsewhere takes no focus from the field.
TEST_F(Files, WhatIsBeingTypedIsSavedAndRunToo) {
  MainWindow& window = open();
  window.activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
  auto* masses = window.findChild<QLineEdit*>("masses");
  type(masses, "2.5", false);
  QTest::keyClick(&window, Qt::Key_S, Qt::ControlModifier);
  EXPECT_EQ(experiment::openExperiment(path_.toStdString()).experiment().object.masses, (std::vector<double>{2.5}));
  type(masses, "3.5", false);
  ASSERT_TRUE(startsTrial());
  EXPECT_EQ(window.session().run()->experimentNow().experiment().object.masses, (std::vector<double>{3.5}));
}

// The experiment that is brought back is saved in its own file.
TEST_F(Files, UndoTakesTheFileBackWithItsExperiment) {
  MainWindow& window = open();
  const QString other = folder_.filePath("other.json");
  writeExperiment(experiment::openExperiment("torus").experiment(), other);
  window.openExperiment(other);
  window.edits().undo();
  changeMasses("2.5");
  QTest::keyClick(&window, Qt::Key_S, Qt::ControlModifier);
  EXPECT_EQ(experiment::openExperiment(other.toStdString()).experiment().constraint.name, "torus");
  EXPECT_EQ(experiment::openExperiment(path_.toStdString()).experiment().object.masses, (std::vector<double>{2.5}));
}

TEST_F(Files, UndoTakesTheSceneFileBackToo) {
  write("ball.wrl", "#VRML V2.0 utf8\nDEF mass1 Shape { geometry Sphere { radius 0.02 } }\n");
  experiment::SceneLook look;
  look.sceneFile = "ball.wrl";
  request_.what = write("ball.json", experiment::withLook(experiment::openExperiment("dingwell").experiment(), look).text);
  MainWindow& window = open();
  const auto isDrawn = [&] { return window.view().plan().model != nullptr; };
  ASSERT_TRUE(QTest::qWaitFor(isDrawn, 10'000)) << window.message().toStdString();
  QDir(folder_.path()).mkdir("elsewhere");
  const QString other = folder_.filePath("elsewhere/mine.json");
  writeExperiment(experiment::openExperiment("ellipse").experiment(), other);
  window.openExperiment(other);
  EXPECT_FALSE(isDrawn());
  window.edits().undo();
  EXPECT_TRUE(QTest::qWaitFor(isDrawn, 10'000)) << window.message().toStdString();
}

TEST_F(Files, ADroppedFileIsOpenedAndRemembered) {
  request_.what = "chain-moderate";
  MainWindow& window = open();
  QMimeData mime;
  mime.setUrls({QUrl::fromLocalFile(path_)});
  QDragEnterEvent enter({10, 10}, Qt::CopyAction, &mime, Qt::LeftButton, {});
  QApplication::sendEvent(&window, &enter);
  EXPECT_TRUE(enter.isAccepted());
  QDropEvent drop(QPointF(10, 10), Qt::CopyAction, &mime, Qt::LeftButton, {});
  QApplication::sendEvent(&window, &drop);
  EXPECT_EQ(window.session().experiment().constraint.name, "ellipse");
  EXPECT_EQ(recentFiles().front(), QFileInfo(path_).absoluteFilePath());
}

TEST_F(Files, ARecordingIsInspectedAndWhatIsWrongWithItIsSaid) {
  MainWindow& window = open();
  window.openExperiment(QString::fromStdString(write("sub-01_log.reach", "RCHLOG")));
  EXPECT_TRUE(window.inspecting());
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.message().contains("sub-01_log.reach"); }, 5000));
  EXPECT_EQ(window.session().experiment().name, "ellipse");
}

TEST_F(Files, OnThePageInspectNothingIsUndoneAndAnOpenedExperimentShowsItsPage) {
  MainWindow& window = open();
  changeMasses("2.5");
  auto* undo = find<QAction>("undo");
  EXPECT_TRUE(undo->isEnabled());
  QTest::keyClick(&window, Qt::Key_3, Qt::AltModifier);
  ASSERT_TRUE(window.inspecting());
  EXPECT_FALSE(undo->isEnabled());
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(window.session().experiment().object.masses, (std::vector<double>{2.5}));
  window.edits().setClean();
  window.openExperiment("torus");
  EXPECT_FALSE(window.inspecting());
  EXPECT_TRUE(undo->isEnabled());
}

TEST_F(Files, ALayoutIsFoundAgainAsItWasLeft) {
  MainWindow& window = open();
  const auto shown = [&](const char* name) { return window.findChild<QDockWidget*>(QLatin1String(name))->isVisible(); };
  QTest::keyClick(&window, Qt::Key_2, Qt::AltModifier);
  EXPECT_TRUE(shown("sessionDock") && shown("plotDock"));
  EXPECT_FALSE(shown("objectDock") || shown("taskDock"));
  window.findChild<QDockWidget*>("taskDock")->show();
  QTest::keyClick(&window, Qt::Key_1, Qt::AltModifier);
  EXPECT_TRUE(shown("objectDock"));
  QTest::keyClick(&window, Qt::Key_2, Qt::AltModifier);
  EXPECT_TRUE(shown("taskDock"));
  EXPECT_FALSE(shown("objectDock"));
  window.resetLayout();
  EXPECT_TRUE(shown("objectDock"));
}

}  // namespace
}  // namespace reachlab::gui::app
