#include "base/system/hold_alone.h"

#include <sys/file.h>

#include <cerrno>

#include "base/error.h"

namespace reachlab::os {

void holdAlone(int descriptor, const std::string& path) {
  int held = 0;
  do held = ::flock(descriptor, LOCK_EX | LOCK_NB);
  while (held != 0 && errno == EINTR);
  if (held != 0 && errno == EWOULDBLOCK)
    throw ResourceError(path + ": is already in use, by another hand or another program of Reachlab; end that one first");
}

}  // namespace reachlab::os
