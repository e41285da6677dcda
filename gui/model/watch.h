#pragma once
#include <functional>

namespace reachlab::gui::model {

/// Told now and then how much is done [0, 1], NaN where nobody knows; it throws to give up.
using Watch = std::function<void(double share)>;

}  // namespace reachlab::gui::model
