#pragma once
#include <QString>
#include <utility>

namespace reachlab::gui::widgets {

/// A new widget with an object name, by which layouts, styles and tests find it.
template <typename Widget, typename... Arguments>
Widget* named(const char* name, Arguments&&... arguments) {
  auto* widget = new Widget(std::forward<Arguments>(arguments)...);
  widget->setObjectName(QLatin1String(name));
  return widget;
}

}  // namespace reachlab::gui::widgets
