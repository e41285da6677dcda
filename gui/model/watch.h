#pragma once
#include <functional>

namespace reachlab::gui::model {

/// Called now and then with the finished share [0, 1], or NaN if it is not known. It throws to stop the work.
using Watch = std::function<void(double share)>;

}  // namespace reachlab::gui::model
