#pragma once
#include <QWidget>
#include <array>
#include <string>
#include <vector>

#include "constraints/catalogue/definition.h"
#include "gui/widgets/fault_label.h"
#include "gui/widgets/qt_names.h"

namespace reachlab::gui::docks {

/// Names in the formulas that are neither variables, constants nor functions: the shape parameters, in order of appearance.
std::vector<std::string> parameterNames(constraints::ConstraintKind kind, const std::array<std::string, 3>& coordinates);

/// The variable that was probably meant by a parameter's name: one letter differs, or only capitals differ. Empty if there is no such
/// variable.
std::string variableMeant(constraints::ConstraintKind kind, const std::string& name);

/// Three lines of formula with the fault of each under it, at the character where it went wrong. Knows no scene.
class FormulaEditor : public QWidget {
  Q_OBJECT
 public:
  explicit FormulaEditor(QWidget* parent = nullptr);
  void setFormula(constraints::ConstraintKind kind, const std::array<std::string, 3>& coordinates);
  constraints::ConstraintKind kind() const;
  std::array<std::string, 3> coordinates() const;
  /// True when every line can be compiled.
  bool fine() const { return fine_; }
  /// A fault of the whole formula, found beyond its text: degenerate everywhere or not finite somewhere. Empty if there is no fault.
  void setFault(const QString& fault);

 Q_SIGNALS:
  void changed();

 private:
  void check();

  QComboBox* kind_;
  std::array<QLineEdit*, 3> lines_{};
  std::array<widgets::FaultLabel*, 3> faults_{};
  widgets::FaultLabel* fault_;
  bool fine_ = true;
};

}  // namespace reachlab::gui::docks
