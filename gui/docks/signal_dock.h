#pragma once
#include "gui/docks/dock.h"
#include "gui/plot/signal_plot.h"

namespace reachlab::gui::docks {

/// Holds the plot of any signal of the run.
class SignalDock : public Dock {
  Q_OBJECT
 public:
  explicit SignalDock(QWidget* parent = nullptr);
  plot::SignalPlot& plot() { return *plot_; }

 protected:
  void display(const experiment::CompiledExperiment& experiment, bool editable) override;

 private:
  plot::SignalPlot* plot_;
};

}  // namespace reachlab::gui::docks
