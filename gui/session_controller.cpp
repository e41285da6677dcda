#include "gui/session_controller.h"

#include <QRegularExpression>
#include <QThread>

#include "base/error.h"
#include "base/json_tree.h"
#include "sim/session/plan.h"

namespace reachlab::gui {
namespace {

// The experiment that is shown before anything is run: the file itself, or a plan's first block.
experiment::Experiment firstExperiment(const session::SessionRequest& request, bool& isPlanFile) {
  isPlanFile = false;
  if (const auto file = session::findPlan(request.what)) {
    const std::string text = readTextFile(*file);
    if (session::isPlan(text, *file)) {
      isPlanFile = true;
      const session::SessionToRun session = session::planSession(request);
      if (session.blocks.empty())
        throw UsageError(request.what + ": every trial of this session is recorded; allowed: another --session or --subject");
      return session.blocks.front().experiment;
    }
  }
  return experiment::readExperiment(request.what);
}

// The reader speaks of a file's lines and keys; what is edited here has neither.
QString inWords(const std::string& problem) {
  QString words = QString::fromStdString(problem);
  static const QRegularExpression place(QStringLiteral("^.*?:\\d+:\\d+: (?:object\\.|task\\.|coupling\\.)?"));
  words.remove(place);
  words.replace(QLatin1String("masses_kg: has"), QLatin1String("masses:"));
  words.replace(QLatin1String("constraint { \"name\": \"free\" }"), QLatin1String("the constraint free"));
  return words;
}

}  // namespace

SessionController::SessionController(const session::SessionRequest& request, QObject* parent)
    : QObject(parent), experiment_(firstExperiment(request, isPlan_)), constraint_(constraints::makeConstraint(experiment_.constraint)),
      resume_(request.resume) {}

SessionController::~SessionController() = default;

QStringList SessionController::tryEdit(const experiment::Experiment& experiment) {
  QStringList faults;
  for (const std::string& problem : experiment::problems(experiment)) faults << inWords(problem);
  if (!faults.isEmpty()) return faults;
  try {
    constraints::Constraint constraint = constraints::makeConstraint(experiment.constraint);
    experiment::Experiment probe = experiment;
    (void)dynamics::compileScene(probe);  // refused now, with the reason, and not when the subject sits there
    constraint_ = std::move(constraint);
  } catch (const Error& e) {
    return {QString::fromUtf8(e.what())};
  }
  experiment_ = experiment;
  experiment_.text = experiment::toJson(experiment_);
  edited_ = true;
  if (underWay()) endAfterTrial_ = true;
  else endRun();
  Q_EMIT experimentChanged();
  return {};
}

void SessionController::open(const session::SessionRequest& request) {
  session::SessionRequest asked = request;
  asked.resume = resume_;
  session::BlockToRun block;
  if (!isPlan_ || blocks_.empty()) {
    session::SessionToRun session = session::planSession(asked);
    if (session.blocks.empty()) throw UsageError("nothing is left to do: every trial of this session is recorded");
    blocks_ = std::move(session.blocks);
    resume_ = false;
  }
  block = std::move(blocks_.front());
  blocks_.erase(blocks_.begin());
  if (!isPlan_) blocks_.clear();
  if (isPlan_) {
    experiment_ = block.experiment;
    constraint_ = constraints::makeConstraint(experiment_.constraint);
    Q_EMIT experimentChanged();
  } else if (edited_) {
    block.experiment = experiment_;
    block.configuration.experimentText = experiment_.text;
    block.configuration.definitionText = experiment::definitionTextOf(experiment_);
  }
  run_ = std::make_unique<WindowRun>(block, asked.device, asked.place.data);
  last_.reset();
  Q_EMIT runOpened();
}

bool SessionController::next(const session::SessionRequest& request) {
  if (underWay()) return false;
  if (run_ && run_->trialsLeft() == 0) {
    const bool more = !isPlan_ || !blocks_.empty();
    endRun();
    if (!more) return false;
  }
  if (!run_) open(request);
  if (!run_->putUpNext()) return false;
  Q_EMIT trialBegun();
  return true;
}

void SessionController::abort() {
  if (underWay()) run_->abort();
}

bool SessionController::repeat() {
  if (!run_ || !last_) return false;
  run_->repeat(last_->planned);
  return true;
}

void SessionController::note(const QString& text) {
  if (!run_) return;
  try {
    run_->note(text.toStdString());
  } catch (const Error& e) {
    fail(e);
  }
}

void SessionController::endRun() {
  if (!run_) return;
  endAfterTrial_ = false;
  const std::unique_ptr<WindowRun> ending = std::move(run_);
  try {
    if (ending->underWay()) ending->interrupt();
    for (int looks = 0; looks < 50 && ending->underWay(); ++looks) {  // the loop takes the command within a tick
      QThread::msleep(2);
      (void)ending->poll();
    }
    ending->finish();
  } catch (const std::exception& e) {
    Q_EMIT failed(QString::fromUtf8(e.what()));
  }
  Q_EMIT runClosed();
}

void SessionController::pointTo(double x, double y, double z) {
  if (run_) run_->pointTo({x, y, z});
}

void SessionController::poll() {
  if (!run_) return;
  try {
    const auto ended = run_->poll();
    if (!ended) return;
    last_ = *ended;
    Q_EMIT trialEnded();
    if (endAfterTrial_) endRun();
  } catch (const std::exception& e) {
    fail(e);
  }
}

// The run cannot go on: what was finished is on the disk, and the loop ends with zero force.
void SessionController::fail(const std::exception& fault) {
  const QString sentence = QString::fromUtf8(fault.what());
  const std::unique_ptr<WindowRun> broken = std::move(run_);
  Q_EMIT failed(sentence);
  Q_EMIT runClosed();
}

}  // namespace reachlab::gui
