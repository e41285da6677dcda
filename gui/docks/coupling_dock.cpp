#include "gui/docks/experiment_docks.h"
#include "gui/docks/form_dock.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::docks {
namespace {

class CouplingDock : public FormDock {
 public:
  explicit CouplingDock(QWidget* parent) : FormDock("Coupling", "couplingDock", parent) {
    addNumber({"stiffness", "stiffness", 0, 1e6, "N/m", "spring between the hand and the mass that it drives"}, coupling_.stiffness)
        ->setObjectName("couplingStiffness");
    addNumber({"damping", "damping", 0, 1e5, "N s/m", "damper beside this spring"}, coupling_.damping);
    endForm();
  }

 private:
  void fill(const experiment::CompiledExperiment& experiment) override {
    const std::optional<experiment::Coupling>& coupling = experiment.experiment().coupling;
    if (!coupling) body()->setEnabled(false);
    body()->setToolTip(coupling ? QString() : "the springs of a parallel object are the hand's own");
    coupling_ = coupling.value_or(experiment::Coupling());
  }
  void tell() override {
    edit("coupling", [this](experiment::Experiment& e) { e.coupling = coupling_; });
  }

  experiment::Coupling coupling_;  // as entered
};

}  // namespace

Dock* makeCouplingDock(QWidget* parent) { return new CouplingDock(parent); }

}  // namespace reachlab::gui::docks
