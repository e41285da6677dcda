#include "gui/inspector/marks_panel.h"

#include <QCheckBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>

#include "gui/widgets/named.h"

namespace reachlab::gui::inspector {

MarksPanel::MarksPanel(QWidget* parent) : QWidget(parent) {
  auto* form = new QFormLayout(this);
  form->setContentsMargins(6, 4, 6, 4);
  form->setVerticalSpacing(4);
  title_ = new QLabel;
  title_->setStyleSheet("font-weight: 600;");
  form->addRow(title_);
  times_ = widgets::tipped(new QLabel, tr("drag the dashed lines of the picked trial to move its onset and end"));
  byRule_ = widgets::tipped(widgets::named<QPushButton>("marksByRule", tr("by the rule")), tr("onset and end as the analysis finds them"));
  form->addRow(tr("moves"), widgets::rowOf({times_, byRule_}, times_));
  flag_ = widgets::named<QCheckBox>("flag", tr("flag"));
  exclude_ = widgets::named<QCheckBox>("exclude", tr("exclude:"));
  reason_ = widgets::named<QLineEdit>("excludeReason");
  reason_->setPlaceholderText(tr("the reason, for the report"));
  QHBoxLayout* out = widgets::rowOf({flag_, exclude_, reason_}, reason_);
  out->insertSpacing(1, 12);  // two questions
  form->addRow(out);
  note_ = widgets::named<QLineEdit>("trialNote");
  form->addRow(tr("note"), note_);
  connect(flag_, &QCheckBox::toggled, this, &MarksPanel::tell);
  connect(exclude_, &QCheckBox::toggled, this, [this](bool on) {
    reason_->setEnabled(on);
    if (on && reason_->text().trimmed().isEmpty()) return reason_->setFocus();  // without a reason nothing is left out
    tell();
  });
  connect(reason_, &QLineEdit::editingFinished, this, &MarksPanel::tell);
  connect(note_, &QLineEdit::editingFinished, this, &MarksPanel::tell);
  connect(byRule_, &QPushButton::clicked, this, [this] {
    mark_.onset.reset();
    mark_.offset.reset();
    Q_EMIT edited(mark_);
  });
  clear();
}

void MarksPanel::show(const QString& title, const record::TrialMark& mark, double onset, double end) {
  const QSignalBlocker quiet[] = {QSignalBlocker(flag_), QSignalBlocker(exclude_), QSignalBlocker(reason_), QSignalBlocker(note_)};
  // The table is drawn again when fits are ready, and must not take what is being typed.
  const bool same = isEnabled() && title == title_->text(), reasonTyped = same && reason_->hasFocus(),
             noteTyped = same && note_->hasFocus();
  mark_ = mark;
  setEnabled(true);
  title_->setText(title);
  const bool found = onset == onset && end == end;
  const bool moved = mark.onset || mark.offset;
  times_->setText(!found ? tr("no movement was found")
                         : tr("%1 s to %2 s%3").arg(onset, 0, 'f', 3).arg(end, 0, 'f', 3).arg(moved ? tr(", moved by hand") : QString()));
  byRule_->setEnabled(moved);
  flag_->setChecked(mark.flagged);
  if (!reasonTyped) {
    exclude_->setChecked(!mark.excluded.empty());
    reason_->setText(QString::fromStdString(mark.excluded));
    reason_->setEnabled(!mark.excluded.empty());
  }
  if (!noteTyped) note_->setText(QString::fromStdString(mark.note));
}

void MarksPanel::clear() {
  show(tr("no trial"), {}, 0, 0);
  times_->clear();
  setEnabled(false);
}

void MarksPanel::tell() {
  if (!isEnabled()) return;
  record::TrialMark mark = mark_;
  mark.flagged = flag_->isChecked();
  mark.excluded = exclude_->isChecked() ? reason_->text().trimmed().toStdString() : std::string();
  mark.note = note_->text().trimmed().toStdString();
  if (mark == mark_) return;
  mark_ = mark;
  Q_EMIT edited(mark_);
}

}  // namespace reachlab::gui::inspector
