#pragma once
#include <QDoubleSpinBox>
#include <optional>

namespace reachlab::gui::widgets {

/// A number with its unit, with as many decimals as it needs and steps of a tenth of its size. A change is reported only when the entry is
/// complete. A value out of range is red while it is typed. When the field is left, the old value returns and `fault` tells the error until
/// the next entry.
class UnitSpinBox : public QDoubleSpinBox {
  Q_OBJECT
 public:
  UnitSpinBox(double low, double high, const QString& unit, QWidget* parent = nullptr);
  /// The name of the number in messages.
  void setName(const QString& name) { setAccessibleName(name); }
  /// Displays the value and emits nothing. A value out of range, which a file may have, widens the range while it is shown.
  void show(double value);
  QString textFromValue(double value) const override;
  /// Qt's own would drop a comma and read 06 out of 0,6, while it is typed and once more at the end.
  QValidator::State validate(QString& text, int& at) const override;
  double valueFromText(const QString& text) const override;
  void fixup(QString&) const override {}
  /// "time T: 0 s; allowed: 0.05 to 60 s". Empty if there is no fault.
  QString fault() const { return fault_; }

 Q_SIGNALS:
  /// Emitted at every keystroke, because `fault` may have changed.
  void checked();

 private:
  using QDoubleSpinBox::show;
  QString withUnit(double value) const;
  QString withoutUnit(const QString& text) const;
  std::optional<double> read(const QString& text) const;
  void check();

  double low_, high_;
  QString fault_;
  bool wrong_ = false;  // what is in the field now
};

}  // namespace reachlab::gui::widgets
