#include "gui/plot/criterion_style.h"

#include <QHeaderView>
#include <QTableWidget>
#include <algorithm>

#include "analysis/report/figures.h"
#include "gui/widgets/text_table.h"
#include "gui/widgets/colours.h"

namespace reachlab::gui::plot {

QColor colourOf(predict::Criterion criterion) {
  const analysis::CriterionLook look = analysis::lookOf({criterion});
  const auto& [red, green, blue] = widgets::theme() == widgets::Theme::Light ? look.onLight : look.onDark;
  return {red, green, blue};
}

LineStyle styleOf(predict::Criterion criterion) {
  static const std::vector<std::vector<double>> kDashes{{5, 3}, {2, 2}, {9, 3}, {7, 2, 2, 2}, {7, 2, 2, 2, 2, 2}, {3, 4}, {12, 2, 4, 2}};
  const auto i = static_cast<std::size_t>(criterion);
  return {colourOf(criterion), kDashes[i % kDashes.size()], static_cast<int>(i)};
}

QString titleOf(predict::Criterion criterion) {
  const std::string_view name = predict::nameOf(criterion);
  QString title = QString::fromUtf8(name.data(), static_cast<int>(name.size()));
  return title.replace(QStringLiteral("min-"), QStringLiteral("min. ")).replace(QLatin1Char('-'), QLatin1Char(' '));
}

QTableWidget* makeCriteriaTable(const char* name, const QStringList& columns, const std::vector<predict::Criterion>& chosen,
                                int rowHeight) {
  QTableWidget* table = widgets::makeTextTable(name, columns, rowHeight);
  table->setRowCount(predict::kCriterionCount);
  table->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  for (int i = 0; i < predict::kCriterionCount; ++i) {
    const auto criterion = static_cast<predict::Criterion>(i);
    auto* title = new QTableWidgetItem(titleOf(criterion));
    title->setFlags(Qt::ItemIsEnabled | Qt::ItemIsUserCheckable);
    title->setCheckState(std::find(chosen.begin(), chosen.end(), criterion) != chosen.end() ? Qt::Checked : Qt::Unchecked);
    title->setForeground(colourOf(criterion));
    table->setItem(i, 0, title);
    for (int column = 1; column < columns.size(); ++column) {
      auto* number = new QTableWidgetItem;
      number->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      table->setItem(i, column, number);
    }
  }
  return table;
}

std::vector<predict::Criterion> chosenIn(const QTableWidget& table) {
  std::vector<predict::Criterion> criteria;
  for (int i = 0; i < predict::kCriterionCount; ++i)
    if (table.item(i, 0)->checkState() == Qt::Checked) criteria.push_back(static_cast<predict::Criterion>(i));
  return criteria;
}

}  // namespace reachlab::gui::plot
