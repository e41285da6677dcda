#pragma once
#include <QGroupBox>

#include "gui/widgets/qt_names.h"
#include "sim/session/mix/trial_mix.h"

namespace reachlab::gui::widgets {
class UnitSpinBox;
}

namespace reachlab::gui::plan {

/// The kinds and targets of a block's trials: one row per kind with its count in a cycle, its rules and its changes, then targets, order and
/// way back. Changes and targets are entered as they are written in the plan's file.
class MixEditor : public QGroupBox {
  Q_OBJECT
 public:
  explicit MixEditor(QWidget* parent = nullptr);
  /// Displays the mix and emits nothing.
  void show(const session::TrialMix& mix);
  /// The mix as it is entered. A text that cannot be read leaves its part as it was shown.
  const session::TrialMix& mix() const { return mix_; }
  /// Texts and numbers that cannot be read, one line each.
  QStringList faults() const;

 Q_SIGNALS:
  void changed();

 private:
  using QGroupBox::show;
  enum Column { kName, kCount, kNotFirst, kNotTwice, kChanges, kColumns };
  QWidget* makeKinds();
  QWidget* makeTargets();
  void showKinds();
  void showTargets();
  void enableTargets();
  void take();
  void takeKinds();
  void takeTargets();

  session::TrialMix mix_;
  QStringList faults_;  // of the texts
  bool showing_ = false;
  QTableWidget* kinds_;
  QPushButton* remove_;
  QComboBox *targets_, *order_;
  QSpinBox* count_;
  widgets::UnitSpinBox *radius_, *first_;
  QLineEdit* list_;
  QCheckBox* wayBack_;
};

}  // namespace reachlab::gui::plan
