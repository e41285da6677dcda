#pragma once
#include "gui/choosers/constraint_chooser.h"
#include "gui/docks/dock.h"
#include "gui/widgets/shape_sliders.h"

class QLabel;

namespace reachlab::gui::docks {

/// The constraint in use: its name, its sliders, and the button for the chooser. Depends on definitions, not on the simulator.
class ConstraintDock : public Dock {
  Q_OBJECT
 public:
  explicit ConstraintDock(QWidget* parent = nullptr);
  /// Opens the dialog with the catalogue for the experiment that is shown. Does nothing if the experiment may not be edited.
  void choose();
  ConstraintChooser& chooser();  // made when first asked for
  void showFaults(const QStringList& faults) override;

 protected:
  void display(const experiment::CompiledExperiment& experiment, bool editable) override;

 private:
  QLabel *name_, *formula_;
  widgets::ShapeSliders* sliders_;
  ConstraintChooser* chooser_ = nullptr;
  constraints::ConstraintSpec inSliders_;
  bool editable_ = true;
};

}  // namespace reachlab::gui::docks
