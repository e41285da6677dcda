#pragma once
#include <QAbstractTableModel>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "sim/predict/predict.h"
#include "sim/record/trial_index.h"
#include "sim/record/trial_marks.h"

namespace reachlab::gui::inspector {

/// How far a trial's hand was from each criterion. [m/s]
struct TrialErrors {
  using One = std::array<std::optional<double>, static_cast<std::size_t>(predict::kCriterionCount)>;
  One paper, fitted;  // the paper's epsilon, the fitted epsilon: as `reach analyze` has them
};

/// Every trial of an index as a row, with its marks and computed values so far. Sorts by Qt::UserRole, and is filtered by kWordsRole.
class TrialTable : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { kSubject, kSession, kCondition, kRun, kTrial, kOutcome, kTime, kPeak, kPaper, kFitted, kMark, kColumns };
  static constexpr int kWordsRole = Qt::UserRole + 1;  // every word of a row, in small letters
  explicit TrialTable(QObject* parent = nullptr);

  void setIndex(record::TrialIndex index);
  const record::TrialIndex& recordings() const { return index_; }
  const record::IndexedRun& run(int row) const { return index_.runs[places_[static_cast<std::size_t>(row)].run]; }
  const record::RecordedTrial& trial(int row) const;
  /// The row of that trial of that log, or -1.
  int rowOf(const std::string& log, int trial) const;

  /// Marks beside the trial's log. They are read when the run is first asked for, and written at once. Throws the errors of reading and
  /// writing marks.
  record::TrialMark mark(int row) const;
  void setMark(int row, const record::TrialMark& mark);

  void setErrors(int row, const TrialErrors& errors);
  /// Of which criterion the two columns of epsilon tell.
  void showCriterion(predict::Criterion criterion);

  int rowCount(const QModelIndex& parent = {}) const override { return parent.isValid() ? 0 : static_cast<int>(places_.size()); }
  int columnCount(const QModelIndex& parent = {}) const override { return parent.isValid() ? 0 : kColumns; }
  QVariant data(const QModelIndex& at, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  struct Place {
    std::uint32_t run = 0, trial = 0;
  };
  const record::RunMarks& marksOf(std::size_t run) const;
  QString text(int row, int column) const;
  QString words(int row) const;
  QString markWords(int row) const;
  QVariant sortKey(int row, int column) const;
  std::optional<double> error(int row, bool fitted) const;

  record::TrialIndex index_;
  std::vector<Place> places_;
  std::vector<std::size_t> firstRow_;                           // of each run
  mutable std::vector<std::optional<record::RunMarks>> marks_;  // one a run
  std::map<int, TrialErrors> errors_;                           // of the rows for which they are computed
  predict::Criterion criterion_ = predict::Criterion::MinHandJerk;
};

/// As a file: the columns that are shown, of these rows of `table`, numbers with all their digits.
std::string toCsv(const TrialTable& table, const std::vector<int>& rows);

}  // namespace reachlab::gui::inspector
