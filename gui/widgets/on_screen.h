#pragma once
#include <QScreen>
#include <QWidget>

namespace reachlab::gui::widgets {

/// Gives a dialog this size, or the size of the screen without its panels and a title bar if that is smaller.
inline void resizeOnScreen(QWidget& dialog, const QSize& wanted) {
  constexpr int kTitleBar = 40;  // [px]
  dialog.resize(wanted.boundedTo(dialog.screen()->availableGeometry().size() - QSize(0, kTitleBar)));
}

}  // namespace reachlab::gui::widgets
