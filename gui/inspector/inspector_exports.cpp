// InspectorPage: what is taken away: figures, lines, the table, the report.
#include <QComboBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QPushButton>

#include "base/fault.h"
#include "base/system/error_report.h"
#include "gui/inspector/epsilon_panel.h"
#include "gui/inspector/inspector.h"
#include "gui/inspector/analysis_lines.h"
#include "sim/record/log/atomic_file.h"

namespace reachlab::gui::inspector {

void InspectorPage::exportTo(const QString& file) {
  if (!inspection_ || inspection_->input.trials.empty()) throw FaultError(Fault{"trials", "none is chosen", "rows of the table"});
  if (QFileInfo(file).suffix().toLower() == QLatin1String("csv")) {
    record::writeFileAtomically(file.toStdString(), linesCsv(*inspection_));
    return;
  }
  const TimeAxis axis = axis_->currentIndex() == 0 ? TimeAxis::AsMoved : TimeAxis::Scaled;
  const std::string name = file.toStdString();
  record::writeFileAtomically(name, figure::renderFor(name, figureOf(*inspection_, condition(), axis, epsilons_->chosen())));
}

void InspectorPage::exportTable(const QString& file) {
  std::vector<int> rows;
  for (int row = 0; row < filter_->rowCount(); ++row) rows.push_back(filter_->mapToSource(filter_->index(row, 0)).row());
  record::writeFileAtomically(file.toStdString(), toCsv(*table_, rows));
}

void InspectorPage::saveFigure() {
  const QString file =
      QFileDialog::getSaveFileName(this, tr("Export figure or lines"), QStringLiteral("trials.svg"),
                                   tr("Figure as SVG (*.svg);;Figure as PDF (*.pdf);;Figure as PNG (*.png);;Lines as CSV (*.csv)"));
  if (file.isEmpty()) return;
  try {
    exportTo(file);
    Q_EMIT told(tr("Written: %1").arg(file));
  } catch (const std::exception& e) {
    Q_EMIT said(QString::fromStdString(errorReportOf(e).sentence));
  }
}

void InspectorPage::saveTable() {
  QString file = QFileDialog::getSaveFileName(this, tr("Export table"), QStringLiteral("trials.csv"), tr("CSV (*.csv)"));
  if (file.isEmpty()) return;
  if (QFileInfo(file).suffix().isEmpty()) file += QStringLiteral(".csv");
  try {
    exportTable(file);
    Q_EMIT told(tr("Written: %1").arg(file));
  } catch (const std::exception& e) {
    Q_EMIT said(QString::fromStdString(errorReportOf(e).sentence));
  }
}

void InspectorPage::openReport() {
  report_->setEnabled(false);
  inspector_.report(path_);
}

}  // namespace reachlab::gui::inspector
