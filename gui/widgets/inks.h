#pragma once
#include <QColor>

#include "gui/widgets/theme.h"

namespace reachlab::gui::widgets {

/// The theme's ink for words and lines, so opaque. [0, 255]
inline QColor ink(int opacity) {
  QColor colour = toQColor(colours::kText);
  colour.setAlpha(opacity);
  return colour;
}

}  // namespace reachlab::gui::widgets
