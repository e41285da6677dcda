#pragma once
#include <string>

#include "gui/docks/dock.h"
#include "gui/plot/velocity_plot.h"

namespace reachlab::gui::docks {

/// Holds the plot of the trial under way, with the task's window in time.
class VelocityDock : public Dock {
  Q_OBJECT
 public:
  explicit VelocityDock(QWidget* parent = nullptr);
  plot::VelocityPlot& plot() { return *plot_; }

 protected:
  void display(const experiment::CompiledExperiment& experiment, bool editable) override;

 private:
  plot::VelocityPlot* plot_;
  std::string name_;  // of the experiment whose trials are drawn
};

}  // namespace reachlab::gui::docks
