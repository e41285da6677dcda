#include <QComboBox>
#include <QFormLayout>
#include <QGroupBox>
#include <QListWidget>
#include <QPushButton>
#include <algorithm>
#include <map>
#include <string_view>

#include "gui/docks/experiment_docks.h"
#include "gui/widgets/key_field.h"
#include "gui/widgets/named.h"
#include "sim/experiment/experiment_keys.h"
#include "sim/experiment/unit_ending.h"

namespace reachlab::gui::docks {
namespace {

using experiment::Key;

constexpr char kWhat[] = "environment";

// A force of each kind to begin with. The fields are those of published experiments.
const std::vector<experiment::HandForce>& beginnings() {
  using namespace experiment;
  static const std::vector<HandForce> all{{ViscousForce{{{{0, 0, 13}, {0, 0, 0}, {-13, 0, 0}}}}},
                                          {ElasticForce{{{{100, 0, 0}, {0, 0, 0}, {0, 0, 100}}}, {}}},
                                          {JointViscousForce{{{{1.66, 0.64}, {0.64, -1.54}}}}},
                                          {ChannelForce{}, ForceWhen::Trial},
                                          {PulseForce{.force = {5, 0, 0}, .at = {.onset = 0.1, .distance = {}}}}};
  return all;
}

QString tipOf(std::string_view key) {
  static const std::map<std::string_view, const char*> tips{
      {"matrix_n_s_per_m", "B of the force B v. Rows and columns are x, y and z: to the subject's right, up, towards the subject."},
      {"matrix_n_per_m", "K of the force -K (x - c). Rows and columns are x, y and z: to the subject's right, up, towards the subject."},
      {"centre_m", "The place where the force is zero. Without it, this is the start of the task."},
      {"matrix_n_m_s_per_rad", "W: torques at shoulder and elbow by the rates of their angles. Both angles are counted from the right."},
      {"stiffness_n_per_m", "Stiffness of the walls beside the line from start to target."},
      {"damping_n_s_per_m", "Damping of the walls, for the speed across the line."},
      {"half_width_m", "Distance of the walls from the line."},
      {"ramp_s", "Time in which the walls grow, from arming."},
      {"break_m", "Distance from the line beyond which the channel lets go for the rest of the trial."},
      {"force_n", "The force between rise and fall, along x, y and z."},
      {"at", "The beginning of the pulse."},
      {"duration_s", "Length of the pulse, with rise and fall."},
      {"rise_s", "Time in which the pulse rises, and in which it falls."},
      {"when", "From movement onset, or from arming. The force grows over 20 ms."},
      {"rotation_deg", "Angle of the cursor about the start, counterclockwise as seen from above or by the subject."},
      {"gain", "Distance of the cursor from the start divided by the distance of the hand."},
      {"clamp_deg", "The cursor moves along a line at this angle to the target, whatever direction the hand takes."},
      {"delay_s", "Delay of the picture. The recorded and judged cursor is not delayed."},
      {"show", "The part of a trial in which the subject sees the cursor. You always see it."},
      {"judge", "The point that the tolerances judge. Onset and velocities are always those of the hand."}};
  const auto tip = tips.find(key);
  return tip == tips.end() ? QString() : QString::fromUtf8(tip->second);
}

// Each type of a key's value: its form, its list of numbers, and back.
widgets::KeyForm formOf(const Key&, double) { return {}; }
widgets::KeyForm formOf(const Key&, const Vec3&) { return {.rows = 1, .columns = 3}; }
template <std::size_t N>
widgets::KeyForm formOf(const Key&, const experiment::SquareMatrix<N>&) {
  return {.rows = N, .columns = N};
}
widgets::KeyForm formOf(const Key&, const experiment::PulseInstant&) { return {.choices = {"s after onset", "m from the start"}}; }
template <class T>
requires std::is_enum_v<T> widgets::KeyForm formOf(const Key& key, T) {
  widgets::KeyForm form{.rows = 0, .columns = 0};
  for (const std::string& name : *key.names) form.choices << QString::fromStdString(name);
  return form;
}
template <class T>
widgets::KeyForm formOf(const Key& key, const std::optional<T>&) {
  widgets::KeyForm form = formOf(key, T{});
  form.optional = true;
  return form;
}

std::vector<double> numbersOf(double value) { return {value}; }
std::vector<double> numbersOf(const Vec3& v) { return {v.x, v.y, v.z}; }
template <std::size_t N>
std::vector<double> numbersOf(const experiment::SquareMatrix<N>& matrix) {
  std::vector<double> all;
  for (const auto& row : matrix) all.insert(all.end(), row.begin(), row.end());
  return all;
}
std::vector<double> numbersOf(const experiment::PulseInstant& at) {
  return at.distance ? std::vector<double>{1, *at.distance} : std::vector<double>{0, at.onset.value_or(0)};
}
template <class T>
requires std::is_enum_v<T> std::vector<double> numbersOf(T value) { return {static_cast<double>(value)}; }
template <class T>
std::vector<double> numbersOf(const std::optional<T>& value) {
  return value ? numbersOf(*value) : std::vector<double>{};
}

void setNumbers(double& value, const std::vector<double>& numbers) { value = numbers.at(0); }
void setNumbers(Vec3& v, const std::vector<double>& numbers) { v = {numbers.at(0), numbers.at(1), numbers.at(2)}; }
template <std::size_t N>
void setNumbers(experiment::SquareMatrix<N>& matrix, const std::vector<double>& numbers) {
  for (std::size_t i = 0; i < N * N; ++i) matrix[i / N][i % N] = numbers.at(i);
}
void setNumbers(experiment::PulseInstant& at, const std::vector<double>& numbers) {
  at = {};
  (numbers.at(0) == 0 ? at.onset : at.distance) = numbers.at(1);
}
template <class T>
requires std::is_enum_v<T>
void setNumbers(T& value, const std::vector<double>& numbers) { value = static_cast<T>(static_cast<int>(numbers.at(0))); }
template <class T>
void setNumbers(std::optional<T>& value, const std::vector<double>& numbers) {
  value.reset();
  if (!numbers.empty()) setNumbers(value.emplace(), numbers);
}

/// Calls `work(key, value)` for each key of a force, or of the cursor. The kind of a force has no field on its page.
template <class Work>
struct EachKey {
  Work work;
  template <class T>
  void operator()(const Key& key, T& value) const {
    if constexpr (std::is_same_v<std::remove_const_t<T>, experiment::ForceLaw>)
      std::visit([&](auto& law) { visitKeys(law, *this); }, value);
    else work(key, value);
  }
};
template <class T, class Work>
void eachKey(T& of, Work work) {
  visitKeys(of, EachKey<Work>{work});
}

template <class T>
void showIn(const std::vector<widgets::KeyField*>& fields, const T& of) {
  auto field = fields.begin();
  eachKey(of, [&](const Key&, const auto& value) { (*field++)->show(numbersOf(value)); });
}

template <class T>
void takeFrom(const std::vector<widgets::KeyField*>& fields, T& of) {
  auto field = fields.begin();
  eachKey(of, [&](const Key&, auto& value) { setNumbers(value, (*field++)->value()); });
}

class EnvironmentDock : public Dock {
 public:
  explicit EnvironmentDock(QWidget* parent);

 private:
  // The fields of one kind of force, or of the cursor, in the order of its keys.
  struct Page {
    QWidget* widget = nullptr;
    std::vector<widgets::KeyField*> fields;
  };
  // `tell`: after an edit of a field.
  template <class T, class Tell>
  Page makePage(const QString& name, const T& of, Tell tell);
  QWidget* makeForces();
  QWidget* makeCursor();
  void display(const experiment::CompiledExperiment& experiment, bool editable) override;
  void showForce();
  void tellForce();
  std::size_t row() const;  // of the chosen force; their number if no force is chosen

  QListWidget* list_;
  QComboBox* kind_;
  QPushButton* remove_;
  std::vector<Page> kinds_;  // in the order of experiment::ForceLaw
  QGroupBox* cursorBox_;
  Page cursor_;
};

template <class T, class Tell>
EnvironmentDock::Page EnvironmentDock::makePage(const QString& name, const T& of, Tell tell) {
  Page page{new QWidget, {}};
  auto* form = widgets::filling<QFormLayout>(page.widget);
  eachKey(of, [&](const Key& key, const auto& value) {
    const std::string_view whole = key.name;
    const experiment::NamedQuantity quantity = experiment::splitUnit(whole);
    QString words = QString::fromUtf8(quantity.name.data(), static_cast<int>(quantity.name.size()));
    words.replace(QLatin1Char('_'), QLatin1Char(' '));
    const QString unit = QString::fromUtf8(quantity.unit.data(), static_cast<int>(quantity.unit.size()));
    const widgets::KeyForm shape = formOf(key, value);
    auto* field = new widgets::KeyField(words, unit, shape.choices.isEmpty() ? key.range : experiment::upTo(3600, {}), shape);
    field->setObjectName(name + QLatin1Char('.') + QLatin1String(key.name));
    auto* label = new QLabel(shape.columns > 1 ? QStringLiteral("%1 [%2]").arg(words, unit) : words);
    form->addRow(widgets::tipped(label, tipOf(whole)), widgets::tipped(field, tipOf(whole)));
    faults()->watch(field);
    connect(field, &widgets::KeyField::edited, this, tell);
    page.fields.push_back(field);
  });
  return page;
}

EnvironmentDock::EnvironmentDock(QWidget* parent) : Dock("Environment", "environmentDock", parent) {
  setBody(widgets::columnOf({makeForces(), makeCursor(), faults(), nullptr}));
}

QWidget* EnvironmentDock::makeForces() {
  using widgets::named, widgets::tipped;
  auto* box = new QGroupBox(tr("Forces on the hand"));
  auto* column = new QVBoxLayout(box);
  list_ = tipped(named<QListWidget>("forces"), tr("The forces add up. Choose one to see its numbers."));
  list_->setFixedHeight(64);
  column->addWidget(list_);
  auto* add = tipped(named<QPushButton>("addForce", tr("Add")), tr("adds a force on the hand, which begins as a curl field"));
  remove_ = tipped(named<QPushButton>("removeForce", tr("Remove")), tr("removes the chosen force"));
  kind_ = tipped(named<QComboBox>("forceKind"),
                 tr("Kind of the chosen force. Another kind begins with the numbers of a published experiment."));
  for (const std::string& name : experiment::kForceKindNames) kind_->addItem(QString::fromStdString(name));
  column->addLayout(widgets::rowOf({add, remove_, kind_}, kind_));
  for (std::size_t kind = 0; kind < beginnings().size(); ++kind) {
    kinds_.push_back(makePage(kind_->itemText(static_cast<int>(kind)), beginnings()[kind], &EnvironmentDock::tellForce));
    column->addWidget(kinds_.back().widget);
  }
  connect(list_, &QListWidget::currentRowChanged, this, &EnvironmentDock::showForce);
  connect(add, &QPushButton::clicked, this, [this] {
    edit(kWhat, [](experiment::Experiment& e) { e.environment.push_back(beginnings().front()); });
    list_->setCurrentRow(list_->count() - 1);
  });
  connect(remove_, &QPushButton::clicked, this, [this] {
    edit(kWhat, [this](experiment::Experiment& e) { e.environment.erase(e.environment.begin() + static_cast<std::ptrdiff_t>(row())); });
  });
  connect(kind_, qOverload<int>(&QComboBox::activated), this, [this](int kind) {
    edit(kWhat, [&](experiment::Experiment& e) { e.environment[row()] = beginnings()[static_cast<std::size_t>(kind)]; });
    showForce();  // a kind that was refused is not the force's
  });
  return box;
}

QWidget* EnvironmentDock::makeCursor() {
  cursorBox_ = widgets::named<QGroupBox>("cursor", tr("Cursor in place of the hand"));
  cursorBox_->setCheckable(true);
  auto* column = new QVBoxLayout(cursorBox_);
  cursor_ = makePage("cursor", experiment::Cursor{},
                     [this] { edit(kWhat, [this](experiment::Experiment& e) { takeFrom(cursor_.fields, e.cursor.emplace()); }); });
  column->addWidget(cursor_.widget);
  connect(cursorBox_, &QGroupBox::toggled, this, [this](bool on) {
    cursor_.widget->setVisible(on);
    edit(kWhat, [on](experiment::Experiment& e) { e.cursor = on ? std::optional(experiment::Cursor{}) : std::nullopt; });
  });
  return cursorBox_;
}

std::size_t EnvironmentDock::row() const {
  const std::size_t count = shown().environment.size();
  return list_->currentRow() < 0 ? count : std::min(static_cast<std::size_t>(list_->currentRow()), count);
}

void EnvironmentDock::display(const experiment::CompiledExperiment& experiment, bool editable) {
  const experiment::Experiment& e = experiment.experiment();
  body()->setEnabled(editable);
  {
    const QSignalBlocker quiet(list_);
    const int chosen = std::max(list_->currentRow(), 0);
    list_->clear();
    for (std::size_t i = 0; i < e.environment.size(); ++i)
      list_->addItem(QStringLiteral("%1: %2").arg(i + 1).arg(kind_->itemText(static_cast<int>(e.environment[i].law.index()))));
    list_->setCurrentRow(std::min(chosen, list_->count() - 1));
  }
  showForce();
  const bool bare = e.object.kind == experiment::ObjectKind::None;
  cursorBox_->setEnabled(bare || e.cursor);
  cursorBox_->setToolTip(
      bare ? QString() : tr("Only without an object, because the subject sees an object where it is: kind none in the dock Object."));
  widgets::quietly(cursorBox_)->setChecked(e.cursor.has_value());
  cursor_.widget->setVisible(e.cursor.has_value());
  showIn(cursor_.fields, e.cursor.value_or(experiment::Cursor{}));
}

void EnvironmentDock::showForce() {
  const std::size_t chosen = row();
  const bool any = chosen < shown().environment.size();
  remove_->setEnabled(any);
  kind_->setEnabled(any);
  const std::size_t kind = any ? shown().environment[chosen].law.index() : kinds_.size();
  for (std::size_t i = 0; i < kinds_.size(); ++i) kinds_[i].widget->setVisible(i == kind);
  if (!any) return;
  kind_->setCurrentIndex(static_cast<int>(kind));
  showIn(kinds_[kind].fields, shown().environment[chosen]);
}

// With every field of the page, because an entry that was refused alone may hold with the next one.
void EnvironmentDock::tellForce() {
  if (row() == shown().environment.size()) return;
  edit(kWhat, [this](experiment::Experiment& e) {
    experiment::HandForce& force = e.environment[row()];
    takeFrom(kinds_[force.law.index()].fields, force);
  });
}

}  // namespace

Dock* makeEnvironmentDock(QWidget* parent) { return new EnvironmentDock(parent); }

}  // namespace reachlab::gui::docks
