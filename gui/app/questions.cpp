#include "gui/app/questions.h"

#include <QMessageBox>
#include <QPushButton>

namespace reachlab::gui::app {

namespace {

// The choice that loses nothing is the usual one.
bool ask(QWidget& window, const char* name, const QString& title, const QString& text, const QString& yes, const QString& no) {
  QMessageBox box(QMessageBox::Question, title, text, QMessageBox::NoButton, &window);
  box.setObjectName(QLatin1String(name));
  const auto* agreed = box.addButton(yes, QMessageBox::AcceptRole);
  box.setDefaultButton(box.addButton(no, QMessageBox::RejectRole));
  box.exec();
  return box.clickedButton() == agreed;
}

}  // namespace

bool askToEndRun(QWidget& window, const QString& doing, std::size_t trialsDone, std::size_t trialsPlanned, const QString& folder) {
  return ask(window, "askToEndRun", "A run is open",
             QStringLiteral("%1 of %2 trials are done. %3 ends the run. The finished trials stay in %4, and Trial, Resume the session "
                            "continues with the others.")
                 .arg(trialsDone)
                 .arg(trialsPlanned)
                 .arg(doing, folder),
             "End the run", "Continue it");
}

bool askAboutDevice(QWidget& window, const QString& before, const QString& now) {
  return ask(window, "askAboutDevice", "Another device",
             QStringLiteral("This session was recorded with the device %1. You resume it with %2, and its trials may not be comparable.")
                 .arg(before, now),
             QStringLiteral("Use %1").arg(now), "Cancel");
}

Unsaved askAboutUnsaved(QWidget& window, const QString& experiment) {
  QMessageBox box(QMessageBox::Question, "Unsaved changes",
                  QStringLiteral("%1 was changed, and the file is not saved. Recordings keep the experiment with which they were made.")
                      .arg(experiment),
                  QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, &window);
  box.setObjectName("askAboutUnsaved");
  box.setDefaultButton(QMessageBox::Save);
  switch (box.exec()) {
    case QMessageBox::Save: return Unsaved::Save;
    case QMessageBox::Discard: return Unsaved::Discard;
    default: return Unsaved::Cancel;
  }
}

}  // namespace reachlab::gui::app
