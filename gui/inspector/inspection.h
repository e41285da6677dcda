#pragma once
#include <QObject>
#include <QString>
#include <memory>
#include <optional>
#include <vector>

#include "analysis/chosen_trials.h"
#include "analysis/dataset.h"
#include "gui/widgets/newest_work.h"

namespace reachlab::gui::inspector {

/// Chosen trials as the analysis sees them: read, measured and, a little later, judged.
struct Inspection {
  analysis::AnalysisInput input;
  std::vector<analysis::TrialSignals> signals;         // one a trial
  std::shared_ptr<const analysis::Analysis> analysis;  // null until judged
};

/// Reads and judges on another thread. A new request replaces the work under way. All signals are emitted on the window's thread.
class Inspector : public QObject {
  Q_OBJECT
 public:
  /// Lists the trials of a dataset, a session or a log. `indexed` follows, with the trials found so far if it is cancelled.
  void open(const QString& path);
  /// `inspected` follows when the trials are read, and once more when they are judged. The numbers are `reach analyze`'s for a dataset of just these trials.
  void begin(std::vector<analysis::ChosenTrials> chosen);
  /// `fitted` follows, if the trials can be fitted. No sample of them stays in memory.
  void fit(std::vector<analysis::ChosenTrials> chosen);
  /// Stops the work under way. `idle` follows.
  void cancel() { work_.stop(); }
  bool busy() const { return work_.busy(); }

 Q_SIGNALS:
  void indexed(const reachlab::record::TrialIndex& index);
  void inspected(const std::shared_ptr<const reachlab::gui::inspector::Inspection>& inspection);
  /// The fitted epsilon of each criterion over the chosen trials. [m/s]
  void fitted(const std::vector<std::optional<double>>& epsilons);
  void progressed(const QString& what, int done, int of);
  void failed(const QString& sentence);
  void idle();

 private:
  using Turn = widgets::NewestWork::Turn;
  template <typename Work>
  void start(Work work);
  void tellProgress(const Turn& turn, const QString& what, std::size_t done, std::size_t of);

  widgets::NewestWork work_{*this};
};

}  // namespace reachlab::gui::inspector
