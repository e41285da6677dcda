#include "gui/widgets/unit_spin_box.h"

#include <QLineEdit>
#include <QLocale>
#include <QSignalBlocker>
#include <algorithm>
#include <utility>

#include "gui/widgets/theme.h"

namespace reachlab::gui::widgets {

UnitSpinBox::UnitSpinBox(double low, double high, const QString& unit, QWidget* parent) : QDoubleSpinBox(parent), low_(low), high_(high) {
  setDecimals(9);
  setRange(low, high);
  if (!unit.isEmpty()) setSuffix(QLatin1Char(' ') + unit);
  setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  setKeyboardTracking(false);
  QLocale numbers = QLocale::c();
  numbers.setNumberOptions(QLocale::OmitGroupSeparator | QLocale::RejectGroupSeparator);
  setLocale(numbers);
  setMinimumWidth(110);
  connect(lineEdit(), &QLineEdit::textEdited, this, &UnitSpinBox::check);
  connect(this, &QAbstractSpinBox::editingFinished, this, [this] {
    if (!std::exchange(wrong_, false)) return;
    setStyleSheet({});
    fault_ += QStringLiteral("; %1 is kept").arg(withUnit(value()));
    Q_EMIT checked();
  });
}

void UnitSpinBox::show(double value) {
  const QSignalBlocker quiet(this);
  wrong_ = false;
  fault_.clear();
  setStyleSheet({});
  setRange(std::min(low_, value), std::max(high_, value));
  setValue(value);
}

QString UnitSpinBox::textFromValue(double value) const { return QString::number(value, 'g', 9); }

// Every key is taken: an entry that is swallowed without a word looks like a broken keyboard.
QValidator::State UnitSpinBox::validate(QString& text, int&) const {
  return read(text) ? QValidator::Acceptable : QValidator::Intermediate;
}

double UnitSpinBox::valueFromText(const QString& text) const { return read(text).value_or(value()); }

QString UnitSpinBox::withoutUnit(const QString& text) const {
  return (text.endsWith(suffix()) ? text.left(text.size() - suffix().size()) : text).trimmed();
}

// What may stand here; a number out of range may not.
std::optional<double> UnitSpinBox::read(const QString& text) const {
  bool fine = false;
  const double number = locale().toDouble(withoutUnit(text), &fine);
  return fine && number >= minimum() && number <= maximum() ? std::optional(number) : std::nullopt;
}

QString UnitSpinBox::withUnit(double value) const { return textFromValue(value) + suffix(); }

void UnitSpinBox::check() {
  wrong_ = !read(text());
  fault_.clear();
  if (wrong_) {
    const QString bare = withoutUnit(text());
    bool isNumber = false;
    const double number = locale().toDouble(bare, &isNumber);
    fault_ = QStringLiteral("%1: %2; allowed: %3 to %4")
                 .arg(accessibleName(),
                      isNumber         ? withUnit(number)
                      : bare.isEmpty() ? "nothing"
                                       : QStringLiteral("\"%1\" is no number").arg(bare),
                      textFromValue(minimum()), withUnit(maximum()));
  }
  setStyleSheet(wrong_ ? QStringLiteral("color: %1;").arg(faultInk().name()) : QString());
  Q_EMIT checked();
}

}  // namespace reachlab::gui::widgets
