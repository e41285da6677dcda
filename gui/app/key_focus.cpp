#include "gui/app/key_focus.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPointer>
#include <QTimer>

#include "gui/widgets/number_list_edit.h"

namespace reachlab::gui::app {
namespace {

bool hasNothingToUndo(const QLineEdit& field, const QKeyEvent& key) {
  return (key.matches(QKeySequence::Undo) && !field.isUndoAvailable()) || (key.matches(QKeySequence::Redo) && !field.isRedoAvailable());
}

// On Linux a field takes Ctrl+E as the end of the line.
bool endsTheRun(const QKeyEvent& key) { return key.key() == Qt::Key_E && key.modifiers() == Qt::ControlModifier; }

// A wrong entry is mended where it stands.
bool isToBeMended(const QLineEdit& field) {
  const auto* list = qobject_cast<const widgets::NumberListEdit*>(&field);
  return list != nullptr && !list->fault().isEmpty();
}

}  // namespace

KeyFocus::KeyFocus(QWidget& window, QWidget& home) : QObject(&window), window_(window), home_(home) { qApp->installEventFilter(this); }

bool KeyFocus::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::ShortcutOverride && event->type() != QEvent::KeyPress) return false;
  auto* widget = qobject_cast<QWidget*>(watched);
  if (widget == nullptr || widget->window() != &window_) return false;
  auto* field = qobject_cast<QLineEdit*>(widget);
  if (qobject_cast<QAbstractSpinBox*>(widget) != nullptr) field = widget->findChild<QLineEdit*>();
  if (field == nullptr) return false;
  const auto* key = static_cast<QKeyEvent*>(event);
  if (event->type() == QEvent::ShortcutOverride) {
    if (!hasNothingToUndo(*field, *key) && !endsTheRun(*key)) return false;
    event->ignore();
    return true;
  }
  const bool kept = key->key() == Qt::Key_Return || key->key() == Qt::Key_Enter;
  // When the field has taken the key.
  if (key->key() == Qt::Key_Escape || kept)
    QTimer::singleShot(0, &home_, [this, kept, field = QPointer<QLineEdit>(field)] {
      if (field && !(kept && isToBeMended(*field))) home_.setFocus(Qt::OtherFocusReason);
    });
  return false;
}

}  // namespace reachlab::gui::app
