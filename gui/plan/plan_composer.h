#pragma once
#include <QDialog>
#include <functional>
#include <vector>

#include "gui/widgets/qt_names.h"
#include "sim/session/plan.h"

namespace reachlab::gui::widgets {
class FaultLabel;
class UnitSpinBox;
}  // namespace reachlab::gui::widgets

namespace reachlab::gui::plan {

class MixEditor;

/// Composes a session plan: blocks in their order, practice, breaks, instructions and counterbalancing. The resulting trials of subjects
/// are shown below. A plan is a file, which is saved before it is used.
class PlanComposer : public QDialog {
  Q_OBJECT
 public:
  explicit PlanComposer(QWidget* parent = nullptr);
  /// Displays a plan. `file`: its path, or empty if it is not saved yet.
  void setPlan(const session::Plan& plan, const QString& file);
  const session::Plan& plan() const { return plan_; }
  /// The faults of the plan, one line each. Empty if the plan can be used.
  QStringList faults() const;
  /// Writes it, and is then of that file. Throws FaultError for a plan that could not be run, and ResourceError. The file is then unchanged.
  void saveTo(const QString& file);
  /// Asks before changes would be lost.
  void reject() override;

 Q_SIGNALS:
  /// Saved into this file, and to be opened.
  void used(const QString& file);

 private:
  QWidget* makeList();
  QWidget* makeBlock();
  QWidget* makeWhole();
  void wire();
  int row() const;
  void showList(int select);
  void showRow(int row);
  void showBlock();
  /// A field of the block is shown by `set` and taken by `get`.
  template <typename Widget, typename Signal, typename Value, typename Get, typename Set>
  void bind(Widget* field, Signal signal, Value session::PlanBlock::*part, Get get, Set set);
  void take();       // what the fields of the block say
  void takeWhole();  // what those of the plan say
  void changed();
  bool save(bool askAlways);

  session::Plan plan_;
  QString file_;
  std::string saved_;  // text of the plan as it was shown or saved last
  bool showing_ = false;
  QTableWidget* list_;
  QPushButton *up_, *down_, *remove_, *copy_, *use_;
  QWidget* block_;
  struct Field {
    std::function<void(const session::PlanBlock&)> show;
    std::function<void(session::PlanBlock&)> take;
  };
  std::vector<Field> fields_;                   // of the block
  std::vector<widgets::UnitSpinBox*> numbers_;  // of the block
  QLineEdit* name_;
  QDoubleSpinBox* orderSeed_;  // a whole number beyond the range of QSpinBox
  QCheckBox* permute_;
  MixEditor* mix_;
  QLabel* preview_;
  widgets::FaultLabel* faultLabel_;
};

/// "subject 01: slow, moderate, fast" for the first subjects, day by day.
QString orderPreview(const session::Plan& plan, int subjects);

}  // namespace reachlab::gui::plan
