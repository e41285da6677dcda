#pragma once
#include <QWidget>

#include "gui/widgets/qt_names.h"
#include "sim/record/trial_marks.h"

namespace reachlab::gui::inspector {

/// The marks of one trial: flag, exclusion with its reason, moved onset and end, and a note.
class MarksPanel : public QWidget {
  Q_OBJECT
 public:
  explicit MarksPanel(QWidget* parent = nullptr);
  /// Displays the marks and emits nothing. `title` names the trial. `onset` and `end` are the valid times [s] since arming, moved or not.
  void show(const QString& title, const record::TrialMark& mark, double onset, double end);
  void clear();

 Q_SIGNALS:
  void edited(const reachlab::record::TrialMark& mark);

 private:
  using QWidget::show;
  void tell();

  record::TrialMark mark_;
  QLabel *title_, *times_;
  QCheckBox *flag_, *exclude_;
  QLineEdit *reason_, *note_;
  QPushButton* byRule_;
};

}  // namespace reachlab::gui::inspector
