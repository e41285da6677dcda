#include "gui/subject/subject_window.h"

#include <QGuiApplication>
#include <QScreen>
#include <QSettings>
#include <QVBoxLayout>
#include <QWindow>
#include <algorithm>

#include "gui/widgets/named.h"

namespace reachlab::gui::subject {
namespace {

QString screenKey() { return "subject/screen"; }

QScreen* screenNamed(const QString& name) {
  for (QScreen* screen : QGuiApplication::screens())
    if (screen->name() == name) return screen;
  return nullptr;
}

}  // namespace

QString titleOf(const QScreen& screen) {
  const QSizeF pixels = QSizeF(screen.size()) * screen.devicePixelRatio();  // as its box says, whatever the desktop's scale
  return QStringLiteral("%1, %2 × %3").arg(screen.name()).arg(pixels.width(), 0, 'f', 0).arg(pixels.height(), 0, 'f', 0);
}

QString screenFor(const QString& known, const QStringList& present, const QString& experimenters) {
  if (present.contains(known)) return known;
  const auto free = std::find_if(present.begin(), present.end(), [&](const QString& name) { return name != experimenters; });
  return free != present.end() ? *free : experimenters;
}

QString rememberedScreen(const QWidget& experimenters) {
  QStringList present;
  for (const QScreen* screen : QGuiApplication::screens()) present << screen->name();
  const QScreen* const theirs = experimenters.screen();
  return screenFor(QSettings().value(screenKey()).toString(), present, theirs != nullptr ? theirs->name() : present.value(0));
}

SubjectWindow::SubjectWindow(const QWidget& experimenters) : QWidget(nullptr, Qt::Window), experimenters_(experimenters) {
  setWindowTitle("Reachlab – subject");
  auto* layout = widgets::filling<QVBoxLayout>(this);
  view_ = new scene::SceneView;
  view_->overlay().setTextScale(1.8);
  layout->addWidget(view_);
  square_ = widgets::named<QWidget>("photodiode", this);
  square_->setAutoFillBackground(true);
  square_->setAttribute(Qt::WA_TransparentForMouseEvents);
  square_->hide();
  setCursor(Qt::BlankCursor);
  for (const auto changed : {&QGuiApplication::screenAdded, &QGuiApplication::screenRemoved})
    connect(qGuiApp, changed, this, &SubjectWindow::followScreens, Qt::QueuedConnection);  // when Qt has moved its windows
}

void SubjectWindow::showFull(const QString& screen) {
  const QString wanted = screenNamed(screen) != nullptr ? screen : rememberedScreen(experimenters_);
  if (!screen.isEmpty() && wanted == screen) QSettings().setValue(screenKey(), screen);
  fill(wanted);
}

void SubjectWindow::fill(const QString& screen) {
  shownOn_ = screen;
  if (QScreen* found = screenNamed(screen)) {
    if (isFullScreen()) showNormal();  // or it stays where it is
    create();
    windowHandle()->setScreen(found);
    setGeometry(found->geometry());
  }
  showFullScreen();
}

// A monitor was plugged in or out. The experimenter's monitor is not covered by itself.
void SubjectWindow::followScreens() {
  const QString wanted = rememberedScreen(experimenters_);
  const QScreen* const theirs = experimenters_.screen();
  if (wanted == shownOn_ || !isVisible()) return;
  if (theirs == nullptr || theirs->name() != wanted) return fill(wanted);
  if (screenNamed(shownOn_) != nullptr) return;
  shownOn_.clear();
  showNormal();
  const QRect room = theirs->availableGeometry();
  setGeometry(QRect(room.topLeft() + QPoint(room.width() / 2, 40), room.size() / 2.5));
}

void SubjectWindow::setPatch(Patch patch) {
  if (patch == patch_) return;
  patch_ = patch;
  QPalette palette = square_->palette();
  palette.setColor(QPalette::Window, patch == Patch::White ? Qt::white : Qt::black);
  square_->setPalette(palette);
  square_->setVisible(patch != Patch::None);
  square_->raise();
}

void SubjectWindow::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  square_->setGeometry(0, height() - kPatchSide, kPatchSide, kPatchSide);
  square_->raise();
}

}  // namespace reachlab::gui::subject
