#include "base/system/hold_alone.h"

#include <sys/file.h>

#include <cerrno>

#include "base/error.h"

namespace reachlab::os {

bool lock(int descriptor, int how) {
  while (::flock(descriptor, how) != 0)
    if (errno != EINTR) return false;
  return true;
}

void holdAlone(int descriptor, const std::string& path) {
  if (!lock(descriptor, LOCK_EX | LOCK_NB) && errno == EWOULDBLOCK)
    throw ResourceError(path + ": is already in use, by another hand or another program of Reachlab; end that one first");
}

}  // namespace reachlab::os
