#pragma once
#include <QObject>

class QLineEdit;
class QWidget;

namespace reachlab::gui::app {

/// Decides which widget gets the keys of a window. A text field gets them only while the user types in it. Enter keeps an entry and Esc
/// leaves it. Both give the keys back to the scene. Undo and redo belong to the window if the field has nothing to undo.
class KeyFocus : public QObject {
  Q_OBJECT
 public:
  /// Watches the fields of `window`. The widget `home` gets the keys back.
  KeyFocus(QWidget& window, QWidget& home);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QWidget& window_;
  QWidget& home_;
};

}  // namespace reachlab::gui::app
