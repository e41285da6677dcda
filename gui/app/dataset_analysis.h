#pragma once
#include <QObject>
#include <QProcess>
#include <QString>

namespace reachlab::gui::app {

/// Analyses a dataset by the program `reach` in a process of its own, so that neither a run nor the window waits for it, or falls with it.
class DatasetAnalysis : public QObject {
  Q_OBJECT
 public:
  /// `program`: reach; empty: the one beside this program, of its build tree, or on the path.
  explicit DatasetAnalysis(QString program = {}, QObject* parent = nullptr);
  ~DatasetAnalysis() override;

  /// Begins; one at a time.
  void begin(const QString& dataset);

 Q_SIGNALS:
  /// One sentence: why it cannot be had, or what `reach` said when it failed.
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
