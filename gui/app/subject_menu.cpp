#include "gui/app/subject_menu.h"

#include <QActionGroup>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QScreen>
#include <QSlider>
#include <QWidgetAction>

#include "gui/app/main_window.h"
#include "gui/subject/subject_window.h"
#include "gui/subject/subject_words.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::app {
namespace {

void listScreens(MainWindow& window, QMenu& menu) {
  menu.clear();
  auto* group = new QActionGroup(&menu);
  const QString known = subject::rememberedScreen();
  for (const QScreen* screen : QGuiApplication::screens()) {
    QAction* action = menu.addAction(subject::titleOf(*screen));
    action->setCheckable(true);
    action->setChecked(screen->name() == known);
    group->addAction(action);
    QObject::connect(action, &QAction::triggered, &window, [&window, name = screen->name()] { window.showSubjectOn(name); });
  }
}

void addLanguages(MainWindow& window, QMenu& menu) {
  auto* group = new QActionGroup(&menu);
  for (const subject::Language& language : subject::languages()) {
    QAction* action = menu.addAction(language.name);
    action->setObjectName(QStringLiteral("language_") + language.code);
    action->setCheckable(true);
    action->setChecked(language.code == window.subjectsLanguage());
    group->addAction(action);
    QObject::connect(action, &QAction::triggered, &window, [&window, code = language.code] { window.setSubjectsLanguage(code); });
  }
}

void addShown(MainWindow& window, QMenu& menu) {
  using Screen = experiment::SubjectScreen;
  const std::pair<const char*, bool Screen::*> parts[] = {
      {"Semaphore", &Screen::semaphore}, {"Target", &Screen::target}, {"Masses and springs", &Screen::masses},
      {"Words", &Screen::words},         {"Score", &Screen::score},   {"Square for a light sensor", &Screen::photodiode}};
  for (const auto& [title, part] : parts) {
    QAction* action = menu.addAction(QLatin1String(title));
    action->setObjectName(QStringLiteral("subject ") + QLatin1String(title));
    action->setCheckable(true);
    const auto show = [&window, action, part = part] {
      action->setChecked(window.session().experiment().subjectScreen.*part);
      action->setEnabled(!window.session().isPlan());  // a plan's experiments stand in their files
    };
    show();
    QObject::connect(&menu, &QMenu::aboutToShow, action, show);
    QObject::connect(action, &QAction::triggered, &window, [&window, part = part](bool on) {
      Screen screen = window.session().experiment().subjectScreen;
      screen.*part = on;
      window.setSubjectScreen(screen);
    });
  }
}

void addVolume(MainWindow& window, QMenu& menu) {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  auto* slider = new QSlider(Qt::Horizontal);
  slider->setObjectName(QStringLiteral("volume"));
  slider->setRange(0, 100);
  slider->setMinimumWidth(160);
  slider->setValue(static_cast<int>(100 * window.sounds().volume()));
  layout->addWidget(new QLabel(QObject::tr("Volume")));
  layout->addWidget(slider);
  QObject::connect(slider, &QSlider::valueChanged, &window, [&window](int percent) { window.sounds().setVolume(percent / 100.0); });
  QObject::connect(slider, &QSlider::sliderReleased, &window, [&window] { window.sounds().play(SoundCues::Cue::Success); });
  auto* action = new QWidgetAction(&menu);
  action->setDefaultWidget(row);
  menu.addAction(action);
}

}  // namespace

void addSubjectMenu(MainWindow& window, QMenu& menu) {
  QMenu* where = menu.addMenu(QObject::tr("Subject's screen &on"));
  QObject::connect(where, &QMenu::aboutToShow, where, [&window, where] { listScreens(window, *where); });
  addShown(window, *menu.addMenu(QObject::tr("Subject's screen sho&ws")));
  addLanguages(window, *menu.addMenu(QObject::tr("Subject's &language")));
  addVolume(window, *menu.addMenu(QObject::tr("So&unds")));
}

}  // namespace reachlab::gui::app
