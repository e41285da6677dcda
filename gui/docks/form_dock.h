#pragma once
#include <functional>
#include <utility>
#include <vector>

#include "gui/docks/dock.h"
#include "gui/widgets/number_list_edit.h"
#include "gui/widgets/unit_spin_box.h"

class QFormLayout;

namespace reachlab::gui::docks {

/// A dock with a form of numbers, which edit entries of the dock. An entry that was refused stays until another experiment is shown.
class FormDock : public Dock {
 protected:
  FormDock(const QString& title, const QString& name, QWidget* parent);
  /// Fills the entries with this experiment. The fields follow by themselves.
  virtual void fill(const experiment::CompiledExperiment& experiment) = 0;
  /// Tells the experiment with the entries as they are now.
  virtual void tell() = 0;

  struct NumberRow {
    QString label, name;  // `name`: in messages
    double low, high;
    QString unit, tip;
  };
  widgets::UnitSpinBox* addNumber(const NumberRow& row, double& entry);
  /// Makes the box show and edit the entry.
  void bind(widgets::UnitSpinBox* box, const QString& name, const QString& tip, double& entry);
  /// `follow`: fits the other entries to the edited list.
  widgets::NumberListEdit* addList(
      const QString& label, const char* name, const QString& tip, std::vector<double>& entry, std::function<void()> follow = [] {});
  /// After the last row: adds the faults, and makes the form the body of the dock.
  void endForm();
  QFormLayout& form() { return *form_; }

 private:
  void display(const experiment::CompiledExperiment& experiment, bool editable) final;

  QFormLayout* form_;
  std::vector<std::pair<widgets::UnitSpinBox*, double*>> numbers_;
  std::vector<std::pair<widgets::NumberListEdit*, std::vector<double>*>> lists_;
};

}  // namespace reachlab::gui::docks
