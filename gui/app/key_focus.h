#pragma once
#include <QObject>

class QLineEdit;
class QWidget;

namespace reachlab::gui::app {

/// Who gets the keys of a window: a text field only while it is being typed in. Enter keeps an entry, Esc leaves it, and both give the keys
/// back to the scene; undo and redo are the window's where the field has nothing of its own to undo.
class KeyFocus : public QObject {
  Q_OBJECT
 public:
  /// Watches the fields of `window`; `home` gets the keys back.
  KeyFocus(QWidget& window, QWidget& home);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QWidget& window_;
  QWidget& home_;
};

}  // namespace reachlab::gui::app
