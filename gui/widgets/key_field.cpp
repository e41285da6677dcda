#include "gui/widgets/key_field.h"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <algorithm>

#include "gui/widgets/named.h"

namespace reachlab::gui::widgets {

KeyField::KeyField(const QString& name, const QString& unit, const NumberRange& range, const KeyForm& form) {
  auto* row = filling<QHBoxLayout>(this);
  if (form.optional) {
    given_ = new QCheckBox;
    given_->setAccessibleName(name);
    row->addWidget(given_);
    connect(given_, &QCheckBox::toggled, this, [this] {
      enableNumbers();
      Q_EMIT edited();
    });
  }
  if (!form.choices.isEmpty()) {
    choice_ = new QComboBox;
    choice_->setAccessibleName(name);
    choice_->addItems(form.choices);
    row->addWidget(choice_);
    connect(choice_, qOverload<int>(&QComboBox::currentIndexChanged), this, &KeyField::edited);
  }
  auto* grid = new QGridLayout;
  grid->setSpacing(3);
  row->addLayout(grid, 1);
  const bool single = form.rows * form.columns == 1;
  for (int i = 0; i < form.rows; ++i)
    for (int j = 0; j < form.columns; ++j) {
      auto* box = new UnitSpinBox(range.lo, range.hi, single ? unit : QString());
      const QString at = form.rows > 1 ? QStringLiteral(" %1, %2").arg(i + 1).arg(j + 1) : QStringLiteral(" %1").arg(QLatin1Char("xyz"[j]));
      box->setName(single ? name : name + at);
      if (!single) box->setMinimumWidth(54), box->setButtonSymbols(QAbstractSpinBox::NoButtons);
      grid->addWidget(box, i, j);
      numbers_.push_back(box);
      connect(box, qOverload<double>(&QDoubleSpinBox::valueChanged), this, &KeyField::edited);
      connect(box, &UnitSpinBox::checked, this, &KeyField::checked);
    }
  enableNumbers();
}

void KeyField::enableNumbers() {
  for (UnitSpinBox* box : numbers_) box->setEnabled(given_ == nullptr || given_->isChecked());
}

void KeyField::show(const std::vector<double>& value) {
  if (given_ != nullptr) {
    quietly(given_)->setChecked(!value.empty());
    enableNumbers();
  }
  std::size_t next = 0;
  if (choice_ != nullptr) quietly(choice_)->setCurrentIndex(value.empty() ? 0 : static_cast<int>(value[next++]));
  for (UnitSpinBox* box : numbers_) box->show(next < value.size() ? value[next++] : std::clamp(0.0, box->minimum(), box->maximum()));
}

std::vector<double> KeyField::value() const {
  std::vector<double> value;
  if (given_ != nullptr && !given_->isChecked()) return value;
  if (choice_ != nullptr) value.push_back(choice_->currentIndex());
  for (const UnitSpinBox* box : numbers_) value.push_back(box->value());
  return value;
}

QString KeyField::fault() const {
  QStringList lines;
  for (const UnitSpinBox* box : numbers_) lines << box->fault();
  lines.removeAll({});
  return lines.join(QLatin1Char('\n'));
}

}  // namespace reachlab::gui::widgets
