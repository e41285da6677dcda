#pragma once
#include <QStringList>
#include <vector>

#include "base/fault.h"

namespace reachlab::gui::widgets {

/// A fault in the window's words: "mass 2" instead of "object.masses_kg[1]".
QString inWords(const Fault& fault);
QStringList inWords(const std::vector<Fault>& faults);

}  // namespace reachlab::gui::widgets
