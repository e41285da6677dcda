#pragma once
#include <QDockWidget>
#include <map>
#include <string>

#include "constraints/constraint.h"

class QLabel;

namespace reachlab::gui::widgets {
class FaultLabel;
class ShapeSliders;
}  // namespace reachlab::gui::widgets

namespace reachlab::gui::docks {

/// The constraint in use: its name, its shape's sliders, and the way to another. Knows definitions, not the simulator.
class ConstraintDock : public QDockWidget {
  Q_OBJECT
 public:
  explicit ConstraintDock(QWidget* parent = nullptr);
  void setConstraint(const constraints::ConstraintSpec& spec, const constraints::Constraint& constraint);
  void setFaults(const QStringList& faults);

 Q_SIGNALS:
  void shapeMoved(const std::map<std::string, double>& shape);
  void chooseRequested();

 private:
  QLabel *name_, *formula_;
  widgets::FaultLabel* faults_;
  widgets::ShapeSliders* sliders_;
  constraints::ConstraintSpec shown_;
};

}  // namespace reachlab::gui::docks
