#pragma once
#include "gui/docks/dock.h"

class QLabel;

namespace reachlab::gui::widgets {
class ShapeSliders;
}  // namespace reachlab::gui::widgets

namespace reachlab::gui::docks {

class ConstraintChooser;

/// The constraint in use: its name, its shape's sliders, and the way to another. Knows definitions, not the simulator.
class ConstraintDock : public Dock {
  Q_OBJECT
 public:
  explicit ConstraintDock(QWidget* parent = nullptr);
  /// The dialog with the catalogue, for the experiment that is shown; nothing where it may not be edited.
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
