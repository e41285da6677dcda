#include "gui/inspector/inspection.h"

#include <QMetaObject>
#include <exception>
#include <malloc.h>

#include "analysis/report/write_analysis.h"
#include "base/system/error_report.h"
#include "gui/inspector/epsilon_panel.h"
#include "sim/record/log/log.h"

namespace reachlab::gui::inspector {
namespace {

/// Given up on the way; never leaves this file.
struct GivenUp {};

void goOnUnless(const std::stop_token& stop) {
  if (stop.stop_requested()) throw GivenUp{};
}

}  // namespace

std::string reportFolderOf(const std::string& path) {
  if (path.ends_with(record::kLogEnding)) return path.substr(0, path.size() - record::kLogEnding.size()) + "_report";
  return analysis::analysisFolderOf(path);
}

Inspector::Inspector(QObject* parent) : QObject(parent) {}
Inspector::~Inspector() = default;

template <typename Tell>
void Inspector::tell(int turn, Tell tell) {
  QMetaObject::invokeMethod(
      this,
      [this, turn, tell] {
        if (turn == turn_) tell();
      },
      Qt::QueuedConnection);
}

template <typename Work>
void Inspector::start(Work work) {
  thread_.request_stop();
  const int turn = ++turn_;
  busy_ = true;
  // The one before is waited for on the new thread, not on the window's.
  thread_ =
      std::jthread([this, turn, work, before = std::make_shared<std::jthread>(std::move(thread_))](const std::stop_token& stop) mutable {
        if (before->joinable()) before->join();
        before.reset();
        QString fault;
        try {
          goOnUnless(stop);
          work(turn, stop);
        } catch (const GivenUp&) {
        } catch (const std::exception& e) {
          fault = QString::fromStdString(errorReportOf(e).sentence);
        }
        tell(turn, [this, fault] {
          busy_ = false;
          if (!fault.isEmpty()) Q_EMIT failed(fault);
          Q_EMIT idle();
        });
      });
}

void Inspector::cancel() { thread_.request_stop(); }

void Inspector::begin(std::vector<analysis::ChosenTrials> chosen) {
  start([this, chosen = std::move(chosen)](int turn, const std::stop_token& stop) {
    const std::shared_ptr<Inspection> found = measure(analysis::readChosen(chosen, [&] { return !stop.stop_requested(); }));
    goOnUnless(stop);
    tell(turn, [this, found = std::shared_ptr<const Inspection>(std::make_shared<Inspection>(*found))] { Q_EMIT read(found); });
    if (found->input.trials.empty()) return;
    const int count = static_cast<int>(found->input.trials.size());
    found->analysis = std::make_shared<analysis::Analysis>(analysis::analyzeTrials(found->input, {}, [&](std::size_t done, std::size_t) {
      goOnUnless(stop);
      tell(turn, [this, done, count] { Q_EMIT progressed(tr("fitting"), static_cast<int>(done), count); });
    }));
    goOnUnless(stop);
    tell(turn, [this, found = std::shared_ptr<const Inspection>(found)] { Q_EMIT judged(found); });
  });
}

void Inspector::fit(std::vector<analysis::ChosenTrials> chosen) {
  start([this, chosen = std::move(chosen)](int turn, const std::stop_token& stop) {
    std::vector<std::optional<double>> epsilons;
    {
      const analysis::Analysis analysis = analysis::analyzeChosen(chosen, {}, [&] { goOnUnless(stop); });
      if (!analysis.results.empty())
        for (const predict::Criterion criterion : predict::kAllCriteria) epsilons.push_back(fittedEpsilon(analysis, 0, criterion));
    }
    goOnUnless(stop);
    malloc_trim(0);  // a day has hundreds of fits, each on another thread, whose heap would keep what it no longer needs
    tell(turn, [this, epsilons] { Q_EMIT fitted(epsilons); });
  });
}

void Inspector::report(const QString& path) {
  start([this, path = path.toStdString()](int turn, const std::stop_token& stop) {
    const auto told = [&](const QString& what, std::size_t done, std::size_t of) {
      goOnUnless(stop);
      tell(turn, [this, what, done, of] { Q_EMIT progressed(what, static_cast<int>(done), static_cast<int>(of)); });
    };
    analysis::AnalysisBuilder builder({});
    const analysis::DatasetIndex dataset =
        analysis::readDataset(path,
                              {[&](analysis::TrialData&& trial, std::size_t condition) {
                                 goOnUnless(stop);
                                 builder.add(std::move(trial), condition);
                               },
                               [&](std::size_t count) { builder.takeBack(count); }},
                              "", [&](std::size_t done, std::size_t of, const std::string&) { told(tr("reading run"), done, of); });
    const analysis::Analysis analysis =
        builder.finish(dataset.conditions, [&](std::size_t done, std::size_t of) { told(tr("fitting trial"), done, of); });
    std::string folder = path;
    while (folder.size() > 1 && folder.back() == '/') folder.pop_back();
    const std::string out = reportFolderOf(folder);
    const analysis::AnalysisFiles files =
        analysis::writeAnalysis(analysis, dataset, {folder, REACHLAB_VERSION, "reach analyze " + folder + " --out " + out}, out);
    tell(turn, [this, file = QString::fromStdString(files.report)] { Q_EMIT reported(file); });
  });
}

std::shared_ptr<Inspection> measure(analysis::AnalysisInput input) {
  auto inspection = std::make_shared<Inspection>();
  inspection->input = std::move(input);
  for (const analysis::TrialData& trial : inspection->input.trials) inspection->signals.push_back(analysis::computeSignals(trial, {}));
  return inspection;
}

}  // namespace reachlab::gui::inspector
