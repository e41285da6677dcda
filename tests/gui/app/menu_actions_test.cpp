// Every action of every menu has a test that goes through the window and sees its effect. The first test lists the actions without one.
#include <QAction>
#include <QColorDialog>
#include <QDesktopServices>
#include <QDir>
#include <QDockWidget>
#include <QFileDialog>
#include <QInputDialog>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QSettings>
#include <QShortcut>
#include <QSlider>
#include <QWidgetAction>
#include <algorithm>
#include <functional>

#include "base/text_file.h"
#include "gui/choosers/constraint_chooser.h"
#include "gui/plan/plan_composer.h"
#include "gui/subject/subject_window.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/scene_look.h"
#include "test_paths.h"
#include "tests/gui/answer_box.h"
#include "tests/gui/at_the_window.h"

namespace reachlab::gui::app {
namespace {

QString plain(QString words) { return words.remove(QLatin1Char('&')); }

class MenuActions : public AtTheWindow {
 protected:
  MenuActions() {
    QCoreApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
    request_.what = "torus";
    request_.trials = 2;
    request_.timingCheckSeconds = 0;
  }
  ~MenuActions() override {
    if (window_) window_->session().endRun();
  }

  // "View/Look of the scene/Grid below" and its action; menus that are filled when they open are opened.
  std::map<QString, QAction*> actions() {
    std::map<QString, QAction*> all;
    std::function<void(const QList<QAction*>&, const QString&)> list = [&](const QList<QAction*>& found, const QString& path) {
      for (QAction* action : found) {
        if (action->isSeparator()) continue;
        QString words = plain(action->text());
        if (const auto* holder = qobject_cast<QWidgetAction*>(action)) {
          const auto* slider = holder->defaultWidget()->findChild<QSlider*>();
          words = slider == nullptr ? words : slider->objectName();
        }
        if (action->menu() == nullptr) all[path + words] = action;
        else {
          Q_EMIT action->menu()->aboutToShow();
          list(action->menu()->actions(), path + words + QLatin1Char('/'));
        }
      }
    };
    list(window_->menuBar()->actions(), {});
    return all;
  }
  // Undo and redo are called after what they undo.
  QAction* at(const QString& path) {
    for (const auto& [name, action] : actions())
      if (name == path || (path.endsWith(QLatin1Char('*')) && name.startsWith(path.chopped(1)))) return action;
    ADD_FAILURE() << "no action " << path.toStdString();
    static QAction none(nullptr);
    return &none;
  }
  void trigger(const char* path) { at(QString::fromUtf8(path))->trigger(); }
  void triggerWithFile(const char* path, const QString& chosen) {
    triggerWith<QFileDialog>(at(path), [&](QFileDialog& dialog) {
      if (auto* name = dialog.findChild<QLineEdit*>("fileNameEdit")) name->setText(chosen);
    });
  }
  QString written(const char* name) const { return folder_.filePath(QLatin1String(name)); }
  bool waits(const std::function<bool()>& what) { return QTest::qWaitFor(what, 20000); }

  // What each test below triggers.
  static QStringList tested() {
    return QString::fromUtf8(
               "Experiment/New/*; Experiment/Open…; Experiment/Inspect a dataset…; Experiment/Analyse a dataset…; "
               "Experiment/Open recent/*; Experiment/Shipped/*; Experiment/Session plan…; Experiment/Save; Experiment/Save as…; "
               "Experiment/Quit; Edit/Undo*; Edit/Redo*; Edit/Choose or type a constraint…; Trial/Start; Trial/Abort; Trial/Repeat; "
               "Trial/Resume the session; Trial/End run; Trial/Next subject; View/Whole scene; View/Along x; View/Along y; "
               "View/Along z; View/Masses side by side; View/Surfaces as wire frame; View/Forces on the hand; View/View from/*; "
               "View/Parallel projection; View/Stereo, for red and cyan glasses; View/Look of the scene/Trace of the hand; "
               "View/Look of the scene/Arrow of the force; View/Look of the scene/No depth cue; View/Look of the scene/Grid below; "
               "View/Look of the scene/Grid and shadows; View/Look of the scene/surfaceOpacity; View/Look of the scene/Colours/*; "
               "View/Look of the scene/Scene from a file…; View/Look of the scene/Remove the scene from a file; View/Light theme; "
               "View/Record pictures for a film…; View/Subject's screen; View/Save picture…; View/Subject's screen on/*; "
               "View/Subject's screen shows/*; View/Subject's language/*; View/Sounds/volume; View/Without sound; View/Docks/*; "
               "Help/Manual; Help/Keys and mouse; Help/About")
        .split(QLatin1String("; "));
  }
};

TEST_F(MenuActions, NoTwoOfAMenuShareALetter) {
  open();
  for (const QMenu* menu : window_->menuBar()->findChildren<QMenu*>()) {
    std::map<char, std::string> letters;
    for (const QAction* action : menu->actions()) {
      const std::string text = action->text().toLower().toStdString();
      const auto at = text.find('&');
      if (at == std::string::npos) continue;
      EXPECT_EQ(letters.try_emplace(text.at(at + 1), text).first->second, text) << menu->title().toStdString();
    }
  }
}

TEST_F(MenuActions, EachHasATest) {
  rememberFile(written("gone.json"));
  open();
  QStringList untested;
  for (const auto& [path, action] : actions()) {
    const QString name = path;
    const QStringList known = tested();
    if (std::none_of(known.begin(), known.end(), [&](const QString& test) {
          return test.endsWith(QLatin1Char('*')) ? name.startsWith(test.chopped(1)) : name == test;
        }))
      untested << name;
  }
  EXPECT_EQ(untested.join(QLatin1Char('\n')).toStdString(), "") << "actions without a test";
  for (const QString& test : tested())
    if (test != QLatin1String("Experiment/Open recent/*") && test != QLatin1String("View/View from/*")) at(test);
}

TEST_F(MenuActions, OfFilesReadAndWrite) {
  MainWindow& window = open();
  for (const Template& from : kTemplates) {
    trigger((QStringLiteral("Experiment/New/") + QLatin1String(from.title)).toUtf8());
    EXPECT_EQ(window.session().experiment(), newExperiment(from).experiment()) << from.title;
    EXPECT_TRUE(window.isWindowModified()) << "it is not saved yet";
    window.edits().setClean();
  }
  triggerWithFile("Experiment/Save as…", written("mine.json"));
  EXPECT_TRUE(QFileInfo::exists(written("mine.json")));
  EXPECT_EQ(window.session().experiment().name, "mine");
  QFile::remove(written("mine.json"));
  trigger("Experiment/Save");
  EXPECT_TRUE(QFileInfo::exists(written("mine.json")));
  trigger("Experiment/Shipped/ellipse");
  EXPECT_EQ(window.session().experiment().name, "ellipse");
  EXPECT_EQ(plain(at("Edit/Undo*")->text()), "Undo open ellipse");
  trigger("Edit/Undo*");
  EXPECT_EQ(window.session().experiment().name, "mine");
  trigger("Edit/Redo*");
  EXPECT_EQ(window.session().experiment().name, "ellipse");
  window.edits().setClean();
  trigger("Experiment/Open recent/*");
  EXPECT_EQ(window.session().experiment().name, "mine") << "the newest file";
  trigger("Experiment/Shipped/torus");
  triggerWithFile("Experiment/Open…", written("mine.json"));
  EXPECT_EQ(window.session().experiment().name, "mine");
  QDir(folder_.path()).mkdir("set");
  triggerWithFile("Experiment/Inspect a dataset…", written("set"));
  EXPECT_TRUE(window.inspecting());
  EXPECT_EQ(QFileInfo(window.inspector().path()).fileName(), "set");
  triggerWithFile("Experiment/Analyse a dataset…", written("set"));
  EXPECT_TRUE(waits([&] { return !window.message().isEmpty(); })) << "an empty dataset has no report, and that is said";
  trigger("Experiment/Session plan…");
  EXPECT_TRUE(window.findChild<plan::PlanComposer*>()->isVisible());
  window.findChild<plan::PlanComposer*>()->close();
  trigger("Edit/Choose or type a constraint…");
  EXPECT_TRUE(waits([&] { return window.chooser().isVisible(); }));
  window.chooser().close();
  trigger("Experiment/Quit");
  EXPECT_TRUE(waits([&] { return !window.isVisible(); }));
}

TEST_F(MenuActions, OfTrialsConductARun) {
  MainWindow& window = open();
  window.sessionDock().setDevice("simulated:noise=0");
  session::SessionRequest first = window.sessionDock().request();
  first.participant = {.age = 31, .sex = "F", .handedness = "L"};
  window.sessionDock().setRequest(first);
  EXPECT_EQ(window.sessionDock().request().participant, first.participant);
  trigger("Trial/Next subject");
  EXPECT_EQ(window.sessionDock().request().place.subject, "02");
  EXPECT_EQ(window.sessionDock().request().participant, record::Participant()) << "they are the first person's";
  trigger("Trial/Start");
  ASSERT_NE(window.session().run(), nullptr);
  ASSERT_TRUE(waits([&] { return window.session().run()->latest().phase != trial::Phase::Idle; }));
  trigger("Trial/Abort");
  ASSERT_TRUE(waits([&] { return window.session().lastTrial() && !window.session().underWay(); }));
  EXPECT_EQ(window.session().lastTrial()->result.outcome, trial::Outcome::Aborted);
  const std::size_t trials = window.session().run()->trialCount();
  trigger("Trial/Repeat");
  EXPECT_EQ(window.session().run()->trialCount(), trials + 1);
  answered("End the run", [&] { trigger("Trial/End run"); });
  EXPECT_EQ(window.session().run(), nullptr);
  window.sessionDock().setTrials(7);  // of a new run; the one that is resumed has its own number
  trigger("Trial/Resume the session");
  ASSERT_NE(window.session().run(), nullptr) << window.message().toStdString();
  EXPECT_EQ(window.session().run()->configuration().firstRun, 1) << "run 2 resumes run 1";
  answered("End the run", [&] { trigger("Trial/End run"); });
  trigger("Trial/Next subject");
  trigger("Trial/Resume the session");
  EXPECT_TRUE(holds(window.message(), "nothing to resume"));
}

TEST_F(MenuActions, OfTheViewMoveTheCameraAndChangeTheDrawing) {
  MainWindow& window = open();
  scene::SceneView& view = window.view();
  const auto side = [&] { return (view.camera().position - view.camera().focus) / norm(view.camera().position - view.camera().focus); };
  const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const scene::Camera first = view.camera();
  int axis = 0;
  for (const char* path : {"View/Along x", "View/Along y", "View/Along z"}) {
    trigger(path);
    EXPECT_GT(std::abs(dot(side(), axes[axis++])), 0.99) << path;
  }
  trigger("View/Whole scene");
  EXPECT_LT(norm(view.camera().position - first.position), 1e-9);
  trigger("View/Parallel projection");
  EXPECT_TRUE(view.camera().parallel);
  trigger("View/Parallel projection");
  EXPECT_FALSE(view.camera().parallel);
  for (const char* path : {"View/Surfaces as wire frame", "View/Stereo, for red and cyan glasses"}) {
    const QImage before = view.grabScene();
    trigger(path);
    EXPECT_NE(view.grabScene(), before) << path;
    trigger(path);
  }
  trigger("Experiment/Shipped/curl-field");
  const QImage forces = view.grabScene();
  EXPECT_FALSE(window.overlay().legend.isEmpty());
  trigger("View/Forces on the hand");
  EXPECT_NE(view.grabScene(), forces);
  EXPECT_TRUE(window.overlay().legend.isEmpty());
  trigger("View/Forces on the hand");
  EXPECT_FALSE(view.plan().forces.field.empty());
  trigger("Experiment/Shipped/torus");
  window.edits().setClean();
  triggerWith<QInputDialog>(at("View/View from/Remember this view…"), [](QInputDialog& dialog) { dialog.setTextValue("side"); });
  ASSERT_EQ(window.look().cameras.size(), 1u);
  trigger("View/Along z");
  trigger("View/View from/side");
  EXPECT_LT(norm(view.camera().position - window.look().cameras[0].position), 1e-9);
  trigger("View/View from/Forget/side");
  EXPECT_TRUE(window.look().cameras.empty());
  triggerWithFile("View/Save picture…", written("scene.png"));
  EXPECT_FALSE(QImage(written("scene.png")).isNull());
  QDir(folder_.path()).mkdir("film");
  triggerWithFile("View/Record pictures for a film…", written("film"));
  EXPECT_TRUE(waits([&] { return QFileInfo::exists(written("film/frame-000001.png")); }));
  trigger("View/Record pictures for a film…");
  trigger("View/Light theme");
  trigger("View/Docks/In their places");
  EXPECT_EQ(QSettings().value("window/theme").toString(), "light") << "the theme is no place";
  trigger("View/Light theme");
  EXPECT_EQ(QSettings().value("window/theme").toString(), "dark");
}

// The file that was left by Save as stays as it is.
TEST_F(MenuActions, UndoKeepsTheFileOfSaveAs) {
  experiment::Experiment mine = experiment::openExperiment("ellipse").experiment();
  mine.name = "mine";
  const std::string text = experiment::toJson(mine);
  request_.what = write("mine.json", text);
  MainWindow& window = open();
  experiment::Experiment changed = window.session().experiment();
  changed.object.masses = {2.5};
  ASSERT_TRUE(window.edits().isClean());
  window.edit(changed, "A change", "masses");
  QDir(folder_.path()).mkdir("copies");
  for (const char* copy : {"copies/mine.json", "copies/other.json"}) {
    triggerWithFile("Experiment/Save as…", written(copy));
    ASSERT_TRUE(QFileInfo::exists(written(copy)));
    trigger("Edit/Undo*");
    trigger("Experiment/Save");
    EXPECT_EQ(readTextFile(request_.what), text) << copy;
    trigger("Edit/Redo*");
  }
  EXPECT_NE(experiment::openExperiment(written("copies/mine.json").toStdString()).experiment().object.masses, std::vector<double>{2.5});
}

TEST_F(MenuActions, SaveAsInAnotherFolderStillFindsTheSceneFromAFile) {
  const std::string scene = write("ball.wrl", "#VRML V2.0 utf8\nDEF mass1 Shape { geometry Sphere { radius 0.02 } }\n");
  experiment::SceneLook look;
  look.sceneFile = "ball.wrl";
  request_.what = write("ball.json", experiment::withLook(experiment::openExperiment("ellipse").experiment(), look).text);
  MainWindow& window = open();
  QDir(folder_.path()).mkdir("copies");
  triggerWithFile("Experiment/Save as…", written("copies/ball.json"));
  const experiment::Experiment saved = experiment::openExperiment(written("copies/ball.json").toStdString()).experiment();
  EXPECT_EQ(experiment::lookOf(saved).sceneFile, scene);
  EXPECT_EQ(window.look().sceneFile, scene);
}

TEST_F(MenuActions, OfTheLookReachTheExperiment) {
  request_.what = "chain-moderate";
  MainWindow& window = open();
  trigger("View/Masses side by side");
  EXPECT_TRUE(
      std::any_of(window.view().plan().massShift.begin(), window.view().plan().massShift.end(), [](const Vec3& s) { return norm(s) > 0; }));
  for (const char* entry : {"Grid below", "Grid and shadows", "No depth cue", "Trace of the hand", "Arrow of the force"}) {
    const experiment::SceneLook before = window.look();
    trigger((QStringLiteral("View/Look of the scene/") + QLatin1String(entry)).toUtf8());
    EXPECT_FALSE(window.look() == before) << entry;
  }
  auto* slider = find<QSlider>("surfaceOpacity");
  slider->setValue(90);  // as a key, or a click beside its handle
  EXPECT_NEAR(window.look().surfaceOpacity, 0.9, 1e-12);
  for (const std::string& part : experiment::colouredParts()) {
    Q_EMIT find<QMenu>("look")->aboutToShow();
    QAction* entry = nullptr;
    for (const auto& [path, action] : actions())
      if (path.startsWith("View/Look of the scene/Colours/") && !path.endsWith("own") &&
          action->property("part").toString().toStdString() == part)
        entry = action;
    ASSERT_NE(entry, nullptr) << part;
    triggerWith<QColorDialog>(entry, [](QColorDialog& dialog) { dialog.setCurrentColor(QColor("#123456")); });
    EXPECT_EQ(window.look().colours[part], "#123456");
  }
  trigger("View/Look of the scene/Colours/The theme's own");
  EXPECT_TRUE(window.look().colours.empty());
  triggerWithFile("View/Look of the scene/Scene from a file…", QStringLiteral(REACHLAB_SOURCE_DIR "/README.md"));
  EXPECT_TRUE(QString::fromStdString(window.look().sceneFile).endsWith("README.md"));
  EXPECT_TRUE(waits([&] { return window.message().contains("README.md"); })) << "which is no scene";
  trigger("View/Look of the scene/Remove the scene from a file");
  EXPECT_EQ(window.look().sceneFile, "");
}

TEST_F(MenuActions, OfTheSubjectsScreenOpenItAndChangeIt) {
  MainWindow& window = open();
  trigger("View/Subject's screen");
  ASSERT_TRUE(waits([&] { return subjectsScreen() != nullptr; }));
  trigger("View/Subject's screen");
  ASSERT_TRUE(waits([&] { return subjectsScreen() == nullptr; }));
  trigger("View/Subject's screen on/*");
  ASSERT_TRUE(waits([&] { return subjectsScreen() != nullptr; }));
  window.screens().toggleSubject();
  using Screen = experiment::SubjectScreen;
  const std::pair<const char*, bool Screen::*> parts[] = {
      {"Semaphore", &Screen::semaphore}, {"Target", &Screen::target}, {"Masses and springs", &Screen::masses},
      {"Words", &Screen::words},         {"Score", &Screen::score},   {"Square for a light sensor", &Screen::photodiode}};
  for (const auto& [words, part] : parts) {
    const bool before = window.session().experiment().subjectScreen.*part;
    trigger((QStringLiteral("View/Subject's screen shows/") + QLatin1String(words)).toUtf8());
    EXPECT_NE(window.session().experiment().subjectScreen.*part, before) << words;
  }
  for (const char* code : {"de", "ja", "ru", "en"}) {
    find<QAction>((std::string("language_") + code).c_str())->trigger();
    EXPECT_EQ(window.subjectsLanguage(), QLatin1String(code));
  }
  find<QSlider>("volume")->setValue(35);
  EXPECT_NEAR(window.sounds().volume(), 0.35, 1e-12);
  trigger("View/Without sound");
  EXPECT_TRUE(window.sounds().muted());
}

TEST_F(MenuActions, OfDocksShowAndHideThem) {
  MainWindow& window = open();
  for (QDockWidget* dock : window.findChildren<QDockWidget*>()) {
    const QString path = QStringLiteral("View/Docks/") + dock->windowTitle();
    at(path)->trigger();
    EXPECT_TRUE(dock->isHidden()) << path.toStdString();
    at(path)->trigger();
    EXPECT_FALSE(dock->isHidden()) << path.toStdString();
  }
  trigger("View/Docks/Layout: run");
  EXPECT_TRUE(find<QDockWidget>("taskDock")->isHidden());
  trigger("View/Docks/Layout: set up");
  EXPECT_FALSE(find<QDockWidget>("taskDock")->isHidden());
  trigger("View/Docks/Layout: inspect");
  EXPECT_TRUE(window.inspecting());
  trigger("View/Docks/Layout: set up");
  find<QDockWidget>("taskDock")->hide();
  trigger("View/Docks/In their places");
  EXPECT_FALSE(find<QDockWidget>("taskDock")->isHidden());
}

class Pages : public QObject {
  Q_OBJECT
 public Q_SLOTS:
  void open(const QUrl& url) { opened << url; }

 public:
  QList<QUrl> opened;
};

TEST_F(MenuActions, OfHelpOpenTheManualAndTheBoxes) {
  MainWindow& window = open();
  Pages pages;
  QDesktopServices::setUrlHandler("file", &pages, "open");
  trigger("Help/Manual");
  QDesktopServices::unsetUrlHandler("file");
  if (manualPage().isEmpty()) EXPECT_TRUE(window.message().contains("manual"));
  else ASSERT_EQ(pages.opened.size(), 1);
  const auto box = [&](const char* title) -> QMessageBox* {
    for (QMessageBox* found : window.findChildren<QMessageBox*>())
      if (found->windowTitle() == QLatin1String(title)) return found;
    return nullptr;
  };
  trigger("Help/Keys and mouse");
  ASSERT_NE(box("Keys and mouse"), nullptr);
  for (const auto& [path, action] : actions()) {
    if (action->shortcut().isEmpty()) continue;
    EXPECT_TRUE(box("Keys and mouse")->text().contains(action->shortcut().toString(QKeySequence::NativeText).toHtmlEscaped()))
        << path.toStdString();
  }
  const QString keys = box("Keys and mouse")->text();
  for (const QShortcut* shortcut : window.inspector().findChildren<QShortcut*>())
    EXPECT_TRUE(keys.contains("<b>" + shortcut->key().toString(QKeySequence::NativeText) + "</b>"))
        << shortcut->key().toString().toStdString();
  for (const char* drag : {"Shift + left drag", "left drag on start or target"}) EXPECT_TRUE(keys.contains(drag)) << drag;
  trigger("Help/About");
  ASSERT_NE(box("Reachlab"), nullptr);
  EXPECT_TRUE(box("Reachlab")->text().contains(QLatin1String(qVersion())));
}

}  // namespace
}  // namespace reachlab::gui::app

#include "menu_actions_test.moc"
