#pragma once
#include <QImage>

#include "gui/scene_plan/scene_plan.h"

namespace reachlab::gui::scene {

/// A small line drawing of a constraint, with start and target: by QPainter, so that a list of fifty is there at once and needs no
/// graphics driver.
QImage drawThumbnail(const ScenePlan& plan, const QSize& size, double pixelRatio = 1);

}  // namespace reachlab::gui::scene
