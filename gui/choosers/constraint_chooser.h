#pragma once
#include <QDialog>
#include <optional>
#include <vector>

#include "constraints/catalogue/definition.h"
#include "gui/choosers/formula_editor.h"
#include "gui/scene/scene_view.h"
#include "gui/widgets/fault_label.h"
#include "gui/widgets/qt_names.h"
#include "gui/widgets/shape_sliders.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::docks {

/// A choice with everything that an experiment needs to use it.
struct ConstraintChoice {
  constraints::ConstraintSpec spec;
  std::vector<double> start, target;
  bool withPoint = false;  // the object becomes one mass of the same weight
};

/// Dialog that chooses a constraint from a searchable list with thumbnails and sliders, or from a typed formula. Both show a live picture.
/// A typed formula can be saved as a definition. "Use" takes effect at once, without a restart.
class ConstraintChooser : public QDialog {
  Q_OBJECT
 public:
  explicit ConstraintChooser(QWidget* parent = nullptr);
  /// Shows the constraint in use.
  void setCurrent(const experiment::Experiment& experiment);
  /// Why the present object cannot move on the choice. If only the number of masses is the reason, a single mass is offered. Empty: the
  /// choice was taken, and the dialog closes.
  void answer(const QStringList& faults);
  /// The present choice. nullopt while it has a fault.
  std::optional<ConstraintChoice> choice() const { return choice_; }

 Q_SIGNALS:
  void used(const reachlab::gui::docks::ConstraintChoice& choice);

 private:
  QVBoxLayout* makeList();
  QVBoxLayout* makePicture();
  QWidget* makeSide();
  void wire();
  void fillList();
  void filter(const QString& words);
  void show(const constraints::Definition& definition, const std::map<std::string, double>& shape);
  void formulaChanged();
  void rebuild(bool resetCamera);
  void save();
  constraints::Definition typedDefinition() const;
  bool isTyped() const;

  std::vector<constraints::Definition> definitions_;
  constraints::Definition current_;
  experiment::Experiment probe_;  // one mass on the constraint, for the picture
  std::optional<ConstraintChoice> choice_;
  QLineEdit *search_, *name_;
  QListWidget* list_;
  scene::SceneView* preview_;
  widgets::ShapeSliders* sliders_;
  FormulaEditor* formula_;
  QLabel *title_, *sentence_, *saved_;
  widgets::FaultLabel* refusal_;
  QPushButton *use_, *usePoint_, *save_;
  bool severalMasses_ = false;
};

}  // namespace reachlab::gui::docks
