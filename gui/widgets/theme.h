#pragma once
#include <QColor>

#include "gui/widgets/colours.h"

class QApplication;

namespace reachlab::gui::widgets {

QColor toQColor(const Colour& colour);
/// Dark palette and style of the whole program. Numbers have a decimal point and no group marks in every locale, as in the files.
void applyTheme(QApplication& application);

}  // namespace reachlab::gui::widgets
