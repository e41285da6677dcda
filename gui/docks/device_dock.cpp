#include "gui/docks/device_dock.h"

#include <QHeaderView>
#include <QPushButton>
#include <QTimer>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "devices/hands/several_hands.h"
#include "gui/widgets/named.h"
#include "gui/widgets/theme.h"
#include "gui/widgets/wait_cursor.h"

namespace reachlab::gui::docks {
namespace {

constexpr int kRefreshMs = 1000;
enum Column { kName, kWords };

bool isPresent(const QTreeWidgetItem& row) { return row.data(kName, Qt::UserRole).toBool(); }

// A heading over the rows below it.
QTreeWidgetItem* addGroup(QTreeWidget& rows, const QString& title) {
  auto* group = new QTreeWidgetItem(&rows, {title});
  group->setFlags(Qt::ItemIsEnabled);
  group->setFirstColumnSpanned(true);
  group->setExpanded(true);
  QFont bold = rows.font();
  bold.setBold(true);
  group->setFont(kName, bold);
  return group;
}

}  // namespace

DeviceDock::DeviceDock(const Finding& finding, QWidget* parent) : Dock(tr("Devices"), "deviceDock", parent), finding_(finding) {
  using widgets::named, widgets::tipped;
  auto* body = new QWidget;
  auto* layout = widgets::filling<QVBoxLayout>(body, 2);
  rows_ = named<QTreeWidget>("deviceRows");
  rows_->setColumnCount(2);
  rows_->setHeaderHidden(true);
  rows_->setRootIsDecorated(false);
  rows_->setItemsExpandable(false);
  rows_->setIndentation(8);
  rows_->header()->setSectionResizeMode(kName, QHeaderView::ResizeToContents);
  rows_->header()->setSectionResizeMode(kWords, QHeaderView::Stretch);
  rows_->setMinimumSize(180, 90);
  layout->addWidget(rows_, 1);
  hint_ = named<QLabel>("deviceHint");
  hint_->setTextFormat(Qt::PlainText);
  hint_->setTextInteractionFlags(Qt::TextSelectableByMouse);  // a command or a place is copied from it
  hint_->setWordWrap(true);
  hint_->setContentsMargins(4, 2, 4, 2);
  layout->addWidget(hint_);
  take_ = tipped(named<QPushButton>("deviceUse", tr("Use it")), tr("the chosen device is the hand of the next run"));
  look_ = tipped(named<QPushButton>("deviceLook", tr("Look at it…")), tr("live: position, force, times between reports, calibration"));
  again_ = tipped(named<QPushButton>("deviceAgain", tr("Look again")), tr("asks every driver again, including the vendors' libraries"));
  layout->addLayout(widgets::rowOf({take_, look_, again_}));
  setBody(body, false);

  connect(rows_, &QTreeWidget::currentItemChanged, this, &DeviceDock::showButtons);
  connect(rows_, &QTreeWidget::itemDoubleClicked, take_, &QPushButton::click);
  connect(take_, &QPushButton::clicked, this, [this] { Q_EMIT taken(withOptions(chosen())); });
  connect(look_, &QPushButton::clicked, this, &DeviceDock::lookAt);
  connect(again_, &QPushButton::clicked, this, &DeviceDock::list);
  auto* plugs = new QTimer(this);
  connect(plugs, &QTimer::timeout, this, [this] {
    if (rows_->isVisible() && mayAsk() && finding_.fingerprint() != plugged_) list();
  });
  plugs->start(kRefreshMs);
  connect(this, &QDockWidget::visibilityChanged, this, [this](bool seen) {
    if (seen && !plugged_ && mayAsk()) list();
  });
  showButtons();
}

bool DeviceDock::mayAsk() const { return !busy_ && dialog_ == nullptr; }

void DeviceDock::setBusy(bool busy) {
  busy_ = busy;
  showButtons();
}

QString DeviceDock::chosen() const {
  const QTreeWidgetItem* row = rows_->currentItem();
  return row == nullptr || row->parent() == nullptr ? QString() : row->text(kName);
}

QString DeviceDock::withOptions(const QString& name) const {
  for (const std::string& hand : devices::splitHands(hand_.toStdString()))
    if (const QString spec = QString::fromStdString(hand); spec.startsWith(name + QLatin1Char(','))) return spec;
  return name;
}

void DeviceDock::list() {
  if (!mayAsk()) return;
  const widgets::WaitCursor wait;
  const QString before = chosen();
  plugged_ = finding_.fingerprint();
  rows_->clear();
  auto* there = addGroup(*rows_, tr("Connected"));
  auto* absent = addGroup(*rows_, tr("Missing devices, and why"));
  auto* made = addGroup(*rows_, tr("Hands without a device"));
  for (const devices::FoundDevice& found : finding_.all()) {
    const devices::DeviceDriver* driver = devices::findDriver(found.kind);
    const bool needsNone = driver != nullptr && driver->isMade;
    auto* row =
        new QTreeWidgetItem(needsNone       ? made
                            : found.present ? there
                                            : absent,
                            {QString::fromStdString(found.name), QString::fromStdString(found.present ? found.description : found.whyNot)});
    row->setData(kName, Qt::UserRole, found.present);
    row->setToolTip(kName, driver != nullptr ? QString::fromStdString(driver->usage) : QString());
    row->setToolTip(kWords, QString::fromStdString(found.description));
    if (!found.present)
      for (const int column : {kName, kWords}) row->setForeground(column, widgets::toQColor(widgets::colours::kFaintText));
    if (row->text(kName) == before) rows_->setCurrentItem(row);
  }
  for (auto* group : {there, absent, made}) group->setHidden(group->childCount() == 0);
  showButtons();
}

void DeviceDock::showButtons() {
  const QTreeWidgetItem* row = rows_->currentItem();
  const bool lacks = needsMoreThanItsName(chosen()), usable = !busy_ && !chosen().isEmpty() && isPresent(*row) && !lacks;
  take_->setEnabled(usable);
  look_->setEnabled(usable && !isInWindowOnly(row->text(kName)));
  again_->setEnabled(!busy_);
  hint_->setText(busy_                ? tr("The run uses its devices. End the run to search for devices again.")
                 : chosen().isEmpty() ? QString()
                 : lacks              ? tr("Type the whole name into the dock Session: %1").arg(row->toolTip(kName))
                                      : row->text(kWords));
  hint_->setVisible(!hint_->text().isEmpty());
}

void DeviceDock::lookAt() {
  dialog_ = new DeviceDialog(
      experiment::CompiledExperiment(shown()), withOptions(chosen()), [this](const QString& name) { Q_EMIT taken(name); }, this);
  dialog_->setAttribute(Qt::WA_DeleteOnClose);
  dialog_->open();
  dialog_->openOrLetGo();
}

}  // namespace reachlab::gui::docks
