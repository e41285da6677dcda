#include "gui/app/look_menu.h"

#include <QActionGroup>
#include <QColorDialog>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QInputDialog>
#include <QLabel>
#include <QMenu>
#include <QSettings>
#include <QSlider>
#include <QStatusBar>
#include <QWidgetAction>

#include "gui/app/frame_recorder.h"
#include "gui/app/main_window.h"
#include "gui/scene/scene_view.h"
#include "gui/scene_plan/part_names.h"
#include "gui/widgets/theme.h"
#include "gui/widgets/work_strip.h"
#include "sim/experiment/scene_look.h"

namespace reachlab::gui::app {
namespace {

using experiment::SceneLook;

QString wordsOf(const std::string& part) {
  for (const auto& [name, words] :
       {std::pair{"driven", "driven mass"}, {"middle", "masses between"}, {"last", "last mass"}, {"spring", "springs"}})
    if (part == name) return QObject::tr(words);
  return QString::fromStdString(part).replace(QLatin1Char('_'), QLatin1Char(' '));
}

// As it is drawn now, by the theme or by the experiment.
QColor drawnColour(MainWindow& window, const std::string& part) {
  scene::PartColours drawn = window.view().plan().look.colours;
  const widgets::Colour* colour = scene::partNamed(drawn, part);
  return colour == nullptr ? QColor() : QColor::fromRgbF(colour->red, colour->green, colour->blue);
}

QIcon swatchOf(const QColor& colour) {
  QPixmap picture(16, 16);
  picture.fill(colour);
  return QIcon(picture);
}

scene::Camera cameraOf(const experiment::NamedCamera& named) {
  return {named.position, named.focus, named.up, named.angle, named.parallel};
}

// A switch of the experiment's look; set anew whenever the menu opens.
void addSwitch(MainWindow& window, QMenu& menu, const QString& title, const char* name, bool SceneLook::*part) {
  QAction* action = menu.addAction(title);
  action->setObjectName(QLatin1String(name));
  action->setCheckable(true);
  QObject::connect(&menu, &QMenu::aboutToShow, action, [&window, action, part] {
    action->setChecked(window.look().*part);
    action->setEnabled(!window.session().isPlan());  // a plan's experiments stand in their files
  });
  QObject::connect(action, &QAction::triggered, &window, [&window, part](bool on) {
    SceneLook look = window.look();
    look.*part = on;
    window.setLook(look);
  });
}

void addDepthCues(MainWindow& window, QMenu& menu) {
  auto* group = new QActionGroup(&menu);
  const std::pair<const char*, const char*> cues[] = {{"none", "No depth cue"}, {"grid", "Grid below"}, {"shadow", "Grid and shadows"}};
  for (const auto& [name, title] : cues) {
    QAction* action = group->addAction(QObject::tr(title));
    menu.addAction(action);
    action->setObjectName(QStringLiteral("depth_") + QLatin1String(name));
    action->setCheckable(true);
    QObject::connect(&menu, &QMenu::aboutToShow, action, [&window, action, name = name] {
      action->setChecked(window.look().depthCue == name);
      action->setEnabled(!window.session().isPlan());
    });
    QObject::connect(action, &QAction::triggered, &window, [&window, name = name] {
      SceneLook look = window.look();
      look.depthCue = name;
      window.setLook(look);
    });
  }
}

void addOpacity(MainWindow& window, QMenu& menu) {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  auto* slider = new QSlider(Qt::Horizontal);
  slider->setObjectName(QStringLiteral("surfaceOpacity"));
  slider->setRange(0, 100);
  slider->setMinimumWidth(140);
  layout->addWidget(new QLabel(QObject::tr("Surface's opacity")));
  layout->addWidget(slider);
  QObject::connect(&menu, &QMenu::aboutToShow, slider, [&window, slider] {
    slider->setValue(static_cast<int>(100 * window.look().surfaceOpacity + 0.5));
    slider->setEnabled(!window.session().isPlan());
  });
  QObject::connect(slider, &QSlider::sliderReleased, &window, [&window, slider] {
    SceneLook look = window.look();
    look.surfaceOpacity = 0.01 * slider->value();
    window.setLook(look);
  });
  auto* action = new QWidgetAction(&menu);
  action->setDefaultWidget(row);
  menu.addAction(action);
}

void listColours(MainWindow& window, QMenu& menu) {
  menu.clear();
  menu.setEnabled(!window.session().isPlan());
  for (const std::string& part : experiment::colouredParts()) {
    QAction* action = menu.addAction(swatchOf(drawnColour(window, part)), wordsOf(part) + QStringLiteral("…"));
    action->setProperty("part", QString::fromStdString(part));
    QObject::connect(action, &QAction::triggered, &window, [&window, part] {
      SceneLook look = window.look();
      const QColor chosen =
          QColorDialog::getColor(drawnColour(window, part), &window, QObject::tr("Colour of the scene: %1").arg(wordsOf(part)));
      if (!chosen.isValid()) return;
      look.colours[part] = chosen.name().toStdString();
      window.setLook(look);
    });
  }
  menu.addSeparator();
  QObject::connect(menu.addAction(QObject::tr("The theme's own")), &QAction::triggered, &window, [&window] {
    SceneLook look = window.look();
    look.colours.clear();
    window.setLook(look);
  });
}

void listCameras(MainWindow& window, QMenu& menu) {
  menu.clear();
  const SceneLook look = window.look();
  for (const experiment::NamedCamera& camera : look.cameras)
    QObject::connect(menu.addAction(QString::fromStdString(camera.name)), &QAction::triggered, &window,
                     [&window, camera] { window.view().setCamera(cameraOf(camera)); });
  menu.addSeparator();
  QAction* keep = menu.addAction(QObject::tr("Remember this view…"));
  keep->setObjectName(QStringLiteral("rememberView"));
  keep->setEnabled(!window.session().isPlan());
  QObject::connect(keep, &QAction::triggered, &window, [&window] {
    const QString name = QInputDialog::getText(&window, QObject::tr("Remember this view"), QObject::tr("Its name, for the menu"));
    if (!name.trimmed().isEmpty()) window.rememberView(name.trimmed());
  });
  QMenu* forget = menu.addMenu(QObject::tr("Forget"));
  forget->setEnabled(!look.cameras.empty() && !window.session().isPlan());
  for (std::size_t i = 0; i < look.cameras.size(); ++i)
    QObject::connect(forget->addAction(QString::fromStdString(look.cameras[i].name)), &QAction::triggered, &window, [&window, i] {
      SceneLook changed = window.look();
      changed.cameras.erase(changed.cameras.begin() + static_cast<std::ptrdiff_t>(i));
      window.setLook(changed);
    });
}

void addScenery(MainWindow& window, QMenu& menu) {
  QAction* open = menu.addAction(QObject::tr("Scene from a file…"));
  QObject::connect(open, &QAction::triggered, &window, [&window] {
    const QString file =
        QFileDialog::getOpenFileName(&window, QObject::tr("Scene from a file"), {}, QObject::tr("Scenes (*.wrl *.gltf *.glb)"));
    if (file.isEmpty()) return;
    SceneLook look = window.look();
    look.sceneFile = file.toStdString();
    window.setLook(look);
  });
  QAction* none = menu.addAction(QObject::tr("Remove the scene from a file"));
  QObject::connect(none, &QAction::triggered, &window, [&window] {
    SceneLook look = window.look();
    look.sceneFile.clear();
    window.setLook(look);
  });
  QObject::connect(&menu, &QMenu::aboutToShow, open, [&window, open, none] {
    open->setEnabled(!window.session().isPlan());
    none->setEnabled(!window.session().isPlan() && !window.look().sceneFile.empty());
  });
}

void addMovie(MainWindow& window, QMenu& menu) {
  auto* recorder = new FrameRecorder(window.view(), &window);
  QAction* action = menu.addAction(QObject::tr("Record pictures for a film…"));
  action->setObjectName(QStringLiteral("recordFrames"));
  action->setCheckable(true);
  QObject::connect(action, &QAction::triggered, &window, [&window, recorder, action](bool on) {
    if (!on) return recorder->stop();
    const QString folder = QFileDialog::getExistingDirectory(&window, QObject::tr("Folder for the pictures"));
    if (folder.isEmpty()) return action->setChecked(false);
    recorder->start(folder);
  });
  auto* filming = new widgets::WorkStrip(QStringLiteral("filming"), QObject::tr("Stop"));
  window.statusBar()->addPermanentWidget(filming);
  QObject::connect(&filming->button(), &QToolButton::clicked, recorder, &FrameRecorder::stop);
  QObject::connect(recorder, &FrameRecorder::progressed, filming, [filming](int written, int leftOut) {
    filming->tell(leftOut == 0 ? QObject::tr("filming: %1 pictures").arg(written)
                               : QObject::tr("filming: %1 pictures, %2 left out").arg(written).arg(leftOut),
                  -1);
  });
  QObject::connect(recorder, &FrameRecorder::ended, &window, [&window, filming, action](const QString& sentence) {
    filming->hide();
    action->setChecked(false);
    window.tell(sentence);
  });
}

}  // namespace

void addLookMenu(MainWindow& window, QMenu& menu) {
  QMenu* cameras = menu.addMenu(QObject::tr("View &from"));
  cameras->setObjectName(QStringLiteral("cameras"));
  QObject::connect(cameras, &QMenu::aboutToShow, cameras, [&window, cameras] { listCameras(window, *cameras); });
  QAction* parallel = menu.addAction(QObject::tr("&Parallel projection"));
  parallel->setObjectName(QStringLiteral("parallel"));
  parallel->setCheckable(true);
  QObject::connect(parallel, &QAction::triggered, &window, [&window](bool on) { window.view().setParallel(on); });
  QAction* stereo = menu.addAction(QObject::tr("Stereo, for red and cyan glasses"));
  stereo->setCheckable(true);
  QObject::connect(stereo, &QAction::triggered, &window, [&window](bool on) { window.view().setStereo(on); });
  QMenu* look = menu.addMenu(QObject::tr("&Look of the scene"));
  look->setObjectName(QStringLiteral("look"));
  addSwitch(window, *look, QObject::tr("Trace of the hand"), "lookTrace", &SceneLook::trace);
  addSwitch(window, *look, QObject::tr("Arrow of the force"), "lookArrow", &SceneLook::forceArrow);
  look->addSeparator();
  addDepthCues(window, *look);
  look->addSeparator();
  addOpacity(window, *look);
  QMenu* colours = look->addMenu(QObject::tr("&Colours"));
  QObject::connect(look, &QMenu::aboutToShow, colours, [&window, colours] { listColours(window, *colours); });
  look->addSeparator();
  addScenery(window, *look);
  QAction* light = menu.addAction(QObject::tr("Light theme"));
  light->setObjectName(QStringLiteral("lightTheme"));
  light->setCheckable(true);
  light->setChecked(QSettings().value(QStringLiteral("window/theme")).toString() == QLatin1String("light"));
  QObject::connect(light, &QAction::triggered, &window, [&window](bool on) {
    QSettings().setValue(QStringLiteral("window/theme"), on ? QStringLiteral("light") : QStringLiteral("dark"));
    window.tell(QObject::tr("The %1 theme is used when you open the window again.").arg(on ? QObject::tr("light") : QObject::tr("dark")));
  });
  addMovie(window, menu);
}

}  // namespace reachlab::gui::app
