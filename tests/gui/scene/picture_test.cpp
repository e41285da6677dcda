// What the scene's picture promises to an eye: everything in the frame, below the words, and told by more than colour.
#include <gtest/gtest.h>

#include <QTest>
#include <algorithm>
#include <map>

#include "gui/scene/scene_actors.h"
#include "gui/scene/scene_overlay.h"
#include "gui/scene/scene_view.h"
#include "gui/scene/trial_texts.h"
#include "gui/widgets/theme.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/resources.h"
#include "tests/gui/eyes.h"

namespace reachlab::gui::scene {
namespace {

QImage lampPicture(trial::Semaphore semaphore) {
  QWidget page;
  page.resize(200, 120);
  QPalette palette;
  palette.setColor(QPalette::Window, widgets::toQColor(widgets::colours::kSkyTop));
  page.setPalette(palette);
  SceneOverlay overlay(&page);
  overlay.setGeometry(page.rect());
  OverlayState state;
  state.semaphore = semaphore;
  state.rulersShown = false;
  overlay.setState(state);
  return page.grab().toImage().convertToFormat(QImage::Format_RGB32);
}

// Of the lamp's square in the top left: the commonest ink.
QColor lampInk(const QImage& picture) {
  std::map<QRgb, int> inks;
  for (int y = 18; y < 76; ++y)
    for (int x = 20; x < 78; ++x) ++inks[picture.pixel(x, y)];
  return QColor(std::max_element(inks.begin(), inks.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->first);
}

TEST(Semaphore, IsToldApartWithoutColour) {
  const QImage neutral = lampPicture(trial::Semaphore::Neutral), green = lampPicture(trial::Semaphore::Green),
               red = lampPicture(trial::Semaphore::Red);
  const Light greenLight = lightOf(lampInk(green)), redLight = lightOf(lampInk(red)), ground = lightOf(lampInk(neutral));
  for (const auto eye : kEyes) {
    EXPECT_GE(contrast(eye(greenLight), eye(redLight)), 3);
    EXPECT_GE(contrast(eye(greenLight), eye(ground)), 3) << "before its time the lamp is empty";
  }
  // The sign in the lamp: other pixels, in an ink that stands out from the lamp's.
  int sign = 0;
  for (int y = 22; y < 72; ++y)
    for (int x = 24; x < 74; ++x)
      sign += contrast(lightOf(QColor(red.pixel(x, y))), redLight) >= 3 && contrast(lightOf(QColor(green.pixel(x, y))), greenLight) < 3;
  EXPECT_GE(sign, 100) << "the cross is not where the tick is";
}

TEST(Picture, EveryShippedExperimentIsInTheFrameWithItsHandAndBelowTheWords) {
  SceneView view;
  view.resize(900, 620);
  view.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&view));
  for (const std::string& name : experiment::shippedExperiments()) {
    const experiment::CompiledExperiment compiled = experiment::openExperiment(name);
    view.overlay().setState(restingOverlay(QString::fromStdString(name), true));
    const ScenePlan plan = planScene(compiled.experiment(), compiled.constraint());
    view.setPlan(plan);
    const double head = view.overlay().headHeight();
    EXPECT_GT(head, 90);
    for (const Vec3& place : {plan.start, plan.target, penEnd(plan.start, plan.handRadius), penEnd(plan.target, plan.handRadius)}) {
      const QPointF at = view.pixelOf(place);
      EXPECT_TRUE(QRectF(0, head, 900, 620 - head).contains(at)) << name << " at " << at.x() << ", " << at.y();
    }
  }
}

}  // namespace
}  // namespace reachlab::gui::scene
