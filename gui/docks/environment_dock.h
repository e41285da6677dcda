#pragma once
#include <vector>

#include "gui/docks/dock.h"

class QComboBox;
class QGroupBox;
class QListWidget;
class QPushButton;

namespace reachlab::gui::widgets {
class KeyField;
}

namespace reachlab::gui::docks {

/// Edits the forces on the hand and the cursor beside it. The fields follow from the keys of an experiment's file (experiment_keys.h).
class EnvironmentDock : public Dock {
  Q_OBJECT
 public:
  explicit EnvironmentDock(QWidget* parent = nullptr);

 protected:
  void display(const experiment::CompiledExperiment& experiment, bool editable) override;

 private:
  // The fields of one kind of force, or of the cursor, in the order of its keys.
  struct Page {
    QWidget* widget = nullptr;
    std::vector<widgets::KeyField*> fields;
  };
  template <class T>
  Page makePage(const QString& name, const T& of);
  QWidget* makeForces();
  QWidget* makeCursor();
  void showForce();
  void tell(experiment::Environment forces, std::optional<experiment::Cursor> cursor);
  void tellForce();
  void tellCursor();
  std::size_t row() const;  // of the chosen force; their number if no force is chosen

  QListWidget* list_;
  QComboBox* kind_;
  QPushButton* remove_;
  std::vector<Page> kinds_;  // in the order of experiment::ForceLaw
  QGroupBox* cursorBox_;
  Page cursor_;
};

}  // namespace reachlab::gui::docks
