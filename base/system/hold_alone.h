#pragma once
#include <string>

namespace reachlab::os {

/// Holds an open device for its descriptor alone, until that is closed: two hands or two programs would tell one device two forces. Throws
/// ResourceError, with `path`, where another descriptor of Reachlab's holds it. Other programs are not kept away.
void holdAlone(int descriptor, const std::string& path);

}  // namespace reachlab::os
