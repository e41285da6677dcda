// What helps an eye, where the experiment asks for it.
#include <gtest/gtest.h>

#include <QDir>
#include <QTemporaryDir>
#include <QTest>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include "gui/app/frame_recorder.h"
#include "gui/plot/criterion_style.h"
#include "gui/scene/cue_actors.h"
#include "gui/scene_plan/late_cursor.h"
#include "gui/widgets/colours.h"
#include "gui/widgets/theme.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/scene_look.h"
#include "tests/gui/eyes.h"
#include "tests/gui/scene/shown_scene.h"

namespace reachlab::gui::scene {
namespace {

ScenePlan planWith(const experiment::SceneLook& look, const char* shipped = "chain-moderate") {
  const experiment::CompiledExperiment compiled = experiment::openExperiment(shipped);
  return planScene(experiment::withLook(compiled.experiment(), look), compiled.constraint());
}

int differing(const QImage& a, const QImage& b) {
  int count = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
      count += std::abs(qRed(p) - qRed(q)) + std::abs(qGreen(p) - qGreen(q)) + std::abs(qBlue(p) - qBlue(q)) > 30;
    }
  return count;
}

class Looks : public ShownScene {
 protected:
  Looks() : ShownScene(600, 450) {}
  QImage picture(const ScenePlan& plan, const SceneFrame* frame = nullptr) {
    view_.setPlan(plan);
    if (frame != nullptr) view_.showFrame(*frame);
    return ShownScene::picture();
  }
};

TEST_F(Looks, GridShadowArrowAndColoursAreSeen) {
  experiment::SceneLook look;
  look.depthCue = "none";
  const QImage plain = picture(planWith(look));
  look.depthCue = "grid";
  const QImage grid = picture(planWith(look));
  EXPECT_GT(differing(plain, grid), 300);
  look.depthCue = "shadow";
  EXPECT_GT(differing(grid, picture(planWith(look))), 20);
  look = {};
  look.colours["background_top"] = look.colours["background_bottom"] = "#ffffff";
  EXPECT_GT(qGray(picture(planWith(look)).pixel(5, 5)), 240);
  look = {};
  look.forceArrow = true;
  const ScenePlan plan = planWith(look);
  SceneFrame frame = restingFrame(plan);
  const QImage without = picture(plan, &frame);
  frame.force = {0, 6, 0};
  EXPECT_GT(differing(without, picture(plan, &frame)), 100) << "6 N, three tenths of the reach";
}

// In a scene without colours red is the left eye's picture and blue the right one's.
TEST_F(Looks, StereoShowsEachEyeAPictureOfItsOwn) {
  experiment::SceneLook look;
  look.depthCue = "grid";
  for (const char* part : {"background_top", "background_bottom"}) look.colours[part] = "#202020";
  for (const char* part : {"rail", "surface", "surface_line", "start", "target", "driven", "middle", "last", "hand", "spring", "coupling"})
    look.colours[part] = "#d0d0d0";
  const ScenePlan plan = planWith(look, "torus");
  const auto coloured = [](const QImage& image) {
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) count += std::abs(qRed(image.pixel(x, y)) - qBlue(image.pixel(x, y))) > 40;
    return count;
  };
  const int flat = coloured(picture(plan));
  view_.setStereo(true);
  EXPECT_GT(coloured(picture(plan)), flat + 500);
  view_.setStereo(false);
  EXPECT_EQ(coloured(picture(plan)), flat);
}

TEST(Trace, IsOfOneTrialAndItsMemoryIsBounded) {
  vtkNew<vtkRenderer> renderer;
  experiment::SceneLook look;
  look.trace = true;
  const ScenePlan plan = planWith(look);
  CueActors cues(*renderer, plan);
  SceneFrame frame = restingFrame(plan);
  frame.trial = 1;
  cues.show(frame);
  EXPECT_EQ(cues.tracePointCount(), 0) << "waiting is no way";
  frame.traced = true;
  for (int i = 0; i < 3 * CueActors::kTracePoints; ++i) {
    ownHand(frame).x = (i % 2 == 0 ? 0.01 : 0.02) * plan.unit;
    cues.show(frame);
  }
  EXPECT_GT(cues.tracePointCount(), CueActors::kTracePoints / 3);
  EXPECT_LE(cues.tracePointCount(), CueActors::kTracePoints);
  frame.trial = 2;
  cues.show(frame);
  EXPECT_LE(cues.tracePointCount(), 1);
}

// A subject who saw pen, shadow or trace of the hand would see the rotation.
TEST_F(Looks, TheSubjectsPictureOfABareHandHasTheCursorAndNothingOfTheHand) {
  experiment::SceneLook look;
  look.depthCue = "shadow";
  look.trace = look.forceArrow = true;
  experiment::Experiment bare = experiment::withLook(experiment::readExperiment("centre-out"), look);
  bare.cursor.emplace().show = experiment::CursorShow::MovementEnd;
  const experiment::CompiledExperiment compiled(bare);
  const ScenePlan experimenters = planScene(compiled.experiment(), compiled.constraint());
  const ScenePlan subjects = subjectsPlan(experimenters, {.masses = false});
  SceneFrame hand = restingFrame(subjects);
  hand.traced = true;
  hand.force = {0, 0, 3};
  ownHand(hand) = {0, 0, -0.05};
  SceneFrame elsewhere = hand;
  ownHand(elsewhere) = {0.03, 0.01, -0.02};
  EXPECT_EQ(differing(picture(subjects, &hand), picture(subjects, &elsewhere)), 0);
  EXPECT_GT(differing(picture(experimenters, &hand), picture(experimenters, &elsewhere)), 300) << "the experimenter sees both";
  SceneFrame cursor = hand;
  cursor.masses[0] = {-0.025, 0, -0.043};
  EXPECT_GT(differing(picture(subjects, &hand), picture(subjects, &cursor)), 100);
  EXPECT_GT(differing(picture(experimenters, &hand), picture(experimenters, &cursor)), 100);
  SceneFrame hidden = hand, hiddenElsewhere = cursor;
  hidden.cursorShown = hiddenElsewhere.cursorShown = false;
  EXPECT_GT(differing(picture(subjects, &hand), picture(subjects, &hidden)), 100);
  EXPECT_EQ(differing(picture(subjects, &hidden), picture(subjects, &hiddenElsewhere)), 0) << "no shadow and no trace tells where it is";
  EXPECT_TRUE(isCursorShown(subjects, trial::Phase::Waiting));
  EXPECT_FALSE(isCursorShown(subjects, trial::Phase::Armed));
  EXPECT_FALSE(isCursorShown(subjects, trial::Phase::Moving));
  EXPECT_TRUE(isCursorShown(subjects, trial::Phase::Done));
  EXPECT_TRUE(isCursorShown(experimenters, trial::Phase::Moving));
}

TEST(LateCursor, IsWhereTheCursorWasADelayBefore) {
  LateCursor late;
  const auto place = [](double seconds) {
    return Vec3{0.3 * seconds, 0, -0.2 * seconds};
  };  // at constant speed lines between states are exact
  for (const std::uint64_t tick : {100, 133, 150, 201, 260, 290, 390}) {
    const double seconds = 0.001 * static_cast<double>(tick), shown = std::max(seconds - 0.12, 0.1);
    EXPECT_NEAR(norm(late.at(tick, place(seconds), 0.12) - place(shown)), 0, 1e-12) << tick;
  }
  EXPECT_EQ(late.at(390, place(0.39), 0), place(0.39)) << "without a delay it is where it is";
  EXPECT_EQ(late.at(5, {1, 2, 3}, 0.12), (Vec3{1, 2, 3})) << "another run knows nothing of the run before";
}

TEST_F(Looks, PicturesOfAFilmHaveOneEvenSize) {
  view_.setPlan(planWith({}));
  view_.resize(601, 451);
  const QTemporaryDir folder;
  app::FrameRecorder recorder(view_, nullptr);
  QString ended;
  int taken = 0;
  QObject::connect(&recorder, &app::FrameRecorder::ended, [&](const QString& words) { ended = words; });
  QObject::connect(&recorder, &app::FrameRecorder::progressed, [&](int, int) {
    if (++taken == 2) view_.resize(640, 420);
  });
  recorder.start(folder.path());
  ASSERT_TRUE(QTest::qWaitFor([&] { return taken >= 4; }, 20'000));
  recorder.stop();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !ended.isEmpty(); }, 20'000));
  const QStringList files = QDir(folder.path()).entryList({QStringLiteral("frame-*.png")});
  ASSERT_GE(files.size(), 4);
  for (const QString& file : files) EXPECT_EQ(QImage(folder.filePath(file)).size(), QSize(600, 450)) << file.toStdString();
}

TEST(LightTheme, KeepsItsContrast) {
  using namespace widgets;
  const auto apart = [](const Colour& a, const Colour& b) { return contrast(lightOf(toQColor(a)), lightOf(toQColor(b))); };
  for (const Theme theme : {Theme::Dark, Theme::Light}) {
    setTheme(theme);
    for (const Colour& ground : {colours::kWindow, colours::kBase, colours::kSkyTop}) {
      EXPECT_GE(apart(colours::kText, ground), 7);
      EXPECT_GE(apart(colours::kFaintText, ground), 4.5);
    }
    for (const Colour& part : {colours::kDriven, colours::kLast, colours::kHand, colours::kRail, colours::kTarget})
      EXPECT_GE(apart(part, colours::kSkyTop), 3) << static_cast<int>(theme) << ": " << part.red << " " << part.green;
    for (int i = 0; i < predict::kCriterionCount; ++i) {  // lines of a plot, and words of a list
      const QColor ink = plot::colourOf(static_cast<predict::Criterion>(i));
      EXPECT_GE(contrast(lightOf(ink), lightOf(toQColor(colours::kBase))), 4.5) << static_cast<int>(theme) << ": criterion " << i;
    }
  }
  setTheme(Theme::Dark);
}

}  // namespace
}  // namespace reachlab::gui::scene
