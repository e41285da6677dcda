// View > Look of the scene: every entry reaches the experiment and the picture, and can be undone.
#include <gtest/gtest.h>

#include <QAction>
#include <QMenu>
#include <QSlider>
#include <QUndoStack>
#include <cmath>

#include "gui/scene/scene_view.h"
#include "gui/scene_plan/scene_plan.h"
#include "sim/experiment/scene_look.h"
#include "tests/gui/at_the_window.h"

namespace reachlab::gui::app {
namespace {

class LookMenu : public AtTheWindow {
 protected:
  LookMenu() { request_.what = "torus"; }
};

TEST_F(LookMenu, EveryEntryChangesTheLookAndUndoTakesItBack) {
  MainWindow& window = open();
  for (const char* entry : {"depth_grid", "depth_shadow", "depth_none", "lookTrace", "lookArrow"}) {
    const experiment::SceneLook before = window.look();
    const int steps = window.edits().index();
    find<QAction>(entry)->trigger();
    EXPECT_FALSE(window.look() == before) << entry;
    EXPECT_EQ(window.edits().index(), steps + 1) << entry;
    window.edits().undo();
    EXPECT_TRUE(window.look() == before) << entry;
    window.edits().redo();
  }
}

TEST_F(LookMenu, OpacityIsSeenInThePicture) {
  MainWindow& window = open();
  const double before = window.view().plan().look.surfaceOpacity;
  auto* slider = find<QSlider>("surfaceOpacity");
  slider->setValue(90);
  Q_EMIT slider->sliderReleased();
  EXPECT_NEAR(window.view().plan().look.surfaceOpacity, 0.9, 1e-12);
  EXPECT_GT(std::abs(before - 0.9), 0.1);
}

}  // namespace
}  // namespace reachlab::gui::app
