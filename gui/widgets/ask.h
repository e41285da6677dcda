#pragma once
#include <QWidget>
#include <functional>

/// Questions before something would be lost. The usual choice loses nothing, and closing a question chooses it.
namespace reachlab::gui::widgets {

bool ask(QWidget& window, const char* name, const QString& title, const QString& text, const QString& yes, const QString& no);

/// Whether something that was changed may be left: because `save` has saved it, or because its changes are discarded.
bool askToSave(QWidget& window, const QString& text, const std::function<bool()>& save);

}  // namespace reachlab::gui::widgets
