// InspectorPage: the row at the top, and the right half.
#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QProgressBar>
#include <QPushButton>
#include <QSplitter>
#include <QToolButton>
#include <QVBoxLayout>

#include "gui/inspector/epsilon_panel.h"
#include "gui/inspector/inspector.h"
#include "gui/inspector/profile_plot.h"
#include "gui/inspector/replay_view.h"
#include "gui/widgets/elided_label.h"
#include "gui/widgets/named.h"

namespace reachlab::gui::inspector {

void InspectorPage::addTop(QVBoxLayout& layout) {
  auto* top = new QHBoxLayout;
  auto* openButton = widgets::named<QToolButton>("inspectorOpen");
  openButton->setText(tr("Open"));
  openButton->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(openButton);
  menu->addAction(tr("Dataset…"), this, [this] {
    const QString folder = QFileDialog::getExistingDirectory(this, tr("Open a dataset or a session"), path_);
    if (!folder.isEmpty()) open(folder);
  });
  menu->addAction(tr("Recording…"), this, [this] {
    const QString file = QFileDialog::getOpenFileName(this, tr("Open a recording"), path_, tr("Recordings (*.reach)"));
    if (!file.isEmpty()) open(file);
  });
  menu->addAction(tr("Look again"), this, [this] {
    if (!path_.isEmpty()) open(path_);
  });
  openButton->setMenu(menu);
  title_ = new widgets::ElidedLabel;
  title_->setText(tr("No recording is open. Use File, Inspect to open a dataset or a session."));
  title_->setStyleSheet(QStringLiteral("font-weight: 600;"));
  words_ = widgets::named<QLineEdit>("inspectorFilter");
  words_->setPlaceholderText(tr("filter: words of a row, e.g. sub-03 fast success"));
  words_->setClearButtonEnabled(true);
  words_->setMinimumWidth(160);
  count_ = widgets::named<QLabel>("inspectorCount");
  count_->setProperty("role", "quiet");
  progress_ = widgets::named<QProgressBar>("inspectorProgress");
  progress_->setFixedWidth(progress_->fontMetrics().horizontalAdvance(tr("fitting trial") + QStringLiteral(" 88888 / 88888")) + 24);
  progress_->hide();
  cancel_ = widgets::named<QPushButton>("inspectorCancel", tr("Cancel"));
  cancel_->hide();
  auto* exportButton = new QToolButton;
  exportButton->setText(tr("Export"));
  exportButton->setPopupMode(QToolButton::InstantPopup);
  auto* exports = new QMenu(exportButton);
  exports->addAction(tr("Figure or lines of the chosen trials…"), this, &InspectorPage::saveFigure);
  exports->addAction(tr("Table as it is shown…"), this, &InspectorPage::saveTable);
  exportButton->setMenu(exports);
  report_ = widgets::named<QPushButton>("inspectorReport", tr("Report"));
  report_->setToolTip(tr("analyses all open recordings, as `reach analyze` does, and shows the report"));
  report_->setEnabled(false);
  top->addWidget(openButton);
  top->addWidget(title_);
  top->addWidget(words_, 1);
  top->addWidget(count_);
  top->addWidget(progress_);
  top->addWidget(cancel_);
  top->addWidget(exportButton);
  top->addWidget(report_);
  layout.addLayout(top);
}

QWidget* InspectorPage::makeRight() {
  auto* right = new QWidget;
  auto* column = new QVBoxLayout(right);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(3);
  auto* row = new QHBoxLayout;
  signal_ = widgets::named<QComboBox>("inspectorSignal");
  signal_->addItems({tr("velocity of the hand"), tr("velocity of the last mass")});
  axis_ = widgets::named<QComboBox>("inspectorAxis");
  axis_->addItems({tr("as moved"), tr("time-scaled to the mean")});
  predicted_ = new QCheckBox(tr("predicted for T"));
  predicted_->setChecked(true);
  fitted_ = widgets::named<QCheckBox>("inspectorFitted", tr("fitted"));
  fitted_->setChecked(true);
  fitted_->setToolTip(tr("the mean of the movements that were fitted to a person's trials (ten trials or more)"));
  for (QWidget* widget : std::initializer_list<QWidget*>{signal_, axis_, predicted_, fitted_}) row->addWidget(widget);
  row->addStretch(1);
  column->addLayout(row);
  plot_ = widgets::named<ProfilePlot>("inspectorPlot");
  replay_ = new ReplayView;
  epsilons_ = new EpsilonPanel;
  auto* below = new QSplitter(Qt::Horizontal);
  below->addWidget(replay_);
  below->addWidget(epsilons_);
  below->setStretchFactor(0, 3);
  below->setStretchFactor(1, 2);
  below->setSizes({520, 340});
  below->setChildrenCollapsible(false);
  auto* halves = new QSplitter(Qt::Vertical);
  halves->addWidget(plot_);
  halves->addWidget(below);
  halves->setStretchFactor(0, 1);
  halves->setStretchFactor(1, 1);
  halves->setSizes({420, 400});
  halves->setChildrenCollapsible(false);
  column->addWidget(halves, 1);
  return right;
}

}  // namespace reachlab::gui::inspector
