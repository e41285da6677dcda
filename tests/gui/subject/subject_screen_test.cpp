// What the subject's screen shows is the experiment's, and its words are the subject's.
#include <gtest/gtest.h>

#include <QAction>
#include <QLabel>
#include <QPointer>
#include <cmath>
#include <fstream>
#include <functional>
#include <memory>

#include "base/math/minimum_jerk.h"
#include "gui/app/screens.h"
#include "gui/scene/scene_overlay.h"
#include "gui/scene/scene_view.h"
#include "gui/subject/subject_window.h"
#include "sim/experiment/experiment.h"
#include "sim/haptics/tick_engine.h"
#include "tests/bare_reach.h"
#include "tests/gui/at_the_window.h"

namespace reachlab::gui::subject {
namespace {

using Patch = SubjectWindow::Patch;

class SubjectsScreen : public AtTheWindow {
 protected:
  ~SubjectsScreen() override {
    if (window_) window_->setSubjectsLanguage(QStringLiteral("en"));
  }
  // chain-moderate with this screen, and whatever the machine misses.
  void showing(const std::string& screen) {
    std::string text = experiment::readExperiment("chain-moderate").text;
    const std::string at = "\"schema_version\": 1,";
    text.replace(text.find(at), at.size(),
                 at + " \"subject_screen\": " + screen + ", \"timing\": { \"max_missed_ticks\": 10000000, \"max_gap_s\": 7200 },");
    request_.what = write("seen.json", text);
    request_.device = "simulated:noise=0";
    request_.timingCheckSeconds = 0;
    request_.trials = 2;
  }
  SubjectWindow& screen() {
    if (SubjectWindow* found = subjectsScreen()) return *found;
    throw std::runtime_error("no subject's screen");
  }
  const scene::OverlayState& said() { return screen().view().overlay().state(); }
};

TEST_F(SubjectsScreen, ShowsWhatTheExperimentSaysAndNothingElse) {
  showing(R"({ "semaphore": false, "masses": false, "target": false, "words": false, "score": true, "photodiode": true })");
  open();
  window_->screens().toggleSubject();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&screen()));
  EXPECT_FALSE(said().semaphoreShown);
  EXPECT_TRUE(said().instruction.isEmpty()) << said().instruction.toStdString();
  EXPECT_TRUE(screen().view().plan().massRadius.empty());
  EXPECT_FALSE(screen().view().plan().targetShown);
  EXPECT_FALSE(window_->view().plan().massRadius.empty()) << "the experimenter sees everything";
  EXPECT_EQ(screen().patch(), Patch::Black);
  window_->nextTrial();
  ASSERT_TRUE(QTest::qWaitFor([&] { return screen().patch() == Patch::White; }, 30000));
  EXPECT_TRUE(window_->session().run()->latest().gone) << "not before the go signal";
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->session().lastTrial().has_value(); }, 30000));
  ASSERT_TRUE(QTest::qWaitFor([&] { return screen().patch() == Patch::Black; }, 5000)) << "and at the trial's end";
  const bool success = window_->session().lastTrial()->result.outcome == trial::Outcome::Success;
  EXPECT_EQ(said().counter, success ? QStringLiteral("1") : QStringLiteral("0"));
  auto* mirror = window_->findChild<QLabel*>(QStringLiteral("subjectMirror"));
  ASSERT_NE(mirror, nullptr);
  EXPECT_TRUE(QTest::qWaitFor([&] { return mirror->isVisible(); }, 5000)) << "small in the experimenter's corner";
}

TEST(SubjectsMonitor, IsTheChosenOneOrOneWithoutTheExperimentersWindow) {
  const QStringList two{QStringLiteral("A"), QStringLiteral("B")}, one{QStringLiteral("A")};
  EXPECT_EQ(screenFor({}, two, "A"), "B");
  EXPECT_EQ(screenFor({}, two, "B"), "A");
  EXPECT_EQ(screenFor("B", two, "B"), "B") << "it is chosen";
  EXPECT_EQ(screenFor("B", one, "A"), "A") << "there is no other";
}

TEST_F(SubjectsScreen, SpeaksTheSubjectsLanguageAndIsChangedWithTheExperiment) {
  showing("{}");
  open();
  window_->screens().toggleSubject();
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

// The engine's states of a reach along -z, without a clock: a busy machine draws fewer pictures, and they show the same.
class SubjectsCursor : public ::testing::Test {
 protected:
  static constexpr int kPictureTicks = 30;
  void use(const experiment::Cursor& cursor) {
    experiment::Experiment e = experiment::bareReach();
    e.cursor = cursor;
    const experiment::CompiledExperiment compiled(e);
    screens_.showExperiment(compiled, {});
    if (!subject_) screens_.toggleSubject();
    subject_ = subjectsScreen();
    engine_ = std::make_unique<haptics::TickEngine>(compiled, haptics::EngineOptions{});
  }
  ~SubjectsCursor() override { delete subject_; }
  Vec3 handAt(std::uint64_t tick) const {
    return {0, 0, moving_ == 0 || tick < moving_ ? 0.0 : -0.1 * heldMinimumJerk(static_cast<double>(tick - moving_) / 500).value};
  }
  // Until the trial is in that phase: its pictures, each after the state that it shows.
  void until(trial::Phase phase, const std::function<void()>& look) {
    for (int ticks = 0; engine_->state().phase != phase; ++ticks) {
      ASSERT_LT(ticks, 5000);
      haptics::TickInput input;
      input.devices[0].position = handAt(++tick_);
      input.command = tick_ == 1 ? trial::Command::NextTrial : trial::Command::None;
      engine_->step(input);
      engine_->limit(input);
      if (engine_->state().phase == trial::Phase::Armed && moving_ == 0) moving_ = tick_ + 100;
      if (tick_ % kPictureTicks != 0 || engine_->state().phase == phase) continue;
      screens_.showState(engine_->state());
      look();
    }
    screens_.showState(engine_->state());
  }
  scene::SceneFrame subjects() const { return subject_->view().frame(); }
  scene::SceneView view_;
  app::Screens screens_{view_};
  QPointer<SubjectWindow> subject_;
  std::unique_ptr<haptics::TickEngine> engine_;
  std::uint64_t tick_ = 0, moving_ = 0;
};

// The rotation is written out here: counterclockwise as seen from above, where right is x and up is -z.
TEST_F(SubjectsCursor, IsInPlaceOfTheHandAndLate) {
  use(experiment::Cursor{.rotation = 30, .clamp = {}, .delay = 0.15});
  EXPECT_FALSE(subject_->view().plan().handShown);
  EXPECT_TRUE(view_.plan().handShown);
  const auto cursorAt = [&](std::uint64_t tick) {
    const Vec3 hand = handAt(tick);
    return Vec3{0.5 * hand.z, 0, std::sqrt(3.0) / 2 * hand.z};
  };
  double furthest = 0;  // [m] from the picture to the cursor of now
  until(trial::Phase::Done, [&] {
    const Vec3 late = cursorAt(std::max<std::uint64_t>(tick_, 180) - 150), seen = subjects().masses.at(0);
    EXPECT_NEAR(norm(seen - late), 0, 1e-4) << "a tenth of a pixel is not drawn";
    EXPECT_NEAR(norm(view_.frame().masses.at(0) - late), 0, 1e-12) << "the experimenter sees what the subject sees";
    EXPECT_EQ(ownHand(view_.frame()), handAt(tick_)) << "and the hand";
    furthest = std::max(furthest, norm(cursorAt(tick_) - seen));
  });
  EXPECT_GT(furthest, 0.04) << "a hand at 0.37 m/s";
}

TEST_F(SubjectsCursor, IsHiddenDuringTheMovementOrAlways) {
  for (const auto show : {experiment::CursorShow::MovementEnd, experiment::CursorShow::Never}) {
    use(experiment::Cursor{.clamp = {}, .show = show});
    tick_ = moving_ = 0;
    const bool end = show == experiment::CursorShow::MovementEnd;
    EXPECT_EQ(subjects().cursorShown, end);
    until(trial::Phase::Armed, [&] { EXPECT_EQ(subjects().cursorShown, end) << "the way to the start"; });
    until(trial::Phase::Done, [&] {
      EXPECT_FALSE(subjects().cursorShown);
      EXPECT_TRUE(view_.frame().cursorShown) << "the experimenter sees it";
    });
    EXPECT_EQ(subjects().cursorShown, end) << "the trial has ended";
  }
}

}  // namespace
}  // namespace reachlab::gui::subject
