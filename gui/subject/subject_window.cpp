#include "gui/subject/subject_window.h"

#include <QCloseEvent>
#include <QGuiApplication>
#include <QScreen>
#include <QVBoxLayout>

namespace reachlab::gui::subject {

SubjectWindow::SubjectWindow(QWidget* parent) : QWidget(parent, Qt::Window) {
  setWindowTitle(QStringLiteral("Reachlab – subject"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  view_ = new scene::SceneView;
  view_->setTextScale(1.8);
  layout->addWidget(view_);
  setCursor(Qt::BlankCursor);
}

void SubjectWindow::showFull() {
  const QList<QScreen*> screens = QGuiApplication::screens();
  if (screens.size() > 1) setGeometry(screens[1]->geometry());
  showFullScreen();
}

void SubjectWindow::closeEvent(QCloseEvent* event) {
  QWidget::closeEvent(event);
  Q_EMIT closed();
}

}  // namespace reachlab::gui::subject
