#include "gui/docks/session_dock.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QTimer>
#include <QVBoxLayout>

#include "devices/driver/registry.h"
#include "devices/hot_plug.h"
#include "gui/widgets/fault_words.h"
#include "gui/widgets/theme.h"
#include "gui/widgets/named.h"
#include "sim/record/configuration/run_configuration.h"

namespace reachlab::gui::docks {
namespace {

// The first entry names the box.
std::string chosen(const QComboBox& box) { return box.currentIndex() > 0 ? box.currentText().toStdString() : std::string(); }
void choose(QComboBox& box, const std::string& value) { box.setCurrentIndex(std::max(0, box.findText(QString::fromStdString(value)))); }

}  // namespace

SessionDock::SessionDock(QWidget* parent) : Dock("Session", "sessionDock", parent) {
  using widgets::named, widgets::tipped, widgets::rowOf;
  subject_ = tipped(named<QLineEdit>("subject"), "Label of the subject in the dataset: letters and digits");
  session_ = tipped(named<QLineEdit>("session"), "Label of this visit in the dataset: letters and digits");
  day_ = tipped(new QSpinBox, "Day of the plan, if the label of the session is no number");
  day_->setRange(0, session::kMaxDay);
  day_->setSpecialValueText("–");
  age_ = tipped(named<QLineEdit>("age"), "Age in years, for the table of participants");
  age_->setPlaceholderText("age");
  age_->setMaximumWidth(54);
  sex_ = tipped(new QComboBox, "Sex, for the table of participants");
  sex_->addItems({"sex", "F", "M", "O"});
  hand_ = tipped(new QComboBox, "Handedness, for the table of participants: right, left, ambidextrous");
  hand_->addItems({"hand", "R", "L", "A"});
  data_ = tipped(named<QLineEdit>("data"), "Folder of the dataset. It is created if it does not exist.");
  who_ = new QWidget;
  auto* form = widgets::filling<QFormLayout>(who_);
  form->addRow("subject", rowOf({subject_, new QLabel("session"), session_, new QLabel("day"), day_}));
  form->addRow("person", rowOf({age_, sex_, hand_}));
  form->addRow("device", makeDeviceRow());
  auto* browse = tipped(named<QPushButton>("dataBrowse", "…"), "chooses the folder of the dataset");
  browse->setMaximumWidth(48);
  connect(browse, &QPushButton::clicked, this, [this] {
    const QString folder = QFileDialog::getExistingDirectory(this, "Folder of the dataset", QString::fromStdString(request().place.data));
    if (!folder.isEmpty()) data_->setText(folder);
  });
  form->addRow("data in", rowOf({data_, browse}));

  automatic_ = tipped(new QCheckBox("start the next trial after"),
                      "The next trial begins without a key after this pause. A plan has its own pauses.");
  pause_ = tipped(named<widgets::UnitSpinBox>("pause", 0, 600, "s"), automatic_->toolTip());
  pause_->setName("pause");
  pause_->show(1);
  auto* pauseFault = named<widgets::FaultLabel>("pauseFault");  // not among the faults that prevent a start: the value before holds
  pauseFault->watch(pause_);

  auto* body = new QWidget;
  auto* layout = new QVBoxLayout(body);
  widgets::addAll(*layout, {who_, faults()});
  layout->addLayout(rowOf({automatic_, pause_, nullptr}));
  widgets::addAll(*layout, {pauseFault, nullptr});
  setBody(body, false);

  for (QLineEdit* field : {subject_, session_, age_, data_}) {
    connect(field, &QLineEdit::textChanged, this, &SessionDock::check);
    connect(field, &QLineEdit::textChanged, this, &SessionDock::changed);
  }
  connect(subject_, &QLineEdit::textChanged, this, &SessionDock::forgetPerson);
  connect(device_, &QComboBox::currentTextChanged, this, &SessionDock::changed);
  connect(trials_, QOverload<int>::of(&QSpinBox::valueChanged), this, &SessionDock::changed);
}

QHBoxLayout* SessionDock::makeDeviceRow() {
  QString usage;
  for (const devices::DeviceDriver& d : devices::deviceDrivers()) usage += QString::fromStdString(d.usage + ": " + d.description + "\n");
  device_ = widgets::tipped(widgets::named<QComboBox>("device"), usage.trimmed());
  device_->setEditable(true);
  device_->addItems({"mouse", "simulated", "simulated:noise=0", "replay:"});
  offered_ = device_->count();
  auto* look = new QTimer(this);
  connect(look, &QTimer::timeout, this, &SessionDock::offerPlugged);
  look->start(1000);
  trials_ = widgets::tipped(widgets::named<QSpinBox>("trialCount"), "Trials of the next run. A plan has its own number of trials.");
  trials_->setRange(1, session::kMaxTrials);
  trials_->setValue(20);
  auto* devices = widgets::tipped(widgets::named<QPushButton>("devicesButton", "…"),
                                  "opens the dock Devices: the present devices, why others are missing, and a live view");
  devices->setMaximumWidth(48);
  connect(devices, &QPushButton::clicked, this, &SessionDock::devicesRequested);
  return widgets::rowOf({device_, devices, new QLabel("trials"), trials_}, device_);
}

// What was plugged in or out is offered or not any more; what is typed stays.
void SessionDock::offerPlugged() {
  const std::uint64_t now = devices::pluggedFingerprint();
  if (!who_->isEnabled() || now == plugged_) return;
  plugged_ = now;
  const QString typed = device_->currentText();
  const QSignalBlocker quiet(device_);
  while (device_->count() > offered_) device_->removeItem(offered_);
  for (const devices::FoundDevice& found : devices::findPlugged()) {
    device_->addItem(QString::fromStdString(found.name));
    device_->setItemData(device_->count() - 1, QString::fromStdString(found.description), Qt::ToolTipRole);
  }
  device_->setCurrentText(typed);
}

void SessionDock::check() {
  const auto mark = [](QLineEdit* field, const QString& fault) {
    field->setStyleSheet(fault.isEmpty() ? QString() : widgets::faultyField());
    if (field->property("usualTip").isNull()) field->setProperty("usualTip", field->toolTip());
    field->setToolTip(fault.isEmpty() ? field->property("usualTip").toString() : fault);
    return fault;
  };
  const auto labelFault = [](QLineEdit* field, const char* name) {
    const auto fault = record::labelFault(field->text().trimmed().toStdString(), name);
    return fault ? widgets::inWords(*fault) : QString();
  };
  bool isNumber = false;
  const QString age = age_->text().trimmed();
  const double years = QLocale::c().toDouble(age, &isNumber);
  const bool fineAge = age.isEmpty() || (isNumber && years >= 0 && years <= record::kMaxAge);
  QStringList faults{
      mark(subject_, labelFault(subject_, "subject")), mark(session_, labelFault(session_, "session")),
      mark(age_,
           fineAge ? QString() : QStringLiteral("age: \"%1\" is no age; allowed: 0 to %2 years, or nothing").arg(age).arg(record::kMaxAge)),
      mark(data_, data_->text().trimmed().isEmpty() ? "data in: is empty; allowed: a folder" : QString())};
  faults.removeAll({});
  this->faults()->setFaults(faults);
}

void SessionDock::setRequest(const session::SessionRequest& request) {
  request_ = request;
  subject_->setText(QString::fromStdString(request.place.subject));
  session_->setText(QString::fromStdString(request.place.session));
  data_->setText(QString::fromStdString(request.place.data));
  day_->setValue(request.day.value_or(0));
  device_->setCurrentText(QString::fromStdString(request.device));
  if (request.trials) trials_->setValue(*request.trials);  // a plan has its own
  age_->setText(request.participant.age ? QString::number(*request.participant.age) : QString());
  choose(*sex_, request.participant.sex);
  choose(*hand_, request.participant.handedness);
}

void SessionDock::display(const experiment::CompiledExperiment&, bool editable) {
  request_.trials = editable ? std::optional(trials_->value()) : std::nullopt;
  trials_->setEnabled(editable);
}

session::SessionRequest SessionDock::request() const {
  session::SessionRequest r = request_;
  r.place.subject = subject_->text().trimmed().toStdString();
  r.place.session = session_->text().trimmed().toStdString();
  QString folder = data_->text().trimmed();
  if (folder == "~" || folder.startsWith("~/")) folder.replace(0, 1, QDir::homePath());  // as in a shell
  r.place.data = folder.toStdString();
  r.day = day_->value() > 0 ? std::optional(day_->value()) : std::nullopt;
  if (request_.trials) r.trials = trials_->value();
  r.device = device();
  bool fine = false;
  const double age = QLocale::c().toDouble(age_->text(), &fine);
  r.participant.age = fine ? std::optional(age) : std::nullopt;
  r.participant.sex = chosen(*sex_);
  r.participant.handedness = chosen(*hand_);
  return r;
}

std::string SessionDock::device() const { return device_->currentText().trimmed().toStdString(); }
void SessionDock::setDevice(const QString& name) { device_->setCurrentText(name); }
void SessionDock::setTrials(int trials) { trials_->setValue(trials); }
std::optional<double> SessionDock::ownPause() const { return automatic_->isChecked() ? std::optional(pause_->value()) : std::nullopt; }

void SessionDock::setOpen(bool open) { who_->setEnabled(!open); }

void SessionDock::nextSubject() { subject_->setText(labelAfter(subject_->text().trimmed())); }

// Age, sex and handedness are those of the subject before.
void SessionDock::forgetPerson() {
  age_->clear();
  sex_->setCurrentIndex(0);
  hand_->setCurrentIndex(0);
}

QString labelAfter(const QString& label) {
  int first = label.size();
  while (first > 0 && label[first - 1].isDigit()) --first;
  const QString digits = label.mid(first);
  if (digits.isEmpty()) return label + "2";
  return label.left(first) + QString::number(digits.toULongLong() + 1).rightJustified(digits.size(), QLatin1Char('0'));
}

}  // namespace reachlab::gui::docks
