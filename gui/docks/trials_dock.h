#pragma once
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "gui/docks/dock.h"
#include "sim/record/trial_marks.h"
#include "sim/trial/outcome.h"

class QTableWidget;

namespace reachlab::gui::docks {

/// The trials of the open run, the newest on top: outcome, reason, time, and distance of the hand from a criterion.
class TrialsDock : public Dock {
  Q_OBJECT
 public:
  explicit TrialsDock(QWidget* parent = nullptr);
  void clear();
  /// `number`: as recorded.
  void add(int number, const trial::TrialResult& result);
  /// The paper's epsilon of the newest trial, one a criterion. [m/s]
  void setErrors(const std::vector<std::optional<double>>& errors);
  /// Selects the criterion of the shown epsilon: an index into the errors, and its title.
  void showCriterion(std::size_t index, const QString& title);
  /// Shows the mark of a trial.
  void setMark(int number, const record::TrialMark& mark);

 Q_SIGNALS:
  /// A row was double-clicked: something is to be noted about that trial.
  void noteRequested(int number);
  /// The mark of a trial is to be changed: that of the chosen row, or else of the newest.
  void markRequested(int number, const std::function<void(reachlab::record::TrialMark&)>& change);
  void takeBackRequested();

 private:
  struct Row {
    int number = 0;
    trial::TrialResult result;
    std::vector<std::optional<double>> errors;
    record::TrialMark mark = {};
  };
  const Row* chosen() const;  // or else the newest; null if there is no trial
  void flag();
  void exclude();
  void fill(int tableRow);

  QTableWidget* table_;
  std::deque<Row> rows_;  // the newest first
  std::size_t criterion_ = 0;
};

}  // namespace reachlab::gui::docks
