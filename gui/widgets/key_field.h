#pragma once
#include <QWidget>
#include <vector>

#include "base/number_range.h"
#include "gui/widgets/qt_names.h"
#include "gui/widgets/unit_spin_box.h"

namespace reachlab::gui::widgets {

/// The form of a key's value.
struct KeyForm {
  int rows = 1, columns = 1;  // of its numbers
  bool optional = false;      // a box before them says whether it is given
  QStringList choices = {};   // before its numbers, one of these
};

/// A key of a file as a field: a number, a vector, a matrix or a choice. Its value is a list: the index of the choice, then the numbers row by
/// row. The list is empty where an optional key is not given.
class KeyField : public QWidget {
  Q_OBJECT
 public:
  /// `name`: in messages. `unit`: beside a single number. Several numbers have it in the label of their row.
  KeyField(const QString& name, const QString& unit, const NumberRange& range, const KeyForm& form);
  /// Displays the value and emits nothing.
  void show(const std::vector<double>& value);
  std::vector<double> value() const;
  /// The faults of the numbers, a line each. Empty if there is no fault.
  QString fault() const;

 Q_SIGNALS:
  void edited();
  /// Emitted at every keystroke, because `fault` may have changed.
  void checked();

 private:
  using QWidget::show;
  void enableNumbers();

  QCheckBox* given_ = nullptr;
  QComboBox* choice_ = nullptr;
  std::vector<UnitSpinBox*> numbers_;
};

}  // namespace reachlab::gui::widgets
