#pragma once
#include <QColor>
#include <QString>
#include <vector>

#include "gui/plot/line_style.h"
#include "sim/predict/predict.h"

class QTableWidget;

namespace reachlab::gui::plot {

/// A criterion's colour in plot and list. It is legible on the theme's background and differs from the hand's and the object's colours.
QColor colourOf(predict::Criterion criterion);
LineStyle styleOf(predict::Criterion criterion);
/// "min. hand jerk" …
QString titleOf(predict::Criterion criterion);

/// A table with a row for each criterion: its title, which is ticked if it is in `chosen`, and cells for numbers.
QTableWidget* makeCriteriaTable(const char* name, const QStringList& columns, const std::vector<predict::Criterion>& chosen, int rowHeight);
std::vector<predict::Criterion> chosenIn(const QTableWidget& table);

}  // namespace reachlab::gui::plot
