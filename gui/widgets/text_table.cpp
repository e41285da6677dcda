#include "gui/widgets/text_table.h"

#include <QHeaderView>
#include <QTableWidget>

#include "gui/widgets/named.h"

namespace reachlab::gui::widgets {

QTableWidget* makeTextTable(const char* name, const QStringList& headings, int rowHeight) {
  auto* table = named<QTableWidget>(name, 0, headings.size());
  table->setHorizontalHeaderLabels(headings);
  table->verticalHeader()->hide();
  table->verticalHeader()->setDefaultSectionSize(rowHeight);
  table->setSelectionMode(QAbstractItemView::NoSelection);
  table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table->setShowGrid(false);
  table->setTabKeyNavigation(false);  // Tab goes on to the next field
  table->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  return table;
}

void setTexts(QTableWidget& table, int row, const QStringList& texts) {
  for (int column = 0; column < texts.size(); ++column) {
    if (table.item(row, column) == nullptr) table.setItem(row, column, new QTableWidgetItem);
    table.item(row, column)->setText(texts[column]);
  }
}

}  // namespace reachlab::gui::widgets
