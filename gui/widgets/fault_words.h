#pragma once
#include <QStringList>
#include <vector>

#include "base/fault.h"

namespace reachlab::gui::widgets {

/// A fault in the window's words: its fields are called by what they hold, "mass 2" and not "object.masses_kg[1]".
QString inWords(const Fault& fault);
QStringList inWords(const std::vector<Fault>& faults);

}  // namespace reachlab::gui::widgets
