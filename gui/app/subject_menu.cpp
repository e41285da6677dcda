#include <QActionGroup>
#include <QGuiApplication>
#include <QScreen>
#include <QSlider>

#include "gui/app/menu_entries.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::app {
namespace {

void listScreens(MainWindow& window, QMenu& menu) {
  menu.clear();
  auto* group = new QActionGroup(&menu);
  const QString known = subject::rememberedScreen(window);
  for (const QScreen* screen : QGuiApplication::screens()) {
    const QString name = screen->name();
    QAction* action = addSwitch(window, menu, subject::titleOf(*screen), [&window, name] { window.screens().showSubjectOn(name); });
    action->setChecked(name == known);
    group->addAction(action);
  }
}

void addLanguages(MainWindow& window, QMenu& menu) {
  auto* group = new QActionGroup(&menu);
  for (const subject::Language& language : subject::languages()) {
    const QString code = language.code;
    QAction* action = addSwitch(window, menu, language.name, [&window, code] { window.setSubjectsLanguage(code); });
    action->setObjectName("language_" + code);
    action->setChecked(code == window.subjectsLanguage());
    group->addAction(action);
  }
}

void addShown(MainWindow& window, QMenu& menu) {
  using Screen = experiment::SubjectScreen;
  const std::pair<const char*, bool Screen::*> parts[] = {
      {"Semaphore", &Screen::semaphore}, {"Target", &Screen::target}, {"Masses and springs", &Screen::masses},
      {"Words", &Screen::words},         {"Score", &Screen::score},   {"Square for a light sensor", &Screen::photodiode}};
  for (const auto& [title, part] : parts)
    addExperimentSwitch(
        window, menu, title, QLatin1String("subject ") + title,
        [&window, part = part] { return window.session().experiment().subjectScreen.*part; },
        [&window, part = part](bool on) {
          experiment::Experiment changed = window.session().experiment();
          changed.subjectScreen.*part = on;
          window.edit(changed, QObject::tr("Another picture for the subject"), QObject::tr("subject's screen"));
        });
}

void addVolume(MainWindow& window, QMenu& menu) {
  QSlider* slider = addSlider(menu, QObject::tr("Volume"), "volume", 160);
  slider->setValue(static_cast<int>(100 * window.sounds().volume()));
  QObject::connect(slider, &QSlider::valueChanged, &window, [&window](int percent) { window.sounds().setVolume(percent / 100.0); });
  QObject::connect(slider, &QSlider::sliderReleased, &window, [&window] { window.sounds().play(SoundCues::Cue::Success); });
}

}  // namespace

void addSubjectMenu(MainWindow& window, QMenu& menu) {
  QMenu* where = menu.addMenu(QObject::tr("Subject's screen &on"));
  QObject::connect(where, &QMenu::aboutToShow, where, [&window, where] { listScreens(window, *where); });
  addShown(window, *menu.addMenu(QObject::tr("Subject's screen s&hows")));
  addLanguages(window, *menu.addMenu(QObject::tr("Subject's lan&guage")));
  addVolume(window, *menu.addMenu(QObject::tr("So&unds")));
}

}  // namespace reachlab::gui::app
