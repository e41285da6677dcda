#pragma once

namespace reachlab {

/// Freed memory stays with the program, up to 128 MiB, for later allocations. The matrices of successive predictions have similar sizes. If
/// memory is returned to the system, each 4 KiB costs a page fault when it is needed again: an analysis of 1,200 trials took a fifth
/// longer. Call it once, first in main, before other threads.
void keepFreedMemory() noexcept;

}  // namespace reachlab
