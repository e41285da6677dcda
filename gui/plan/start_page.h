#pragma once
#include "gui/widgets/card.h"
#include "gui/widgets/qt_names.h"
#include "sim/session/session_progress.h"

namespace reachlab::gui::plan {

/// The page over the scene before a session's run: subject, day, finished blocks, remaining blocks, and the next step. Depends on the
/// progress, not on the session.
class StartPage : public widgets::CardFrame {
  Q_OBJECT
 public:
  explicit StartPage(QWidget& over);
  struct Shown {
    QString plan, subject, session;
    int day = 0;  // 0: the plan has none
    session::SessionProgress progress;
    QString fault;  // why nothing can be begun; empty: it can
  };
  void show(const Shown& shown);
  /// Resumes the session that was begun, instead of starting from the beginning.
  bool resumes() const { return resumes_; }
  /// The text for the subject before the next block. Empty if the plan has no text for it.
  const QString& instructions() const { return instructions_; }

 Q_SIGNALS:
  void placeEdited(const QString& subject, const QString& session);
  void beginRequested();
  void resumeRequested();
  void composeRequested();

 private:
  using QFrame::show;
  bool resumes_ = false;
  QString instructions_;
  QLabel *summary_, *next_;
  QLineEdit *subject_, *session_;
  QTableWidget* blocks_;
  QPushButton *go_, *anew_;
};

}  // namespace reachlab::gui::plan
