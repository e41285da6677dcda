#pragma once
#include <QColor>
#include <QString>

#include "gui/widgets/colours.h"

class QApplication;

namespace reachlab::gui::widgets {

QColor toQColor(const Colour& colour);

/// The colour, so opaque. [0, 255]
inline QColor withAlpha(QColor colour, int alpha) {
  colour.setAlpha(alpha);
  return colour;
}

/// The theme's ink for words and lines, so opaque. [0, 255]
inline QColor ink(int opacity) { return withAlpha(toQColor(colours::kText), opacity); }

/// The theme's ink for faults, and a field with a fault in that ink.
inline QColor faultInk() { return toQColor(colours::kBadText); }
inline QString faultyField() { return QStringLiteral("color: %1; border: 1px solid #c0564a;").arg(faultInk().name()); }

/// Palette and style of the whole program. Numbers have a decimal point and no group marks in every locale, as in the files.
void applyTheme(QApplication& application);

}  // namespace reachlab::gui::widgets
