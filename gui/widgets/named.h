#pragma once
#include <QHBoxLayout>
#include <QLabel>
#include <QScreen>
#include <QSignalBlocker>
#include <QString>
#include <QVBoxLayout>
#include <QVariant>
#include <QWidget>
#include <initializer_list>
#include <utility>

namespace reachlab::gui::widgets {

/// A new widget with an object name, by which layouts, styles and tests find it.
template <typename Widget, typename... Arguments>
Widget* named(const char* name, Arguments&&... arguments) {
  auto* widget = new Widget(std::forward<Arguments>(arguments)...);
  widget->setObjectName(QLatin1String(name));
  return widget;
}

/// The widget, with this tool tip.
template <typename Widget>
Widget* tipped(Widget* widget, const QString& tip) {
  widget->setToolTip(tip);
  return widget;
}

/// The widget, with its signals blocked until the end of the statement: `quietly(box)->setValue(3)`.
template <typename Widget>
auto quietly(Widget* widget) {
  struct Quiet {
    Widget* of;
    QSignalBlocker blocker;
    Widget* operator->() const { return of; }
  };
  return Quiet{widget, QSignalBlocker(widget)};
}

/// A label of several lines in the theme's colours of a role: "quiet" or "fault".
inline QLabel* roleLabel(const char* role, const QString& text = {}) {
  auto* label = new QLabel(text);
  label->setProperty("role", role);
  label->setWordWrap(true);
  return label;
}

/// A layout that fills the widget to its edges.
template <typename Layout>
Layout* filling(QWidget* widget, int spacing = -1) {
  auto* layout = new Layout(widget);
  layout->setContentsMargins(0, 0, 0, 0);
  if (spacing >= 0) layout->setSpacing(spacing);
  return layout;
}

/// Adds the widgets to the layout in this order. A null among them is room that stretches, and `wide` is a widget that does.
inline void addAll(QBoxLayout& layout, std::initializer_list<QWidget*> widgets, const QWidget* wide = nullptr) {
  for (QWidget* widget : widgets) {
    if (widget == nullptr) layout.addStretch(1);
    else layout.addWidget(widget, widget == wide ? 1 : 0);
  }
}

/// The widgets beside one another, from left to right, as `addAll` adds them.
inline QHBoxLayout* rowOf(std::initializer_list<QWidget*> widgets, const QWidget* wide = nullptr) {
  auto* row = new QHBoxLayout;
  addAll(*row, widgets, wide);
  return row;
}

/// A widget with these below one another, as `addAll` adds them.
inline QWidget* columnOf(std::initializer_list<QWidget*> widgets, const QWidget* wide = nullptr) {
  auto* column = new QWidget;
  addAll(*new QVBoxLayout(column), widgets, wide);
  return column;
}

/// Gives a dialog this size, or the size of the screen without its panels and a title bar if that is smaller.
inline void resizeOnScreen(QWidget& dialog, const QSize& wanted) {
  constexpr int kTitleBar = 40;  // [px]
  dialog.resize(wanted.boundedTo(dialog.screen()->availableGeometry().size() - QSize(0, kTitleBar)));
}

}  // namespace reachlab::gui::widgets
