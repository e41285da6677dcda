#pragma once
#include <QObject>
#include <QProcess>
#include <QString>

namespace reachlab::gui::app {

/// Analyses a dataset with the program `reach`, in a separate process. Neither a run nor the window waits for it, and neither fails with
/// it.
class DatasetAnalysis : public QObject {
  Q_OBJECT
 public:
  /// `program`: the path of `reach`. If it is empty, `reach` is looked for beside this program, in its build tree, and on the path.
  explicit DatasetAnalysis(QString program = {}, QObject* parent = nullptr);
  ~DatasetAnalysis() override;

  /// Begins an analysis. Only one runs at a time.
  void begin(const QString& dataset);

 Q_SIGNALS:
  /// One sentence: why no report can be made, or the error that `reach` printed.
  void said(const QString& sentence);
  /// It has begun, or the report is written.
  void told(const QString& sentence);
  /// The report is written.
  void reported(const QString& page);

 private:
  void end(bool good);
  QString program_, dataset_;
  QProcess process_;
};

}  // namespace reachlab::gui::app
