#pragma once
#include <QWidget>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "gui/inspector/analysis_lines.h"
#include "gui/inspector/dataset_analysis.h"
#include "gui/inspector/trial_table.h"
#include "gui/widgets/qt_names.h"

namespace reachlab::gui::inspector {

class EpsilonPanel;
class MarksPanel;
class ProfilePlot;
class ReplayView;

/// Page of recordings: a table of trials, velocities of the chosen trials, a 3D replay, both epsilons, and marks by a person. Line, row and
/// replay are linked. Nothing here changes a recording, because marks are files beside it.
class InspectorPage : public QWidget {
  Q_OBJECT
 public:
  explicit InspectorPage(QWidget* parent = nullptr);
  struct Key {
    QString keys, words;
    void (*act)(InspectorPage& page);
  };
  /// The keys of this page, for itself and for the list of all keys.
  static const std::vector<Key>& keys();
  /// Opens a dataset, a session or a log on another thread, with progress. Faults are shown.
  void open(const QString& path);
  QString path() const { return path_; }
  /// Analyses it with the program `reach`, whether it is open here or not. `reported` follows.
  void report(const QString& dataset);
  TrialTable& table() { return *table_; }
  QTableView& view() { return *view_; }
  ProfilePlot& plot() { return *plot_; }
  ReplayView& replay() { return *replay_; }
  /// The inspection of the chosen trials. Null while it is read.
  const Inspection* inspection() const { return inspection_.get(); }
  bool busy() const { return opener_.busy() || inspector_.busy() || analysis_.busy(); }
  /// Everything that is chosen as a figure (by the file's ending: svg, pdf, png) or as lines (csv). Throws ResourceError.
  void exportTo(const QString& file);
  /// The table's rows as they are shown. Throws ResourceError.
  void exportTable(const QString& file);

 Q_SIGNALS:
  /// One sentence for the user. An empty sentence removes it.
  void said(const QString& sentence);
  /// News of a success.
  void told(const QString& sentence);
  /// A report that was asked for is written, and to be shown.
  void reported(const QString& file);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void addTop(QVBoxLayout& layout);
  QWidget* makeLeft();
  QWidget* makeRight();
  void wire();
  void addKeys();
  void opened(const record::TrialIndex& index);
  void fitColumns();
  void fitHalves();
  void inspect();
  void showRead();
  void showJudged();
  void draw();
  void pick(int row);
  void showPicked();
  void marksDragged(double onset, double end);
  void setMark(const record::TrialMark& mark);
  void save(const QString& title, const QString& proposed, const QString& kinds, const std::function<void(const QString&)>& write);
  /// Runs it. If it fails, says why and returns false.
  bool attempt(const std::function<void()>& work);
  TimeAxis timeAxis() const;
  ShownPredictions shownPredictions() const;
  int rowOf(const analysis::TrialKey& key) const;
  std::vector<int> chosenRows() const;
  std::size_t condition() const;
  std::optional<std::size_t> lineOf(int row) const;
  const analysis::Recording& recordingOf(const std::string& path);

  QString path_;
  std::shared_ptr<const Inspection> inspection_;
  std::vector<int> inspectedRows_;  // of the table, one a trial of the inspection
  int picked_ = -1;
  DatasetAnalysis analysis_;
  Inspector opener_, inspector_;                           // a choice of the old table's trials does not end the opening of the new one
  std::map<std::string, analysis::Recording> recordings_;  // that are being looked at
  analysis::ScenesOfRuns scenes_;
  TrialTable* table_;
  QSortFilterProxyModel* filter_;
  QTableView* view_;
  QSplitter* halves_;         // the table and what is drawn of it
  bool halvesMoved_ = false;  // by hand
  int outcomeWidth_ = 0;      // [px] of all of its words
  QLineEdit* words_;
  QLabel *title_, *count_;
  QComboBox *signal_, *axis_;
  QCheckBox *predicted_, *fitted_;
  ProfilePlot* plot_;
  ReplayView* replay_;
  EpsilonPanel* epsilons_;
  MarksPanel* marks_;
  QProgressBar* progress_;
  QPushButton *cancel_, *report_;
  QTimer* soon_;
};

}  // namespace reachlab::gui::inspector
