#pragma once
#include <string>

namespace reachlab::os {

/// flock(2) with LOCK_EX or LOCK_SH, and LOCK_NB for no wait, which a signal does not end. False: not locked, and errno says why.
bool lock(int descriptor, int how);

/// Holds an open device for its descriptor alone, until that is closed: two hands or two programs would tell one device two forces. Throws
/// ResourceError, with `path`, where another descriptor of Reachlab's holds it. Other programs are not kept away.
void holdAlone(int descriptor, const std::string& path);

}  // namespace reachlab::os
