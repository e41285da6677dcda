#pragma once
#include <cstdint>
#include <string>

/// The operating system, as far as this program needs more of it than the standard library gives. One implementation a system.
namespace reachlab::os {

/// Monotonic clock [ns]; never goes back, not even over a change of the time of day. Any thread; never waits.
std::int64_t now() noexcept;
/// Sleeps until the monotonic clock shows `deadline` [ns]; returns at once when it is past. Calling thread only.
void sleepUntil(std::int64_t deadline) noexcept;

/// Asks for real-time priority (SCHED_FIFO, 1 … 99) of the calling thread; empty when granted, else why not, in words.
std::string requestRealTime(int priority);
/// The calling thread's sleeps end as near to their deadline as the system can.
void requestExactSleep() noexcept;
/// Keeps the program's present and future memory in RAM, so that the haptic thread meets no page fault; empty when granted, else why not.
std::string lockMemory();

/// What was written to an open file, or to the names in a folder, survives a power cut once this returns. False with errno set.
bool syncFile(int descriptor) noexcept;
bool syncFolder(const std::string& folder) noexcept;
/// Bytes free to this user, and in all, on the disk where `path` lies; 0 when that cannot be known.
struct DiskSpace {
  std::uint64_t free = 0, size = 0;
};
DiskSpace diskSpace(const std::string& path) noexcept;

/// Opens those of the descriptors 0, 1 and 2 that are closed on /dev/null, so that no file that is opened later becomes one of them and takes
/// what is meant for the terminal. First of all in main.
void holdStandardDescriptors() noexcept;
/// `descriptor`, or a copy of it above 2 if it is one of those three; -1 with errno set when there is none.
int aboveStandardDescriptors(int descriptor) noexcept;

/// Processor time of the calling thread [ns].
std::int64_t threadProcessorTime() noexcept;

}  // namespace reachlab::os
