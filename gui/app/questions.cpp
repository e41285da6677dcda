#include "gui/app/questions.h"

#include <QMessageBox>
#include <QPushButton>

namespace reachlab::gui::app {

bool askToEndRun(QWidget& window, const QString& doing, std::size_t trialsDone, std::size_t trialsPlanned) {
  QMessageBox box(QMessageBox::Question, QStringLiteral("A run is open"),
                  QStringLiteral("%1 of %2 trials are done. %3 ends the run. The recorded trials are kept.")
                      .arg(trialsDone)
                      .arg(trialsPlanned)
                      .arg(doing),
                  QMessageBox::NoButton, &window);
  box.setObjectName(QStringLiteral("askToEndRun"));
  const auto* end = box.addButton(QStringLiteral("End the run"), QMessageBox::AcceptRole);
  box.setDefaultButton(box.addButton(QStringLiteral("Continue it"), QMessageBox::RejectRole));
  box.exec();
  return box.clickedButton() == end;
}

Unsaved askAboutUnsaved(QWidget& window, const QString& experiment) {
  QMessageBox box(QMessageBox::Question, QStringLiteral("Unsaved changes"),
                  QStringLiteral("%1 was changed, and the file is not saved. Recordings keep the experiment with which they were made.")
                      .arg(experiment),
                  QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, &window);
  box.setObjectName(QStringLiteral("askAboutUnsaved"));
  box.setDefaultButton(QMessageBox::Save);
  switch (box.exec()) {
    case QMessageBox::Save: return Unsaved::Save;
    case QMessageBox::Discard: return Unsaved::Discard;
    default: return Unsaved::Cancel;
  }
}

}  // namespace reachlab::gui::app
