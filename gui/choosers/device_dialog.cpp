#include "gui/choosers/device_dialog.h"

#include <QLineEdit>
#include <QPushButton>
#include <QTimer>
#include <QVBoxLayout>
#include <utility>

#include "devices/driver/registry.h"
#include "gui/widgets/fault_in.h"
#include "gui/widgets/theme.h"
#include "gui/widgets/named.h"
#include "gui/widgets/wait_cursor.h"

namespace reachlab::gui::docks {
namespace {

constexpr int kLookMs = 33;

QString millimetres(double metres) { return QStringLiteral("%1").arg(1e3 * metres, 7, 'f', 2); }

}  // namespace

bool isInWindowOnly(const QString& device) {
  const devices::DeviceDriver* driver =
      devices::findDriver(device.section(QLatin1Char(':'), 0, 0).section(QLatin1Char(','), 0, 0).toStdString());
  return driver != nullptr && driver->inWindowOnly;
}

bool needsMoreThanItsName(const QString& device) {
  const devices::DeviceDriver* driver = devices::findDriver(device.toStdString());
  return driver != nullptr && driver->usage.starts_with(driver->name + ":");
}

DeviceDialog::DeviceDialog(const experiment::CompiledExperiment& experiment, const QString& chosen,
                           std::function<void(const QString& name)> take, QWidget* parent)
    : QDialog(parent), experiment_(experiment), taken_(std::move(take)) {
  setObjectName("device");
  setWindowTitle(tr("Device"));
  resize(860, 390);
  auto* layout = new QVBoxLayout(this);
  name_ = widgets::named<QLineEdit>("deviceName", chosen);
  name_->setPlaceholderText(tr("device, with its options: hid:SERIAL,model=polhem_v1"));
  open_ = widgets::named<QPushButton>("deviceOpen");
  calibrate_ = widgets::named<QPushButton>("deviceCalibrate", tr("Calibrate"));
  take_ = widgets::named<QPushButton>("deviceTake", tr("Use it"));
  for (QPushButton* button : {open_, calibrate_, take_}) button->setAutoDefault(false);
  layout->addLayout(widgets::rowOf({name_, open_, calibrate_, take_}, name_));
  hint_ = widgets::named<QLabel>("deviceState");
  hint_->setWordWrap(true);
  view_ = new DeviceView;
  numbers_ = widgets::named<QLabel>("deviceNumbers");
  numbers_->setTextFormat(Qt::PlainText);
  widgets::addAll(*layout, {hint_, view_, numbers_});

  timer_ = new QTimer(this);
  connect(timer_, &QTimer::timeout, this, &DeviceDialog::look);
  connect(name_, &QLineEdit::textChanged, this, &DeviceDialog::showButtons);
  connect(open_, &QPushButton::clicked, this, &DeviceDialog::openOrLetGo);
  connect(calibrate_, &QPushButton::clicked, this, &DeviceDialog::calibrate);
  connect(take_, &QPushButton::clicked, this, [this] {
    timer_->stop();
    device_.reset();  // the run is to have it
    taken_(name_->text().trimmed());
    accept();
  });
  showButtons();
}

void DeviceDialog::showButtons() {
  const QString name = name_->text().trimmed();
  open_->setText(device_ ? tr("Let it go") : tr("Look at it"));
  open_->setEnabled(device_ != nullptr || (!name.isEmpty() && !isInWindowOnly(name)));
  open_->setToolTip(isInWindowOnly(name) ? tr("it is seen in the window itself") : QString());
  calibrate_->setEnabled(device_ != nullptr && !device_->calibrationHint().empty());
  take_->setEnabled(!name.isEmpty() && !needsMoreThanItsName(name));
  name_->setEnabled(!device_);
}

void DeviceDialog::tell(const QString& sentence, bool isFault) {
  hint_->setStyleSheet(isFault ? QStringLiteral("color: %1;").arg(widgets::faultInk().name()) : QString());
  hint_->setText(sentence);
}

void DeviceDialog::openOrLetGo() {
  if (device_) {
    timer_->stop();
    device_.reset();
    view_->clear();
    numbers_->clear();
    tell({}, false);
    showButtons();
    return;
  }
  const QString fault = widgets::faultIn([this] {
    const widgets::WaitCursor wait;
    device_ = std::make_unique<devices::LiveDevice>(name_->text().trimmed().toStdString(), experiment_);
    const haptics::DeviceInfo info = device_->info();
    reach_ = info.workspaceRadius > 0 ? info.workspaceRadius : 0.15;
    force_ = info.rendersForce && info.maxForce > 0 ? info.maxForce : 1;
    const QString hint = QString::fromStdString(device_->calibrationHint());
    usual_ = QString::fromStdString(info.name) +
             (hint.isEmpty() ? tr(" needs no calibration") : tr(": to calibrate, %1, and press Calibrate").arg(hint));
    tell(usual_, false);
    timer_->start(kLookMs);
  });
  if (!fault.isEmpty()) tell(fault, true);
  showButtons();
}

void DeviceDialog::look() {
  const devices::LiveDevice::View view = device_->look();
  view_->display(view, reach_, force_);
  QString buttons;
  for (int i = 0; i < 32; ++i)
    if ((view.buttons >> i & 1u) != 0) buttons += QStringLiteral(" %1").arg(i + 1);
  numbers_->setText(tr("position %1 %2 %3 mm    speed %4 mm/s    force %5 %6 %7 N    %8 reports/s    buttons%9")
                        .arg(millimetres(view.position.x), millimetres(view.position.y), millimetres(view.position.z))
                        .arg(1e3 * view.speed, 6, 'f', 1)
                        .arg(view.force.x, 5, 'f', 2)
                        .arg(view.force.y, 5, 'f', 2)
                        .arg(view.force.z, 5, 'f', 2)
                        .arg(view.rate, 6, 'f', 1)
                        .arg(buttons.isEmpty() ? " –" : buttons));
  if (!view.fault.empty()) tell(QString::fromStdString(view.fault), true);
  else if (!fault_.empty()) tell(usual_, false);  // it is back
  fault_ = view.fault;
}

void DeviceDialog::calibrate() {
  const QString fault = widgets::faultIn([this] {
    const widgets::WaitCursor wait;
    device_->calibrate();
    tell(tr("The device is calibrated. This is its calibration position now."), false);
  });
  if (!fault.isEmpty()) tell(fault, true);
}

}  // namespace reachlab::gui::docks
