#pragma once
#include <QApplication>

namespace reachlab::gui::widgets {

/// The pointer says that something takes its time, as long as this lives.
class WaitCursor {
 public:
  WaitCursor() { QApplication::setOverrideCursor(Qt::WaitCursor); }
  ~WaitCursor() { QApplication::restoreOverrideCursor(); }
  WaitCursor(const WaitCursor&) = delete;
  WaitCursor& operator=(const WaitCursor&) = delete;
};

}  // namespace reachlab::gui::widgets
