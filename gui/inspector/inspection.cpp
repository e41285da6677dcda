#include "gui/inspector/inspection.h"

#include <QFileInfo>
#include <QStandardPaths>
#include <malloc.h>

#include "base/fault.h"
#include "gui/inspector/epsilon_panel.h"
#include "sim/record/log/log.h"

namespace reachlab::gui::inspector {
namespace {

// A folder without logs may hold what was exported from them.
bool hasLogs(const std::string& path) {
  try {
    return !record::findLogs(path).empty();
  } catch (const FaultError&) {
    return !QFileInfo(QString::fromStdString(path)).isDir();
  }
}

// Onset, end and velocities of the trials, by the rules of the analysis.
Inspection measure(analysis::AnalysisInput input) {
  Inspection inspection{std::move(input), {}, nullptr};
  for (const analysis::TrialData& trial : inspection.input.trials) inspection.signals.push_back(analysis::computeSignals(trial, {}));
  return inspection;
}

}  // namespace

template <typename Work>
void Inspector::start(Work work) {
  work_.begin(work, [this](const QString& fault) {
    if (!fault.isEmpty()) Q_EMIT failed(fault);
    Q_EMIT idle();
  });
}

void Inspector::tellProgress(const Turn& turn, const QString& what, std::size_t done, std::size_t of) {
  turn.tell([this, what, done, of] { Q_EMIT progressed(what, static_cast<int>(done), static_cast<int>(of)); });
}

void Inspector::open(const QString& path) {
  start([this, path = path.toStdString()](const Turn& turn) {
    const QString cache = QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation) + "/reachlab";
    const record::IndexProgress progress = [&](std::size_t done, std::size_t of) {
      tellProgress(turn, tr("indexing"), done, of);
      return !turn.stop.stop_requested();
    };
    const auto index = std::make_shared<const record::TrialIndex>(
        hasLogs(path) ? record::openTrialIndex(path, record::indexFileFor(path, cache.toStdString()), progress)
                      : analysis::indexMotionFiles(path, progress));
    turn.tell([this, index] { Q_EMIT indexed(*index); });
  });
}

void Inspector::begin(std::vector<analysis::ChosenTrials> chosen) {
  start([this, chosen = std::move(chosen)](const Turn& turn) {
    const auto found = std::make_shared<Inspection>(measure(analysis::readChosen(chosen, [&] { return !turn.stop.stop_requested(); })));
    turn.goOn();
    turn.tell([this, read = std::make_shared<const Inspection>(*found)] { Q_EMIT inspected(read); });
    if (found->input.trials.empty()) return;
    found->analysis = std::make_shared<analysis::Analysis>(analysis::analyzeTrials(found->input, {}, [&](std::size_t done, std::size_t) {
      turn.goOn();
      tellProgress(turn, tr("fitting"), done, found->input.trials.size());
    }));
    turn.goOn();
    turn.tell([this, found] { Q_EMIT inspected(found); });
  });
}

void Inspector::fit(std::vector<analysis::ChosenTrials> chosen) {
  start([this, chosen = std::move(chosen)](const Turn& turn) {
    std::vector<std::optional<double>> epsilons;
    {
      const analysis::Analysis analysis = analysis::analyzeChosen(chosen, {}, [&] { turn.goOn(); });
      if (!analysis.results.empty())
        for (const predict::Criterion criterion : predict::kAllCriteria) epsilons.push_back(fittedEpsilon(analysis, 0, criterion));
    }
    turn.goOn();
    malloc_trim(0);  // a day has hundreds of fits, each on another thread, whose heap would keep what it no longer needs
    turn.tell([this, epsilons] { Q_EMIT fitted(epsilons); });
  });
}

}  // namespace reachlab::gui::inspector
