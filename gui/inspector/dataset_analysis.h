#pragma once
#include <QObject>
#include <QProcess>
#include <QString>

namespace reachlab::gui::inspector {

/// Analyses a dataset or a log with the program `reach`, in a separate process. Neither a run nor the window waits for it, and neither
/// fails with it.
class DatasetAnalysis : public QObject {
  Q_OBJECT
 public:
  /// `program`: the path of `reach`. If it is empty, `reach` is looked for beside this program, in its build tree, and on the path.
  explicit DatasetAnalysis(QString program = {}, QObject* parent = nullptr);
  ~DatasetAnalysis() override;

  /// Begins an analysis. Only one runs at a time.
  void begin(const QString& dataset);
  void cancel();
  bool busy() const { return process_.state() != QProcess::NotRunning; }

 Q_SIGNALS:
  /// One sentence: why no report can be made, or the error that `reach` printed.
  void said(const QString& sentence);
  /// It has begun, it was cancelled, or the report is written.
  void told(const QString& sentence);
  void progressed(const QString& what, int done, int of);
  /// The report is written.
  void reported(const QString& page);
  /// It has ended, in whatever way.
  void idle();

 private:
  void readProgress();
  void end(bool good);
  QString program_, dataset_, words_;
  QProcess process_;
  bool cancelled_ = false;
};

}  // namespace reachlab::gui::inspector
