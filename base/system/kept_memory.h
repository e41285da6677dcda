#pragma once

namespace reachlab {

/// Memory that is freed stays with the program, up to 128 MiB, for what it allocates next: the matrices of one prediction after the other are
/// of like size, and giving each back to the system costs a page fault for every 4 KiB when it is asked for again. An analysis of 1,200 trials
/// took a fifth longer so. Once, first thing in main, before other threads.
void keepFreedMemory() noexcept;

}  // namespace reachlab
