#include "gui/unit_spin_box.h"

#include <QLocale>
#include <QSignalBlocker>

namespace reachlab {

UnitSpinBox::UnitSpinBox(double low, double high, const QString& unit, QWidget* parent) : QDoubleSpinBox(parent) {
  setDecimals(9);
  setRange(low, high);
  if (!unit.isEmpty()) setSuffix(QLatin1Char(' ') + unit);
  setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  setKeyboardTracking(false);
  setLocale(QLocale::c());
  setMinimumWidth(110);
}

void UnitSpinBox::show(double value) {
  const QSignalBlocker quiet(this);
  setValue(value);
}

QString UnitSpinBox::textFromValue(double value) const { return QString::number(value, 'g', 9); }

}  // namespace reachlab
