#include <QCloseEvent>
#include <QDesktopServices>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QMimeData>
#include <QTimer>
#include <QUrl>
#include <QVBoxLayout>

#include "devices/kept_mapping.h"
#include "gui/app/main_window.h"
#include "gui/model/model_reader.h"
#include "gui/model/name_in_file.h"
#include "gui/widgets/ask.h"
#include "gui/widgets/fault_in.h"
#include "sim/experiment/experiment.h"
#include "sim/session/recorded_blocks.h"

// What the window opens, saves, edits and marks.
namespace reachlab::gui::app {

using widgets::ask;

void MainWindow::openExperiment(const QString& what) {
  if (isRecorded(what)) return inspect(what);
  if (!mayEndRun("Opening another experiment") || !mayBeLeft()) return;
  const QString fault = widgets::faultIn([&] {
    const session::Programme opened = session::readProgramme(what.toStdString());
    const QString file = QFileInfo::exists(what) ? what : QString();
    edits_.open(opened, QStringLiteral("open %1").arg(what), {what, file});
    edits_.stack().setClean();
    if (!file.isEmpty()) rememberFile(file);
    messages_->clear();
    showReach();
  });
  messages_->say(widgets::Grade::Error, fault);
}

inspector::InspectorPage& MainWindow::inspector() {
  if (inspector_ == nullptr) {
    inspector_ = new inspector::InspectorPage;
    pages_->widget(1)->layout()->addWidget(inspector_);
    connect(inspector_, &inspector::InspectorPage::reported, this,
            [](const QString& file) { QDesktopServices::openUrl(QUrl::fromLocalFile(file)); });
    connect(inspector_, &inspector::InspectorPage::said, this, &MainWindow::say);
    connect(inspector_, &inspector::InspectorPage::told, this, &MainWindow::tell);
  }
  return *inspector_;
}

void MainWindow::inspect(const QString& path) {
  inspector().open(path);
  if (!inspecting()) switchLayout(WindowLayout::Inspect);
}

void MainWindow::showReach() {
  if (inspecting()) switchLayout(reachLayout_);
}

void MainWindow::openFile() {
  const QString chosen = QFileDialog::getOpenFileName(this, tr("Open experiment, plan or recording"), {},
                                                      tr("Experiments and plans (*.json);;Recordings (*.reach)"));
  if (!chosen.isEmpty()) openExperiment(chosen);
}

void MainWindow::beginNew(const Template& from) {
  if (!mayEndRun("A new experiment") || !mayBeLeft()) return;
  edits_.open(session::programmeOf(newExperiment(from)), "new experiment", {});
  showReach();
}

bool MainWindow::saveExperiment() {
  takeEntry();
  const QString file = edits_.opened().file;
  if (file.isEmpty()) return saveExperimentAs();
  return mayKeepValues("Save") && saveTo(file, session_.experiment());
}

bool MainWindow::saveExperimentAs() {
  takeEntry();
  if (!mayKeepValues("Save")) return false;
  const QString opened = edits_.opened().file,
                proposed = opened.isEmpty() ? QString::fromStdString(session_.experiment().name + ".json") : opened;
  QString file = QFileDialog::getSaveFileName(this, "Save experiment", proposed, "Experiments (*.json)");
  if (file.isEmpty()) return false;
  if (QFileInfo(file).suffix().isEmpty()) file += ".json";
  experiment::Experiment named = session_.experiment();
  named.name = QFileInfo(file).completeBaseName().toStdString();  // or two experiments would be recorded under one name
  experiment::SceneLook look = experiment::lookOf(named);
  const std::string scene = model::nameInFile(model::findSceneFile(look.sceneFile, QFileInfo(opened).path()), file);
  if (std::exchange(look.sceneFile, scene) != scene) named = experiment::withLook(named, look);
  return (named == session_.experiment() || mayEndRun("Another file")) && saveTo(file, named);
}

bool MainWindow::saveTo(const QString& file, const experiment::Experiment& experiment) {
  if (session_.isPlan()) return say("Use Session plan… (Ctrl+P) to compose and save a plan."), false;
  const QString fault = widgets::faultIn([&] {
    writeExperiment(experiment, file);
    const bool changed = experiment != session_.experiment();
    edits_.setOpened({changed ? file : edits_.opened().what, file});  // first: undo of the name keeps the file, too
    if (changed)
      edits_.open(session::readProgramme(file.toStdString()), QStringLiteral("save as %1").arg(QFileInfo(file).fileName()),
                  edits_.opened());
    rememberFile(file);
    edits_.stack().setClean();
  });
  messages_->say(widgets::Grade::Error, fault);
  return fault.isEmpty();
}

void MainWindow::tryEdit(docks::Dock& dock, const experiment::Experiment& changed, const QString& what) {
  if (!edits_.isSameScene(changed) && !mayEndRun("A change")) return dock.showExperiment(session_.compiled(), !session_.isPlan());
  dock.showFaults(edits_.tryEdit(changed, what));
}

// The camera stays where it is, so that the place stays under the pointer.
void MainWindow::movePlace(scene::TaskPlace place, const std::vector<double>& q) {
  experiment::Experiment changed = session_.experiment();
  const bool start = place == scene::TaskPlace::Start;
  (start ? changed.task->start : changed.task->target) = q;
  const scene::Camera kept = view_->camera();
  const QStringList faults = edits_.tryEdit(changed, start ? tr("start") : tr("target"));
  if (!faults.isEmpty()) {
    say(faults.join(QLatin1Char('\n')));
    screens_->showExperiment(session_.compiled(), session_.blockPlaces());  // back where it was
  } else {
    tell(start ? tr("The start is moved. Ctrl+Z takes it back.") : tr("The target is moved. Ctrl+Z takes it back."));
  }
  view_->setCamera(kept);
}

void MainWindow::undo() {
  if (mayEndRun("Undo")) edits_.stack().undo();
}

void MainWindow::redo() {
  if (mayEndRun("Redo")) edits_.stack().redo();
}

bool MainWindow::mayEndRun(const QString& doing) {
  session::RecordedRun* run = session_.run();
  if (run == nullptr || (!run->underWay() && (run->trialsLeft() == 0 || run->latest().trial == 0))) return true;
  return ask(*this, "askToEndRun", "A run is open",
             QStringLiteral("%1 of %2 trials are done. %3 ends the run. The finished trials stay in %4, and Trial, Resume the session "
                            "continues with the others.")
                 .arg(run->trialCount() - run->trialsLeft() - (run->underWay() ? 1 : 0))
                 .arg(run->trialCount())
                 .arg(doing, dataFolder()),
             "End the run", "Continue it");
}

bool MainWindow::mayKeepValues(const QString& doing) {
  QStringList faults;
  for (const docks::Dock* dock : docks_.all)
    if (dock != docks_.session) faults << dock->fault();
  faults.removeAll({});
  if (faults.isEmpty()) return true;
  faults << "The experiment has the last correct values of these fields.";
  if (!ask(*this, "askAboutFaults", "A field is wrong", faults.join(QLatin1Char('\n')), doing, "Cancel")) return false;
  for (docks::Dock* dock : docks_.all) dock->showExperiment(session_.compiled(), !session_.isPlan());
  return true;
}

// A session that is resumed with another device asks, because its trials would not be comparable.
bool MainWindow::mayUseDevice() {
  if (!session_.resumes()) return true;
  const session::SessionPlace place = docks_.session->request().place;
  std::vector<std::string> mappings;  // the run says so
  const QString now = QString::fromStdString(devices::withKeptMappings(docks_.session->device(), place.data, place.subject, mappings));
  std::vector<std::string> unreadable;  // the run says so
  const std::vector<session::RecordedBlock> recorded = session::readRecordedBlocks(place, unreadable);
  const QString before = QString::fromStdString(session::otherDeviceBefore(recorded, now.toStdString()));
  return before.isEmpty() ||
         ask(*this, "askAboutDevice", "Another device",
             QStringLiteral("This session was recorded with the device %1. You resume it with %2, and its trials may not be comparable.")
                 .arg(before, now),
             QStringLiteral("Use %1").arg(now), "Cancel");
}

bool MainWindow::mayBeLeft() {
  return edits_.stack().isClean() ||
         widgets::askToSave(
             *this,
             QStringLiteral("%1 was changed, and the file is not saved. Recordings keep the experiment with which they were made.")
                 .arg(QString::fromStdString(session_.experiment().name)),
             [this] { return saveExperiment(); });
}

void MainWindow::markTrial(int number, const std::function<void(record::TrialMark&)>& change) {
  if (session_.run() == nullptr) return warn(tr("The run is closed. Mark its trials on the page Inspect."));
  const QString fault = widgets::faultIn([&] {
    const std::string& log = session_.run()->logPath();
    record::RunMarks marks = record::readMarks(log);
    record::TrialMark mark{.trial = number};
    if (const record::TrialMark* known = marks.find(number)) mark = *known;
    change(mark);
    marks.set(mark);
    record::writeMarks(log, marks);
    docks_.trials->setMark(number, mark);
  });
  messages_->say(widgets::Grade::Error, fault);
}

void MainWindow::savePicture() {
  const QImage picture = view_->grabScene();
  QString file = QFileDialog::getSaveFileName(this, tr("Save picture"), "scene.png", tr("PNG (*.png)"));
  if (file.isEmpty()) return;
  if (QFileInfo(file).suffix().isEmpty()) file += ".png";
  if (picture.save(file)) tell(tr("Written: %1").arg(file));
  else say(tr("%1 cannot be written. Choose another folder, or free disk space.").arg(file));
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls() && event->mimeData()->urls().front().isLocalFile()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  event->acceptProposedAction();
  openExperiment(event->mimeData()->urls().front().toLocalFile());
}

void MainWindow::edit(const experiment::Experiment& changed, const QString& doing, const QString& what) {
  if (!mayEndRun(doing)) return;
  if (const QStringList faults = edits_.tryEdit(changed, what); !faults.isEmpty()) say(faults.join(QLatin1Char('\n')));
}

bool MainWindow::event(QEvent* event) {
  if (layoutTimer_ != nullptr && (event->type() == QEvent::Resize || event->type() == QEvent::Move)) layoutTimer_->start();
  return QMainWindow::event(event);
}

void MainWindow::closeEvent(QCloseEvent* event) {
  takeEntry();
  if (!mayEndRun("Closing the window") || !mayBeLeft() || !plans_->mayBeLeft()) return event->ignore();
  rememberLayout(*this, layout_);
  session_.endRun();  // an unfinished trial is kept as interrupted
  screens_->closeSubject();
  QMainWindow::closeEvent(event);
}

}  // namespace reachlab::gui::app
