// What the subject's screen shows is the experiment's, and its words are the subject's.
#include <gtest/gtest.h>

#include <QAction>
#include <QLabel>
#include <fstream>

#include "gui/app/window_layout.h"
#include "gui/scene/scene_overlay.h"
#include "gui/scene/scene_view.h"
#include "gui/subject/subject_window.h"
#include "sim/experiment/experiment.h"
#include "tests/gui/at_the_window.h"

namespace reachlab::gui::subject {
namespace {

using Patch = SubjectWindow::Patch;

class SubjectsScreen : public AtTheWindow {
 protected:
  ~SubjectsScreen() override {
    if (window_) window_->setSubjectsLanguage(QStringLiteral("en"));
    app::forgetLayout();
  }
  // chain-moderate with this screen, and whatever the machine misses.
  void showing(const std::string& screen) {
    std::string text = experiment::readExperiment("chain-moderate").text;
    const std::string at = "\"schema_version\": 1,";
    text.replace(text.find(at), at.size(),
                 at + " \"subject_screen\": " + screen + ", \"timing\": { \"max_missed_ticks\": 10000000, \"max_gap_s\": 7200 },");
    request_.what = folder_.filePath(QStringLiteral("seen.json")).toStdString();
    std::ofstream(request_.what) << text;
    request_.device = "simulated:noise=0";
    request_.timingCheckSeconds = 0;
    request_.trials = 2;
  }
  SubjectWindow& screen() {
    for (QWidget* top : QApplication::topLevelWidgets())
      if (auto* found = qobject_cast<SubjectWindow*>(top)) return *found;
    throw std::runtime_error("no subject's screen");
  }
  const scene::OverlayState& said() { return screen().findChild<scene::SceneOverlay*>()->state(); }
};

TEST_F(SubjectsScreen, ShowsWhatTheExperimentSaysAndNothingElse) {
  showing(R"({ "semaphore": false, "masses": false, "target": false, "words": false, "score": true, "photodiode": true })");
  open();
  window_->toggleSubjectWindow();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&screen()));
  EXPECT_FALSE(said().semaphoreShown);
  EXPECT_TRUE(said().instruction.isEmpty()) << said().instruction.toStdString();
  EXPECT_TRUE(screen().view().plan().massRadius.empty());
  EXPECT_FALSE(screen().view().plan().targetShown);
  EXPECT_FALSE(window_->view().plan().massRadius.empty()) << "the experimenter sees everything";
  EXPECT_EQ(screen().patch(), Patch::Black);
  window_->nextTrial();
  ASSERT_TRUE(QTest::qWaitFor([&] { return screen().patch() == Patch::White; }, 30000)) << "at the go signal";
  const trial::Phase then = window_->session().run()->latest().phase;
  EXPECT_TRUE(then == trial::Phase::Armed || then == trial::Phase::Moving);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->session().lastTrial().has_value(); }, 30000));
  ASSERT_TRUE(QTest::qWaitFor([&] { return screen().patch() == Patch::Black; }, 5000)) << "and at the trial's end";
  const bool success = window_->session().lastTrial()->result.outcome == trial::Outcome::Success;
  EXPECT_EQ(said().counter, success ? QStringLiteral("1") : QStringLiteral("0"));
  auto* mirror = window_->findChild<QLabel*>(QStringLiteral("subjectMirror"));
  ASSERT_NE(mirror, nullptr);
  EXPECT_TRUE(QTest::qWaitFor([&] { return mirror->isVisible(); }, 5000)) << "small in the experimenter's corner";
}

TEST_F(SubjectsScreen, SpeaksTheSubjectsLanguageAndIsChangedWithTheExperiment) {
  showing("{}");
  open();
  window_->toggleSubjectWindow();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&screen()));
  EXPECT_EQ(said().instruction, QStringLiteral("Please wait"));
  EXPECT_EQ(screen().patch(), Patch::None);
  find<QAction>("language_ru")->trigger();
  EXPECT_EQ(said().instruction, QStringLiteral("Пожалуйста, подождите"));
  find<QAction>("subject Square for a light sensor")->trigger();
  EXPECT_TRUE(window_->session().experiment().subjectScreen.photodiode);
  EXPECT_NE(window_->session().experiment().text.find("photodiode"), std::string::npos) << "and goes into the recording";
  EXPECT_EQ(screen().patch(), Patch::Black);
  window_->edits().undo();
  EXPECT_FALSE(window_->session().experiment().subjectScreen.photodiode);
  EXPECT_EQ(screen().patch(), Patch::None);
}

}  // namespace
}  // namespace reachlab::gui::subject
