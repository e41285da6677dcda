#pragma once
#include <QColor>
#include <QString>

#include "sim/predict/predict.h"

namespace reachlab::gui::plot {

/// A criterion's colour in plot and list: legible on the theme's ground, and none like the hand's or the object's.
QColor colourOf(predict::Criterion criterion);
/// "min. hand jerk" …
QString titleOf(predict::Criterion criterion);

}  // namespace reachlab::gui::plot
