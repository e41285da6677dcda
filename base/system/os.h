#pragma once
#include <cstdint>
#include <string>

/// The operating system, as far as this program needs more of it than the standard library gives. One implementation a system.
namespace reachlab::os {

/// Monotonic clock [ns]. It never runs backwards, not even when the time of day changes. Any thread. Never waits.
std::int64_t now() noexcept;
/// Sleeps until the monotonic clock shows `deadline` [ns]. Returns at once if it is past. Calling thread only.
void sleepUntil(std::int64_t deadline) noexcept;

/// Asks for real-time priority (SCHED_FIFO, 1 … 99) of the calling thread. Returns an empty text when granted, else the reason.
std::string requestRealTime(int priority);
/// The calling thread's sleeps end as near to their deadline as the system can.
void requestExactSleep() noexcept;
/// Keeps the program's present and future memory in RAM, so that the haptic thread meets no page fault. Empty when granted, else the
/// reason.
std::string lockMemory();

/// True if every byte was written. The reason is in errno otherwise.
bool writeAll(int descriptor, const void* data, std::size_t size) noexcept;
/// Once this returns, the data written to an open file, or the names in a folder, survive a power cut. False with errno set.
bool syncFile(int descriptor) noexcept;
bool syncFolder(const std::string& folder) noexcept;
/// Bytes free to this user, and the total, on the disk that holds `path`. 0 if unknown.
struct DiskSpace {
  std::uint64_t free = 0, size = 0;
};
DiskSpace diskSpace(const std::string& path) noexcept;

/// Opens closed descriptors among 0, 1 and 2 on /dev/null. Otherwise a file that is opened later could become one of them and receive text
/// that is meant for the terminal. Call it first in main.
void holdStandardDescriptors() noexcept;
/// `descriptor`, or a copy of it above 2 if it is 0, 1 or 2. It is -1 with errno set if no copy can be made.
int aboveStandardDescriptors(int descriptor) noexcept;

/// Freed memory stays with the program, up to 128 MiB, for later allocations. The matrices of successive predictions have similar sizes. If
/// memory is returned to the system, each 4 KiB costs a page fault when it is needed again: an analysis of 1,200 trials took a fifth
/// longer. Call it once, first in main, before other threads.
void keepFreedMemory() noexcept;
/// Processor time of the calling thread [ns].
std::int64_t threadProcessorTime() noexcept;

}  // namespace reachlab::os
