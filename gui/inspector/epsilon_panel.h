#pragma once
#include <QWidget>
#include <vector>

#include "analysis/analysis.h"
#include "gui/widgets/qt_names.h"

namespace reachlab::gui::inspector {

/// The two errors of each criterion over chosen trials, as the report has them: the paper's epsilon and the fitted epsilon. They are for
/// one person or for several. Ticked criteria are drawn.
class EpsilonPanel : public QWidget {
  Q_OBJECT
 public:
  explicit EpsilonPanel(QWidget* parent = nullptr);
  /// Of this condition of the study.
  void show(const analysis::Analysis& analysis, std::size_t condition);
  /// Nothing is known (yet): why.
  void clear(const QString& why);
  std::vector<predict::Criterion> chosen() const;
  /// The first ticked criterion, which the table of trials shows.
  predict::Criterion first() const;

 Q_SIGNALS:
  void chosenChanged();

 private:
  using QWidget::show;
  QTableWidget* table_;
  QLabel* told_;
};

/// The fitted epsilon of the candidate for `criterion`, over all samples of the condition's fitted people. [m/s]
std::optional<double> fittedEpsilon(const analysis::Analysis& analysis, std::size_t condition, predict::Criterion criterion);

}  // namespace reachlab::gui::inspector
