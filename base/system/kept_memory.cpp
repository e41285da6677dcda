#include "base/system/kept_memory.h"

#include <malloc.h>

namespace reachlab {

void keepFreedMemory() noexcept {
  // Both: a threshold of one's own ends glibc's moving of the other, and large blocks would be mapped and unmapped each time.
  mallopt(M_MMAP_THRESHOLD, 64 << 20);
  mallopt(M_TRIM_THRESHOLD, 128 << 20);
}

}  // namespace reachlab
