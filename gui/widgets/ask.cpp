#include "gui/widgets/ask.h"

#include <QMessageBox>

namespace reachlab::gui::widgets {

bool ask(QWidget& window, const char* name, const QString& title, const QString& text, const QString& yes, const QString& no) {
  QMessageBox box(QMessageBox::Question, title, text, QMessageBox::NoButton, &window);
  box.setObjectName(QLatin1String(name));
  const auto* agreed = box.addButton(yes, QMessageBox::AcceptRole);
  box.setDefaultButton(box.addButton(no, QMessageBox::RejectRole));
  box.exec();
  return box.clickedButton() == agreed;
}

bool askToSave(QWidget& window, const QString& text, const std::function<bool()>& save) {
  QMessageBox box(QMessageBox::Question, QStringLiteral("Unsaved changes"), text,
                  QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, &window);
  box.setObjectName(QStringLiteral("askAboutUnsaved"));
  box.setDefaultButton(QMessageBox::Save);
  const int answer = box.exec();
  return answer == QMessageBox::Discard || (answer == QMessageBox::Save && save());
}

}  // namespace reachlab::gui::widgets
