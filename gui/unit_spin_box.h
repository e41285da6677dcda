#pragma once
#include <QDoubleSpinBox>

namespace reachlab {

/// A number with its unit behind it; as many decimals as it needs, steps of a tenth of its size, told only when done.
class UnitSpinBox : public QDoubleSpinBox {
  Q_OBJECT
 public:
  UnitSpinBox(double low, double high, const QString& unit, QWidget* parent = nullptr);
  /// Displays; emits nothing.
  void show(double value);
  QString textFromValue(double value) const override;

 private:
  using QDoubleSpinBox::show;
};

}  // namespace reachlab
