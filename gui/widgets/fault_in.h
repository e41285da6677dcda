#pragma once
#include <QString>

#include "base/system/error_report.h"

namespace reachlab::gui::widgets {

/// Does the work. The sentence of what went wrong, or empty.
template <typename Work>
QString faultIn(Work work) {
  try {
    work();
    return {};
  } catch (const std::exception& e) {
    return QString::fromStdString(errorReportOf(e).sentence);
  }
}

}  // namespace reachlab::gui::widgets
