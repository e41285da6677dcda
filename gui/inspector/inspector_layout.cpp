// InspectorPage: its widgets.
#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QProgressBar>
#include <QPushButton>
#include <QSortFilterProxyModel>
#include <QSplitter>
#include <QTableView>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <array>

#include "gui/inspector/epsilon_panel.h"
#include "gui/inspector/inspector.h"
#include "gui/inspector/marks_panel.h"
#include "gui/inspector/profile_plot.h"
#include "gui/inspector/replay_view.h"
#include "gui/widgets/elided_label.h"
#include "gui/widgets/named.h"

namespace reachlab::gui::inspector {
namespace {

constexpr int kSoonMs = 150;  // a choice that is still being dragged is not read yet

// Two widgets with a border that the user can move, but not away.
QSplitter* split(Qt::Orientation along, QWidget* first, QWidget* second, std::array<int, 2> stretch, const QList<int>& sizes) {
  auto* made = new QSplitter(along);
  made->addWidget(first);
  made->addWidget(second);
  made->setStretchFactor(0, stretch[0]);
  made->setStretchFactor(1, stretch[1]);
  made->setSizes(sizes);
  made->setChildrenCollapsible(false);
  return made;
}

QToolButton* makeMenuButton(const QString& words, QMenu*& menu) {
  auto* button = new QToolButton;
  button->setText(words);
  button->setPopupMode(QToolButton::InstantPopup);
  button->setMenu(menu = new QMenu(button));
  return button;
}

}  // namespace

InspectorPage::InspectorPage(QWidget* parent) : QWidget(parent) {
  setObjectName("inspector");
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 6, 4);
  layout->setSpacing(5);
  addTop(*layout);
  table_ = new TrialTable(this);
  filter_ = new QSortFilterProxyModel(table_);
  filter_->setSourceModel(table_);
  filter_->setSortRole(Qt::UserRole);
  filter_->setFilterRole(TrialTable::kWordsRole);
  filter_->setDynamicSortFilter(false);  // a row does not run away while its epsilon is computed
  halves_ = split(Qt::Horizontal, makeLeft(), makeRight(), {4, 6}, {700, 860});
  halves_->setObjectName("inspectorHalves");
  connect(halves_, &QSplitter::splitterMoved, this, [this] { halvesMoved_ = true; });
  layout->addWidget(halves_, 1);
  soon_ = new QTimer(this);
  soon_->setSingleShot(true);
  soon_->setInterval(kSoonMs);
  wire();
  addKeys();
}

QWidget* InspectorPage::makeLeft() {
  view_ = widgets::named<QTableView>("inspectedTrials");
  view_->setModel(filter_);
  view_->setSortingEnabled(true);
  view_->sortByColumn(-1, Qt::AscendingOrder);
  view_->setSelectionBehavior(QAbstractItemView::SelectRows);
  view_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  view_->setShowGrid(false);
  view_->setTabKeyNavigation(false);  // Tab goes on to the next field
  view_->setAlternatingRowColors(true);
  view_->verticalHeader()->hide();
  view_->verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
  view_->verticalHeader()->setDefaultSectionSize(22);
  view_->horizontalHeader()->setHighlightSections(false);
  view_->horizontalHeader()->setMinimumSectionSize(24);  // Qt's own is the width of the widest letter, whatever is in the column
  view_->horizontalHeader()->setStretchLastSection(true);
  view_->setWordWrap(false);
  marks_ = new MarksPanel;
  auto* left = new QWidget;
  widgets::addAll(*widgets::filling<QVBoxLayout>(left, 4), {view_, marks_}, view_);
  return left;
}

void InspectorPage::addTop(QVBoxLayout& layout) {
  QMenu *menu = nullptr, *exports = nullptr;
  auto *openButton = makeMenuButton(tr("Open"), menu), *exportButton = makeMenuButton(tr("Export"), exports);
  openButton->setObjectName("inspectorOpen");
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
  title_ = new widgets::ElidedLabel;
  title_->setText(tr("No recording is open. Use Experiment, Inspect a dataset… to open a dataset or a session."));
  title_->setStyleSheet("font-weight: 600;");
  words_ = widgets::named<QLineEdit>("inspectorFilter");
  words_->setPlaceholderText(tr("filter: words of a row, e.g. sub-03 fast success"));
  words_->setClearButtonEnabled(true);
  words_->setMinimumWidth(160);
  count_ = widgets::named<QLabel>("inspectorCount");
  count_->setProperty("role", "quiet");
  progress_ = widgets::named<QProgressBar>("inspectorProgress");
  progress_->setFixedWidth(progress_->fontMetrics().horizontalAdvance(tr("fitting trial") + " 88888 / 88888") + 24);
  progress_->hide();
  cancel_ = widgets::named<QPushButton>("inspectorCancel", tr("Cancel"));
  cancel_->hide();
  exports->addAction(tr("Figure or lines of the chosen trials…"), this, [this] {
    save(tr("Export figure or lines"), "trials.svg",
         tr("Figure as SVG (*.svg);;Figure as PDF (*.pdf);;Figure as PNG (*.png);;Lines as CSV (*.csv)"),
         [this](const QString& file) { exportTo(file); });
  });
  exports->addAction(tr("Table as it is shown…"), this, [this] {
    save(tr("Export table"), "trials.csv", tr("CSV (*.csv)"), [this](const QString& file) { exportTable(file); });
  });
  report_ = widgets::named<QPushButton>("inspectorReport", tr("Report"));
  report_->setToolTip(tr("analyses all open recordings, as `reach analyze` does, and shows the report"));
  report_->setEnabled(false);
  layout.addLayout(widgets::rowOf({openButton, title_, words_, count_, progress_, cancel_, exportButton, report_}, words_));
}

QWidget* InspectorPage::makeRight() {
  auto* right = new QWidget;
  auto* column = widgets::filling<QVBoxLayout>(right, 3);
  signal_ = widgets::named<QComboBox>("inspectorSignal");
  signal_->addItems({tr("velocity of the hand"), tr("velocity of the last mass")});
  axis_ = widgets::named<QComboBox>("inspectorAxis");
  axis_->addItems({tr("as moved"), tr("time-scaled to the mean")});
  predicted_ = widgets::named<QCheckBox>("inspectorPredicted", tr("predicted for T"));
  predicted_->setChecked(true);
  fitted_ = widgets::named<QCheckBox>("inspectorFitted", tr("fitted"));
  fitted_->setChecked(true);
  fitted_->setToolTip(tr("the mean of the movements that were fitted to a person's trials (ten trials or more)"));
  column->addLayout(widgets::rowOf({signal_, axis_, predicted_, fitted_, nullptr}));
  plot_ = widgets::named<ProfilePlot>("inspectorPlot");
  replay_ = new ReplayView;
  epsilons_ = new EpsilonPanel;
  QSplitter* below = split(Qt::Horizontal, replay_, epsilons_, {3, 2}, {520, 340});
  column->addWidget(split(Qt::Vertical, plot_, below, {1, 1}, {420, 400}), 1);
  return right;
}

}  // namespace reachlab::gui::inspector
