#pragma once
#include <QWidget>
#include <map>
#include <string>
#include <vector>

#include "constraints/catalogue/definition.h"
#include "gui/widgets/qt_names.h"
#include "gui/widgets/unit_spin_box.h"

namespace reachlab::gui::widgets {

/// "minor radius" for minor_radius_m: the unit is shown behind the number.
QString plainName(const constraints::ShapeParameter& parameter);

/// A slider and a number for each shape parameter of a definition. A parameter of a typed formula has no range. The ends of its slider can
/// therefore be typed as well, and a value beyond an end moves that end.
class ShapeSliders : public QWidget {
  Q_OBJECT
 public:
  explicit ShapeSliders(QWidget* parent = nullptr);
  /// Makes rows for these parameters. Missing values get their defaults. Rows that are there already stay, because one of them may be the
  /// one whose entry is answered, and they get the values.
  void setParameters(const std::vector<constraints::ShapeParameter>& parameters, const std::map<std::string, double>& values = {});
  std::map<std::string, double> values() const;
  /// With the ranges as they are now.
  std::vector<constraints::ShapeParameter> parameters() const;
  /// The faults of the numbers, one line each. Empty if there is no fault.
  QString fault() const;

 Q_SIGNALS:
  void moved();
  /// Emitted at every keystroke, because `fault` may have changed.
  void checked();

 private:
  struct Row {
    constraints::ShapeParameter parameter;
    QSlider* slider = nullptr;
    UnitSpinBox* box = nullptr;
    UnitSpinBox *low = nullptr, *high = nullptr;  // of a typed name
    int steps = 0;
  };
  bool isShown(const std::vector<constraints::ShapeParameter>& parameters) const;
  void addRow(const constraints::ShapeParameter& parameter, double value);
  void addEnds(std::size_t row, QHBoxLayout& line);
  /// Lays slider and ends around the value.
  void fit(Row& row);

  std::vector<Row> rows_;
  QWidget* body_ = nullptr;
  QFormLayout* form_ = nullptr;
};

}  // namespace reachlab::gui::widgets
