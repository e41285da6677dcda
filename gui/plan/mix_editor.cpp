#include "gui/plan/mix_editor.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "base/fault.h"
#include "base/json/json_reader.h"
#include "gui/widgets/fault_words.h"
#include "gui/widgets/named.h"
#include "gui/widgets/text_table.h"
#include "gui/widgets/unit_spin_box.h"

namespace reachlab::gui::plan {
namespace {

enum Targets { kOwn, kRing, kList };

int countOf(const std::string& kind, const std::vector<session::KindCount>& cycle) {
  int count = 0;
  for (const session::KindCount& some : cycle) count += some.kind == kind ? some.count : 0;
  return count;
}

/// `{"mix_key": TEXT}` read as a plan's block is read. The faults of the text are appended.
session::TrialMix readText(const char* key, const QString& text, QStringList& faults) {
  session::TrialMix read;
  try {
    const JsonNode root = parseJson("{ \"" + std::string(key) + "\": " + text.toStdString() + " }", "");
    FaultList list("");
    ObjectReader reader(list, root, "");
    session::readMix(reader, read);
    list.throwIfAny();
  } catch (const FaultError& error) {
    for (Fault fault : error.faults) {
      fault.place.reset();
      faults << widgets::inWords(fault);
    }
  }
  return read;
}

QString changesText(const session::TrialKind& kind) {
  QStringList changes;
  for (const experiment::Patch& change : kind.changes)
    changes << QStringLiteral("\"%1\": %2").arg(QString::fromStdString(change.path), QString::fromStdString(change.value));
  return changes.join(QStringLiteral(", "));
}

QString listText(const std::vector<std::vector<double>>& targets) {
  QStringList all;
  for (const std::vector<double>& target : targets) {
    QStringList numbers;
    for (const double number : target) numbers << QString::number(number, 'g', 15);
    all << QStringLiteral("[%1]").arg(numbers.join(QStringLiteral(", ")));
  }
  return all.join(QStringLiteral(", "));
}

}  // namespace

MixEditor::MixEditor(QWidget* parent) : QGroupBox(tr("Kinds of trials and targets of this block"), parent) {
  setObjectName(QStringLiteral("planMix"));
  auto* columns = new QHBoxLayout(this);
  columns->addWidget(makeKinds(), 3);
  columns->addWidget(makeTargets(), 2);
  connect(kinds_, &QTableWidget::itemChanged, this, &MixEditor::take);
  connect(kinds_, &QTableWidget::itemSelectionChanged, this, [this] { remove_->setEnabled(kinds_->currentRow() >= 0); });
  for (QComboBox* box : {targets_, order_}) connect(box, qOverload<int>(&QComboBox::currentIndexChanged), this, &MixEditor::take);
  connect(count_, qOverload<int>(&QSpinBox::valueChanged), this, &MixEditor::take);
  for (widgets::UnitSpinBox* box : {radius_, first_}) {
    connect(box, qOverload<double>(&QDoubleSpinBox::valueChanged), this, &MixEditor::take);
    connect(box, &widgets::UnitSpinBox::checked, this, &MixEditor::changed);
  }
  connect(list_, &QLineEdit::editingFinished, this, &MixEditor::take);
  connect(wayBack_, &QCheckBox::toggled, this, &MixEditor::take);
  show({});
}

QWidget* MixEditor::makeKinds() {
  auto* whole = new QWidget;
  auto* column = widgets::filling<QVBoxLayout>(whole);
  kinds_ = widgets::named<QTableWidget>("planKinds", 0, kColumns);
  kinds_->setHorizontalHeaderLabels({tr("kind"), tr("in a cycle"), tr("not first"), tr("not twice"), tr("changes to the experiment")});
  kinds_->horizontalHeaderItem(kChanges)->setToolTip(tr("as in the plan's file: \"object.masses_kg[0]\": 2, \"environment\": []"));
  kinds_->horizontalHeaderItem(kCount)->setToolTip(tr("trials of this kind in each cycle; 0: none in this block"));
  kinds_->verticalHeader()->hide();
  kinds_->verticalHeader()->setDefaultSectionSize(24);
  kinds_->setSelectionMode(QAbstractItemView::SingleSelection);
  kinds_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  kinds_->horizontalHeader()->setStretchLastSection(true);
  kinds_->setMinimumHeight(100);
  kinds_->setTabKeyNavigation(false);  // Tab goes on to the next field
  column->addWidget(kinds_, 1);
  auto* add = widgets::named<QPushButton>("planAddKind", tr("Add kind"));
  remove_ = widgets::named<QPushButton>("planRemoveKind", tr("Remove kind"));
  column->addLayout(widgets::rowOf({add, remove_, nullptr}));
  connect(add, &QPushButton::clicked, this, [this] {
    std::string name = "kind1";
    for (int number = 2; std::ranges::count(mix_.kinds, name, &session::TrialKind::name) > 0; ++number)
      name = "kind" + std::to_string(number);
    if (!mix_.cycle.empty()) mix_.cycle.push_back({name, 1});
    mix_.kinds.push_back({name, {}});
    showKinds();
    Q_EMIT changed();
  });
  connect(remove_, &QPushButton::clicked, this, [this] {
    const int row = kinds_->currentRow();
    if (row < 0) return;
    const std::string name = mix_.kinds[static_cast<std::size_t>(row)].name;
    mix_.kinds.erase(mix_.kinds.begin() + row);
    std::erase_if(mix_.cycle, [&](const session::KindCount& some) { return some.kind == name; });
    std::erase(mix_.notFirst, name);
    std::erase(mix_.notTwice, name);
    showKinds();
    Q_EMIT changed();
  });
  return whole;
}

QWidget* MixEditor::makeTargets() {
  auto* whole = new QWidget;
  auto* form = widgets::filling<QFormLayout>(whole);
  targets_ = widgets::named<QComboBox>("planTargets");
  targets_->addItems({tr("the experiment's target"), tr("a ring around the start"), tr("a list of places")});
  count_ = widgets::named<QSpinBox>("planRingCount");
  count_->setRange(1, 360);
  radius_ = widgets::named<widgets::UnitSpinBox>("planRingRadius", 0.001, 10, QStringLiteral("m"));
  first_ = widgets::named<widgets::UnitSpinBox>("planRingFirst", -360, 360, QStringLiteral("°"));
  radius_->setName(tr("radius of the ring"));
  first_->setName(tr("direction of target 1"));
  first_->setToolTip(tr("direction of target 1, counterclockwise from the right"));
  list_ = widgets::named<QLineEdit>("planTargetList");
  list_->setPlaceholderText(QStringLiteral("[0.1, 0, 0], [0, 0, -0.1]"));
  order_ = widgets::named<QComboBox>("planOrder");
  order_->addItems({tr("as written"), tr("shuffled in each cycle"), tr("shuffled over the block")});
  wayBack_ = widgets::named<QCheckBox>("planWayBack", tr("the way back is a trial"));
  form->addRow(tr("targets"), targets_);
  form->addRow(tr("ring"), widgets::rowOf({count_, new QLabel(tr("at")), radius_, new QLabel(tr("from")), first_}));
  form->addRow(tr("places"), list_);
  form->addRow(tr("order"), order_);
  form->addRow(wayBack_);
  return whole;
}

void MixEditor::show(const session::TrialMix& mix) {
  mix_ = mix;
  faults_.clear();
  showKinds();
  showTargets();
}

QStringList MixEditor::faults() const {
  QStringList all = faults_;
  for (const widgets::UnitSpinBox* box : {radius_, first_})
    if (box->isEnabled()) all << box->fault();
  all.removeAll({});
  return all;
}

void MixEditor::showKinds() {
  showing_ = true;
  kinds_->setRowCount(static_cast<int>(mix_.kinds.size()));
  const std::vector<session::KindCount> cycle = session::cycleOf(mix_);
  for (int row = 0; row < kinds_->rowCount(); ++row) {
    const session::TrialKind& kind = mix_.kinds[static_cast<std::size_t>(row)];
    widgets::setTexts(*kinds_, row,
                      {QString::fromStdString(kind.name), QString::number(countOf(kind.name, cycle)), {}, {}, changesText(kind)});
    for (const auto& [column, names] : {std::pair{kNotFirst, &mix_.notFirst}, {kNotTwice, &mix_.notTwice}}) {
      QTableWidgetItem* item = kinds_->item(row, column);
      item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
      item->setCheckState(std::ranges::find(*names, kind.name) == names->end() ? Qt::Unchecked : Qt::Checked);
    }
  }
  remove_->setEnabled(kinds_->currentRow() >= 0 && kinds_->rowCount() > 0);
  showing_ = false;
}

void MixEditor::showTargets() {
  showing_ = true;
  const session::TargetRing ring = mix_.ring.value_or(session::TargetRing());
  targets_->setCurrentIndex(mix_.ring ? kRing : mix_.targets.empty() ? kOwn : kList);
  count_->setValue(ring.count);
  radius_->show(ring.radius);
  first_->show(ring.firstDegrees);
  list_->setText(listText(mix_.targets));
  order_->setCurrentIndex(static_cast<int>(mix_.order));
  wayBack_->setChecked(mix_.wayBack);
  enableTargets();
  showing_ = false;
}

void MixEditor::enableTargets() {
  for (QWidget* field : std::initializer_list<QWidget*>{count_, radius_, first_}) field->setEnabled(targets_->currentIndex() == kRing);
  list_->setEnabled(targets_->currentIndex() == kList);
}

void MixEditor::take() {
  if (showing_) return;
  faults_.clear();
  takeKinds();
  takeTargets();
  Q_EMIT changed();
}

// A mix that names a kind twice, which only a file can, is kept while the counts of its kinds are.
void MixEditor::takeKinds() {
  const std::vector<session::KindCount> before = session::cycleOf(mix_);
  std::vector<session::KindCount> cycle;
  bool counted = false;
  std::vector<std::pair<std::string, std::string>> renamed;
  mix_.notFirst.clear();
  mix_.notTwice.clear();
  for (int row = 0; row < kinds_->rowCount(); ++row) {
    session::TrialKind& kind = mix_.kinds[static_cast<std::size_t>(row)];
    const std::string name = kinds_->item(row, kName)->text().trimmed().toStdString();
    if (name != kind.name) renamed.emplace_back(kind.name, name);
    const int had = countOf(kind.name, before);
    bool isNumber = false;
    const int count = kinds_->item(row, kCount)->text().toInt(&isNumber);
    if (!isNumber || count < 0) faults_ << tr("%1: the count in a cycle is no whole number from 0").arg(QString::fromStdString(name));
    counted = counted || (isNumber && count != had);
    if (count > 0) cycle.push_back({name, count});
    kind.name = name;
    if (kinds_->item(row, kNotFirst)->checkState() == Qt::Checked) mix_.notFirst.push_back(name);
    if (kinds_->item(row, kNotTwice)->checkState() == Qt::Checked) mix_.notTwice.push_back(name);
    const QString changes = kinds_->item(row, kChanges)->text().trimmed();
    if (changes == changesText(kind)) continue;
    const session::TrialMix read =
        readText("kinds", QStringLiteral("{ \"%1\": { %2 } }").arg(QString::fromStdString(name), changes), faults_);
    if (!read.kinds.empty()) kind.changes = read.kinds.front().changes;
  }
  for (const auto& [old, name] : renamed)
    for (session::KindCount& some : mix_.cycle)
      if (some.kind == old) some.kind = name;
  if (counted) mix_.cycle = cycle;
}

void MixEditor::takeTargets() {
  const int kind = targets_->currentIndex();
  mix_.ring.reset();
  if (kind == kRing) mix_.ring = session::TargetRing{count_->value(), radius_->value(), first_->value()};
  const QString places = list_->text().trimmed();
  if (kind != kList) mix_.targets.clear();
  else if (places.isEmpty()) faults_ << tr("targets: there is no place yet");
  else if (places != listText(mix_.targets)) {
    QStringList faults;
    const session::TrialMix read = readText("targets", QStringLiteral("[%1]").arg(places), faults);
    if (faults.isEmpty()) mix_.targets = read.targets;
    faults_ << faults;
  }
  mix_.order = static_cast<session::TrialOrder>(order_->currentIndex());
  mix_.wayBack = wayBack_->isChecked();
  enableTargets();
}

}  // namespace reachlab::gui::plan
