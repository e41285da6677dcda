#include "gui/session/remembered_session.h"

#include <QFileInfo>
#include <QSettings>

#include "sim/experiment/compiled_experiment.h"
#include "sim/record/log/append_file.h"
#include "sim/session/plan.h"

namespace reachlab::gui::app {
namespace {

QString textOf(const QSettings& settings, const char* key) { return settings.value(QLatin1String(key)).toString(); }

void keep(const char* key, const std::string& text) {
  QSettings settings;
  const QString value = QString::fromStdString(text);
  if (settings.value(QLatin1String(key)).toString() != value) settings.setValue(QLatin1String(key), value);
}

std::string absolute(const std::string& path) { return QFileInfo(QString::fromStdString(path)).absoluteFilePath().toStdString(); }

}  // namespace

void rememberRequest(const session::SessionRequest& request) {
  keep("session/subject", request.place.subject);
  keep("session/session", request.place.session);
  keep("session/data", absolute(request.place.data));
  keep("session/device", request.device);
  if (request.trials) keep("session/trials", std::to_string(*request.trials));
}

session::SessionRequest rememberedRequest(session::SessionRequest request) {
  const QSettings settings;
  const auto recall = [&](const char* key, std::string& value) {
    if (const QString text = textOf(settings, key); !text.isEmpty()) value = text.toStdString();
  };
  recall("session/subject", request.place.subject);
  recall("session/session", request.place.session);
  recall("session/data", request.place.data);
  recall("session/device", request.device);
  return request;
}

std::optional<int> rememberedTrials() {
  const int trials = textOf(QSettings(), "session/trials").toInt();
  return trials > 0 ? std::optional(trials) : std::nullopt;
}

void rememberOpenRun(const record::RunConfiguration& run, const session::SessionRequest& request) {
  const auto path = run.planText.empty() ? std::nullopt : session::findPlan(request.what);
  keep("openRun/plan", path ? absolute(*path) : std::string());
  keep("openRun/experiment", path ? std::string() : run.experimentText);
  keep("openRun/name", run.experimentName);
  keep("openRun/definition", path ? std::string() : run.definitionText);
  keep("openRun/data", absolute(request.place.data));
  keep("openRun/subject", run.subject);
  keep("openRun/session", run.session);
  keep("openRun/age", run.participant.age ? QString::number(*run.participant.age).toStdString() : std::string());
  keep("openRun/sex", run.participant.sex);
  keep("openRun/handedness", run.participant.handedness);
  keep("openRun/day", std::to_string(request.day.value_or(0)));
  keep("openRun/device", request.device);
  keep("openRun/seed", std::to_string(run.sessionSeed));
  keep("openRun/trials", std::to_string(run.trials.size()));
  keep("openRun/run", std::to_string(run.run));
}

void forgetOpenRun() { QSettings().remove("openRun"); }

std::optional<InterruptedRun> findInterruptedRun() {
  const QSettings settings;
  const auto text = [&settings](const char* key) { return textOf(settings, key).toStdString(); };
  InterruptedRun found;
  found.run = textOf(settings, "openRun/run").toInt();
  if (found.run == 0) return std::nullopt;
  session::SessionRequest& r = found.request;
  r.place = {text("openRun/data"), text("openRun/subject"), text("openRun/session")};
  for (const session::RunOnDisk& run : session::recordedRuns(r.place))
    if (record::isBeingWritten(run.path)) return std::nullopt;
  if (const int day = textOf(settings, "openRun/day").toInt(); day > 0) r.day = day;
  if (const QString age = textOf(settings, "openRun/age"); !age.isEmpty()) r.participant.age = age.toDouble();
  r.participant.sex = text("openRun/sex");
  r.participant.handedness = text("openRun/handedness");
  r.device = text("openRun/device");
  found.seed = textOf(settings, "openRun/seed");
  r.resume = true;
  r.what = text("openRun/plan");
  if (r.what.empty()) {
    found.programme =
        session::programmeOf(experiment::openExperimentText(text("openRun/experiment"), text("openRun/name"), text("openRun/definition")));
    r.trials = textOf(settings, "openRun/trials").toInt();
  } else {
    found.programme = session::readProgramme(r.what);
  }
  const session::SessionToRun left = session::planSession(r, found.programme);
  if (left.blocks.empty()) return std::nullopt;
  const session::BlockToRun& block = left.blocks.front();
  found.trials = static_cast<int>(block.configuration.trials.size());
  found.trial = found.trials - static_cast<int>(block.trials.size()) + 1;
  return found;
}

}  // namespace reachlab::gui::app
