#pragma once
#include <QImage>

#include "gui/scene_plan/scene_plan.h"

namespace reachlab::gui::scene {

/// A small line drawing of a constraint, with start and target. QPainter draws it, so that a list of fifty is fast and needs no graphics
/// driver.
QImage drawThumbnail(const ScenePlan& plan, const QSize& size, double pixelRatio = 1);

}  // namespace reachlab::gui::scene
