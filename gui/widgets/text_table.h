#pragma once
#include <QStringList>

class QTableWidget;

namespace reachlab::gui::widgets {

/// A table of texts that the user neither edits nor chooses, without a grid and row numbers. Its columns are as wide as their content.
/// `name`: its object name.
QTableWidget* makeTextTable(const char* name, const QStringList& headings, int rowHeight);
/// Writes the texts of a row, from its first column on.
void setTexts(QTableWidget& table, int row, const QStringList& texts);

}  // namespace reachlab::gui::widgets
