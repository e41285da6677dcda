#include <QActionGroup>
#include <QColorDialog>
#include <QFileDialog>
#include <QInputDialog>
#include <QSettings>
#include <QSlider>
#include <QStatusBar>
#include <tuple>

#include "gui/app/frame_recorder.h"
#include "gui/app/menu_entries.h"
#include "gui/widgets/named.h"
#include "gui/widgets/theme.h"
#include "gui/widgets/work_strip.h"

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
  const scene::PartColours& drawn = window.view().plan().colours;
  const widgets::Colour* colour = scene::partNamed(drawn, part);
  return colour == nullptr ? QColor() : QColor::fromRgbF(colour->red, colour->green, colour->blue);
}

QIcon swatchOf(const QColor& colour) {
  QPixmap picture(16, 16);
  picture.fill(colour);
  return QIcon(picture);
}

void changeLook(MainWindow& window, const std::function<void(SceneLook&)>& change) {
  SceneLook look = window.look();
  change(look);
  if (!(look == window.look()))
    window.edit(experiment::withLook(window.session().experiment(), look), QObject::tr("Another look of the scene"),
                QObject::tr("look of the scene"));
}

void addParts(MainWindow& window, QMenu& menu) {
  const std::tuple<const char*, const char*, bool SceneLook::*> parts[] = {{"lookTrace", "Trace of the hand", &SceneLook::trace},
                                                                           {"lookArrow", "Arrow of the force", &SceneLook::forceArrow}};
  for (const auto& [name, title, part] : parts)
    addExperimentSwitch(
        window, menu, QObject::tr(title), name, [&window, part = part] { return window.look().*part; },
        [&window, part = part](bool on) { changeLook(window, [&](SceneLook& look) { look.*part = on; }); });
}

void addDepthCues(MainWindow& window, QMenu& menu) {
  const std::pair<const char*, const char*> cues[] = {{"none", "No depth cue"}, {"grid", "Grid below"}, {"shadow", "Grid and shadows"}};
  auto* group = new QActionGroup(&menu);
  for (const auto& [name, title] : cues)
    group->addAction(addExperimentSwitch(
        window, menu, QObject::tr(title), QLatin1String("depth_") + name, [&window, name = name] { return window.look().depthCue == name; },
        [&window, name = name](bool) { changeLook(window, [&](SceneLook& look) { look.depthCue = name; }); }));
}

void addOpacity(MainWindow& window, QMenu& menu) {
  QSlider* slider = addSlider(menu, QObject::tr("Surface's opacity"), "surfaceOpacity", 140);
  slider->setTracking(false);  // one change of the experiment for one drag, key or click
  QObject::connect(&menu, &QMenu::aboutToShow, slider, [&window, slider] {
    widgets::quietly(slider)->setValue(static_cast<int>(100 * window.look().surfaceOpacity + 0.5));
    slider->setEnabled(!window.session().isPlan());
  });
  QObject::connect(slider, &QSlider::valueChanged, &window,
                   [&window](int percent) { changeLook(window, [&](SceneLook& look) { look.surfaceOpacity = 0.01 * percent; }); });
}

void listColours(MainWindow& window, QMenu& menu) {
  menu.clear();
  menu.setEnabled(!window.session().isPlan());
  for (const std::string& part : experiment::colouredParts()) {
    const auto choose = [&window, part] {
      const QColor chosen =
          QColorDialog::getColor(drawnColour(window, part), &window, QObject::tr("Colour of the scene: %1").arg(wordsOf(part)));
      if (chosen.isValid()) changeLook(window, [&](SceneLook& look) { look.colours[part] = chosen.name().toStdString(); });
    };
    QAction* action = addEntry(window, menu, wordsOf(part) + "…", choose);
    action->setIcon(swatchOf(drawnColour(window, part)));
    action->setProperty("part", QString::fromStdString(part));
  }
  menu.addSeparator();
  addEntry(window, menu, QObject::tr("The theme's own"), [&window] { changeLook(window, [](SceneLook& look) { look.colours.clear(); }); });
}

void rememberView(MainWindow& window) {
  const QString text = QInputDialog::getText(&window, QObject::tr("Remember this view"), QObject::tr("Its name, for the menu"));
  const std::string name = text.trimmed().toStdString();
  if (name.empty()) return;
  changeLook(window, [&](SceneLook& look) {
    std::erase_if(look.cameras, [&](const experiment::NamedCamera& known) { return known.name == name; });
    look.cameras.push_back({window.view().camera(), name});
  });
}

void listCameras(MainWindow& window, QMenu& menu) {
  menu.clear();
  const std::vector<experiment::NamedCamera> cameras = window.look().cameras;
  for (const experiment::NamedCamera& camera : cameras)
    addEntry(window, menu, QString::fromStdString(camera.name), [&window, camera] { window.view().setCamera(camera); });
  menu.addSeparator();
  QAction* keep = addEntry(window, menu, QObject::tr("Remember this view…"), [&window] { rememberView(window); });
  keep->setObjectName("rememberView");
  keep->setEnabled(!window.session().isPlan());
  QMenu* forget = menu.addMenu(QObject::tr("Forget"));
  forget->setEnabled(!cameras.empty() && !window.session().isPlan());
  for (const experiment::NamedCamera& camera : cameras)
    addEntry(window, *forget, QString::fromStdString(camera.name),
             [&window, camera] { changeLook(window, [&](SceneLook& look) { std::erase(look.cameras, camera); }); });
}

void addScenery(MainWindow& window, QMenu& menu) {
  QAction* open = addEntry(window, menu, QObject::tr("Scene from a file…"), [&window] {
    const QString file =
        QFileDialog::getOpenFileName(&window, QObject::tr("Scene from a file"), {}, QObject::tr("Scenes (*.wrl *.gltf *.glb)"));
    if (!file.isEmpty()) changeLook(window, [&](SceneLook& look) { look.sceneFile = file.toStdString(); });
  });
  QAction* none = addEntry(window, menu, QObject::tr("Remove the scene from a file"),
                           [&window] { changeLook(window, [](SceneLook& look) { look.sceneFile.clear(); }); });
  QObject::connect(&menu, &QMenu::aboutToShow, open, [&window, open, none] {
    open->setEnabled(!window.session().isPlan());
    none->setEnabled(!window.session().isPlan() && !window.look().sceneFile.empty());
  });
}

void addMovie(MainWindow& window, QMenu& menu) {
  auto* recorder = new FrameRecorder(window.view(), &window);
  QAction* action = menu.addAction(QObject::tr("R&ecord pictures for a film…"));
  action->setObjectName("recordFrames");
  action->setCheckable(true);
  QObject::connect(action, &QAction::triggered, &window, [&window, recorder, action](bool on) {
    if (!on) return recorder->stop();
    const QString folder = QFileDialog::getExistingDirectory(&window, QObject::tr("Folder for the pictures"));
    if (folder.isEmpty()) return action->setChecked(false);
    recorder->start(folder);
  });
  auto* filming = new widgets::WorkStrip("filming", QObject::tr("Stop"));
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
  QMenu* cameras = menu.addMenu(QObject::tr("&View from"));
  cameras->setObjectName("cameras");
  QObject::connect(cameras, &QMenu::aboutToShow, cameras, [&window, cameras] { listCameras(window, *cameras); });
  addSwitch(window, menu, QObject::tr("&Parallel projection"), [&window](bool on) {
    window.view().setParallel(on);
  })->setObjectName("parallel");
  addSwitch(window, menu, QObject::tr("Stereo, for &red and cyan glasses"), [&window](bool on) { window.view().setStereo(on); });
  QMenu* look = menu.addMenu(QObject::tr("&Look of the scene"));
  look->setObjectName("look");
  addParts(window, *look);
  look->addSeparator();
  addDepthCues(window, *look);
  look->addSeparator();
  addOpacity(window, *look);
  QMenu* colours = look->addMenu(QObject::tr("&Colours"));
  QObject::connect(look, &QMenu::aboutToShow, colours, [&window, colours] { listColours(window, *colours); });
  look->addSeparator();
  addScenery(window, *look);
  QAction* light = addSwitch(window, menu, QObject::tr("Ligh&t theme"), [&window](bool on) {
    const QString theme = on ? "light" : "dark";
    QSettings().setValue("window/theme", theme);
    window.tell(QObject::tr("The %1 theme is used when you open the window again.").arg(theme));
  });
  light->setObjectName("lightTheme");
  light->setChecked(QSettings().value("window/theme").toString() == QLatin1String("light"));
  addMovie(window, menu);
}

}  // namespace reachlab::gui::app
