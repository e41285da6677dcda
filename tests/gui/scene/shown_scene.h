#pragma once
#include <gtest/gtest.h>

#include <QTest>

#include "gui/scene/scene_view.h"

namespace reachlab::gui::scene {

/// A scene on the screen without words over it.
class ShownScene : public ::testing::Test {
 protected:
  ShownScene(int width, int height) {
    view_.resize(width, height);
    view_.overlay().hide();
    view_.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&view_));
  }
  QImage picture() { return view_.grabScene().convertToFormat(QImage::Format_RGB32); }
  SceneView view_;
};

}  // namespace reachlab::gui::scene
