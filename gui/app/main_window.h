#pragma once
#include <QMainWindow>
#include <memory>
#include <optional>

#include "gui/app/edit_history.h"
#include "gui/app/experiment_files.h"
#include "gui/app/screens.h"
#include "gui/app/status_line.h"
#include "gui/app/window_layout.h"
#include "gui/app/window_menus.h"
#include "gui/docks/all_docks.h"
#include "gui/inspector/inspector.h"
#include "gui/plot/live_forecast.h"
#include "gui/plot/live_trace.h"
#include "gui/scene/scene_view.h"
#include "gui/session/plan_pages.h"
#include "gui/session/session_controller.h"
#include "gui/session/session_strip.h"
#include "gui/session/sound_cues.h"
#include "gui/subject/subject_words.h"
#include "gui/widgets/card.h"
#include "gui/widgets/messages.h"
#include "sim/experiment/scene_look.h"

class QTabWidget;
class QTimer;

namespace reachlab::gui::app {

/// The window of `reachlab`: the scene in the middle, docks around it. It wires docks, pictures and session, and owns no logic of any.
class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  /// Throws FaultError when the experiment cannot be read.
  explicit MainWindow(const session::SessionRequest& request, const std::optional<network::StationSetup>& station = std::nullopt,
                      QWidget* parent = nullptr);
  ~MainWindow() override;

  SessionController& session() { return session_; }
  scene::SceneView& view() { return *view_; }
  Screens& screens() { return *screens_; }
  plot::VelocityPlot& plot() { return *docks_.velocity; }
  docks::PredictionDock& predictions() { return *docks_.predictions; }
  docks::SessionDock& sessionDock() { return *docks_.session; }
  docks::ConstraintChooser& chooser();    // made when first asked for
  inspector::InspectorPage& inspector();  // made when first asked for
  bool inspecting() const { return layout_ == WindowLayout::Inspect; }
  SoundCues& sounds() { return sounds_; }
  const QString& subjectsLanguage() const { return words_.language(); }
  QUndoStack& edits() { return edits_.stack(); }
  /// Takes an edit back, or makes it again. Asks first if that would end a run.
  void undo();
  void redo();
  const scene::OverlayState& overlay() const { return screens_->overlay(); }
  /// How the scene is drawn, as the experiment has it.
  experiment::SceneLook look() const { return experiment::lookOf(session_.experiment()); }
  /// Shows a message over the scene: `say` for an error, `warn` for a remark that needs attention, `tell` for a success.
  void say(const QString& sentence);
  void warn(const QString& sentence);
  void tell(const QString& sentence);
  /// The newest message. Empty if there is no message.
  QString message() const { return messages_->newest(); }
  /// True once the criteria have been computed for the present experiment. Never waits.
  bool predictionsReady() const { return forecast_.isReady(); }

 public Q_SLOTS:
  void nextTrial();
  void abortTrial();
  void repeatTrial();
  void resumeSession();
  /// Asks if trials are left, and tells where the run is saved.
  void endRun();
  /// Counts the subject's label up. Does nothing while a run is open.
  void nextSubject();
  /// Offers to resume the run that was open when the program was killed.
  void offerResume();
  /// At a station: the others hear of it from now on.
  void joinStations();
  /// Opens an experiment or a plan, by file or shipped name. Faults are shown.
  void openExperiment(const QString& what);
  void openFile();
  /// Shows a dataset, a session or a log.
  void inspect(const QString& path);
  /// A sound beginning of its kind, not saved yet.
  void beginNew(const Template& from);
  /// Saves into the file that was opened, or asks for a file. Returns false if nothing was saved.
  bool saveExperiment();
  /// False when it was not saved.
  bool saveExperimentAs();
  void chooseConstraint();
  void composePlan();
  /// Remembered (QSettings).
  void setSubjectsLanguage(const QString& code);
  /// An edit of the experiment, called `what`. Asks first if it would end a run, which `doing` ends.
  void edit(const reachlab::experiment::Experiment& changed, const QString& doing, const QString& what);
  void resetLayout();
  void switchLayout(WindowLayout layout);
  void openManual();
  /// The scene as it is drawn now, as PNG.
  void savePicture();

 protected:
  void closeEvent(QCloseEvent* event) override;
  /// A changed layout is remembered a little later.
  bool event(QEvent* event) override;
  /// A file that is dropped onto the window is opened.
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void addCentre();
  void takeEntry();
  void beginNext();
  void showPage();
  void showReach();
  void wireDocks();
  void wireSession();
  void showExperiment();
  void showOverlay();
  void showStage();
  void showEnd();
  bool mayUseDevice();
  /// True when no field of the experiment is wrong, or the user takes the values before.
  bool mayKeepValues(const QString& doing);
  void movePlace(scene::TaskPlace place, const std::vector<double>& q);
  QString dataFolder() const;  // where the session records
  void drawPredictions();
  void runOpened();
  void runClosed();
  void drainTrace();
  void trialEnded();
  void fitRun();
  void oneFrame();
  void showStations();
  void playGo(const haptics::TickState& state);
  void tryEdit(docks::Dock& dock, const experiment::Experiment& changed, const QString& what);
  /// True when no trial of an open run would be lost, or the user says so.
  bool mayEndRun(const QString& doing);
  bool mayBeLeft();
  /// Changes the mark of a trial of the open run. A file beside the log keeps it at once.
  void markTrial(int number, const std::function<void(record::TrialMark&)>& change);
  bool saveTo(const QString& file, const experiment::Experiment& experiment);

  SessionController session_;
  EditHistory edits_;
  plot::LiveForecast forecast_;
  plot::LiveTrace trace_;
  inspector::Inspector runFits_;  // of the run's trials, from their rows on the disk
  std::string fitted_;            // log of the run that is fitted
  bool fitAgain_ = false;         // trials have come since the fit under way began
  std::vector<int> succeeded_;    // trials of the run, as recorded
  SoundCues sounds_;
  subject::SubjectWords words_;  // of the subject's screen
  int score_ = 0;                // successes of the run
  bool gone_ = false;            // the go signal of the trial has been given, and heard
  docks::Docks docks_;
  WindowActions actions_;
  QByteArray firstLayout_;                                                         // of the docks
  WindowLayout layout_ = WindowLayout::SetUp, reachLayout_ = WindowLayout::SetUp;  // what holds, and the one on the first page
  std::unique_ptr<StatusLine> status_;
  SessionStrip* strip_ = nullptr;
  widgets::Messages* messages_ = nullptr;
  widgets::Card* card_ = nullptr;
  scene::SceneView* view_ = nullptr;
  QTabWidget* pages_ = nullptr;
  inspector::InspectorPage* inspector_ = nullptr;
  Screens* screens_ = nullptr;
  PlanPages* plans_ = nullptr;
  QTimer *timer_ = nullptr, *layoutTimer_ = nullptr;
};

}  // namespace reachlab::gui::app
