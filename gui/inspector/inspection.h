#pragma once
#include <QObject>
#include <QString>
#include <memory>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include "analysis/chosen_trials.h"
#include "analysis/dataset.h"

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
  explicit Inspector(QObject* parent = nullptr);
  ~Inspector() override;

  /// `read` follows, then `judged`. The numbers are `reach analyze`'s for a dataset of just these trials.
  void begin(std::vector<analysis::ChosenTrials> chosen);
  /// `fitted` follows, if the trials can be fitted. No sample of them stays in memory.
  void fit(std::vector<analysis::ChosenTrials> chosen);
  /// Analyses the dataset at `path` as `reach analyze` does and writes report, tables and figures into its folder. `reported` follows.
  void report(const QString& path);
  /// Stops the work under way. `idle` follows.
  void cancel();
  bool busy() const { return busy_; }

 Q_SIGNALS:
  void read(const std::shared_ptr<const reachlab::gui::inspector::Inspection>& inspection);
  void judged(const std::shared_ptr<const reachlab::gui::inspector::Inspection>& inspection);
  /// The fitted epsilon of each criterion over the chosen trials. [m/s]
  void fitted(const std::vector<std::optional<double>>& epsilons);
  void reported(const QString& file);
  void progressed(const QString& what, int done, int of);
  void failed(const QString& sentence);
  void idle();

 private:
  template <typename Work>
  void start(Work work);
  template <typename Tell>
  void tell(int turn, Tell tell);

  int turn_ = 0;  // of the newest request
  bool busy_ = false;
  std::jthread thread_;
};

/// Where the report of a dataset goes, as `reach analyze` chooses it, or that of a single log: a folder beside it.
std::string reportFolderOf(const std::string& path);

/// Onset, end and velocities of trials, by the rules of the analysis.
std::shared_ptr<Inspection> measure(analysis::AnalysisInput input);

}  // namespace reachlab::gui::inspector
