#include "gui/docks/constraint_dock.h"

#include <QPushButton>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/error.h"
#include "constraints/constraint.h"
#include "gui/scene_plan/definition_reach.h"
#include "gui/widgets/named.h"

namespace reachlab::gui::docks {
namespace {

// Of the catalogue or the user's own folder; none while a file of it cannot be read.
std::optional<constraints::Definition> definitionOf(const constraints::ConstraintSpec& spec) {
  if (!spec.curve.empty() || !spec.surface.empty() || spec.name == "free") return {};
  try {
    return constraints::findDefinition(spec.name, "constraint");
  } catch (const Error&) {
    return {};
  }
}

// A typed formula's own names: a slider from minus twice to twice what they are.
std::vector<constraints::ShapeParameter> parametersOf(const constraints::ConstraintSpec& spec) {
  if (spec.curve.empty() && spec.surface.empty()) {
    const std::optional<constraints::Definition> definition = definitionOf(spec);
    return definition ? definition->shape : std::vector<constraints::ShapeParameter>{};
  }
  std::vector<constraints::ShapeParameter> parameters;
  for (const auto& [name, value] : spec.shape) {
    const double reach = std::max(2 * std::abs(value), 0.1);
    parameters.push_back({name, value, -reach, reach, "1", "typed"});
  }
  return parameters;
}

// One mass as heavy as all together, held as the driven one was.
void becomePoint(experiment::Experiment& experiment) {
  experiment::Object& object = experiment.object;
  object.masses = {std::accumulate(object.masses.begin(), object.masses.end(), 0.0)};
  object.kind = experiment::ObjectKind::Point;
  object.stiffness.clear();
  object.damping.clear();
  if (!experiment.coupling) experiment.coupling = scene::kNewCoupling;
}

bool sameFormula(const constraints::ConstraintSpec& a, const constraints::ConstraintSpec& b) {
  return a.name == b.name && a.curve == b.curve && a.surface == b.surface;
}

}  // namespace

ConstraintDock::ConstraintDock(QWidget* parent) : Dock("Constraint", "constraintDock", parent) {
  name_ = new QLabel;
  formula_ = widgets::roleLabel("quiet");
  sliders_ = new widgets::ShapeSliders;
  auto* another = widgets::tipped(widgets::named<QPushButton>("choose", "Choose or type another…  (Ctrl+K)"),
                                  "shows the catalogue of curves and surfaces, and takes a formula of your own");
  another->setFocusPolicy(Qt::NoFocus);
  setBody(widgets::columnOf({name_, formula_, sliders_, faults(), another, nullptr}));
  faults()->watch(sliders_);
  connect(sliders_, &widgets::ShapeSliders::moved, this, [this] {
    inSliders_.shape = sliders_->values();
    edit("shape", [this](experiment::Experiment& e) { e.constraint.shape = inSliders_.shape; });
  });
  connect(another, &QPushButton::clicked, this, &ConstraintDock::choose);
}

void ConstraintDock::display(const experiment::CompiledExperiment& experiment, bool editable) {
  const constraints::ConstraintSpec& spec = experiment.experiment().constraint;
  const constraints::Constraint& constraint = experiment.constraint();
  body()->setEnabled(editable);
  editable_ = editable;
  const char* kind = constraint.kind == constraints::ConstraintKind::Surface ? "surface"
                     : constraint.kind == constraints::ConstraintKind::Curve ? "curve"
                                                                             : "no constraint";
  name_->setText(QStringLiteral("<b>%1</b>  (%2)").arg(QString::fromStdString(spec.name), QLatin1String(kind)));
  QString formula;
  for (const auto& line : spec.curve.empty() ? spec.surface : spec.curve) formula += QString::fromStdString(line) + QLatin1Char('\n');
  if (const std::optional<constraints::Definition> d = definitionOf(spec)) {
    formula = QString::fromStdString(d->sentence);
    if (formula.isEmpty())  // the user's own often have none
      for (const std::string& line : d->coordinates) formula += QString::fromStdString(line) + QLatin1Char('\n');
  }
  formula_->setText(formula.trimmed());
  formula_->setVisible(!formula.isEmpty());
  // While a slider is being moved its row must stand still.
  if (!sameFormula(spec, inSliders_) || spec.shape != sliders_->values() || !sliders_->fault().isEmpty())
    sliders_->setParameters(parametersOf(spec), spec.shape);
  inSliders_ = spec;
  faults()->hide();
}

ConstraintChooser& ConstraintDock::chooser() {
  if (chooser_ != nullptr) return *chooser_;
  chooser_ = new ConstraintChooser(this);
  connect(chooser_, &ConstraintChooser::used, this, [this](const ConstraintChoice& choice) {
    edit("constraint", [&](experiment::Experiment& e) {
      e.constraint = choice.spec;
      if (!e.task) e.task = experiment::Task{};
      e.task->start = choice.start;
      e.task->target = choice.target;
      if (choice.withPoint) becomePoint(e);
    });
  });
  return *chooser_;
}

void ConstraintDock::showFaults(const QStringList& faults) {
  const bool chosen = chooser_ != nullptr && chooser_->isVisible();
  if (chosen) chooser_->answer(faults);
  Dock::showFaults(chosen ? QStringList() : faults);
}

void ConstraintDock::choose() {
  if (!editable_) return;
  chooser().setCurrent(shown());
  chooser().QDialog::show();
  chooser().raise();
}

}  // namespace reachlab::gui::docks
