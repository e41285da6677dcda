#pragma once
#include <QWidget>

class QVBoxLayout;

namespace reachlab::gui::widgets {

/// How serious a message is: a success, a remark that needs attention, an error.
enum class Grade { Done, Attention, Error };

/// Messages over the lower part of a widget. They close themselves, except for errors. An error stays until the user closes it or `clear`.
class Messages : public QWidget {
 public:
  explicit Messages(QWidget& over);
  /// Adds a message as the lowest. A sentence that is already shown is not added again.
  void say(Grade grade, const QString& sentence);
  void clear();
  /// The newest sentence, or an empty string if there is no message.
  QString newest() const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place();
  QWidget& over_;
  QVBoxLayout* rows_;
};

}  // namespace reachlab::gui::widgets
