#pragma once
#include <QColor>
#include <QString>

#include "sim/predict/predict.h"

namespace reachlab::gui::plot {

/// A criterion's colour in plot and list. It is legible on the theme's background and differs from the hand's and the object's colours.
QColor colourOf(predict::Criterion criterion);
/// "min. hand jerk" …
QString titleOf(predict::Criterion criterion);

}  // namespace reachlab::gui::plot
