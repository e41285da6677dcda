#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/statvfs.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/system/os.h"
#include "base/system/descriptor.h"

namespace reachlab::os {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

std::int64_t read(clockid_t clock) noexcept {
  timespec t{};
  ::clock_gettime(clock, &t);
  return t.tv_sec * kNsPerSecond + t.tv_nsec;
}

}  // namespace

// No canary: every tick looks at the clock, and only the C library writes here (docs/adr/0027-canaries-off-the-tick.md).
__attribute__((no_stack_protector)) std::int64_t now() noexcept { return read(CLOCK_MONOTONIC); }

std::int64_t threadProcessorTime() noexcept { return read(CLOCK_THREAD_CPUTIME_ID); }

void sleepUntil(std::int64_t deadline) noexcept {
  const timespec t{deadline / kNsPerSecond, deadline % kNsPerSecond};
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {}
}

std::string requestRealTime(int priority) {
  const sched_param parameters{priority};
  const int error = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters);
  return error == 0 ? std::string() : fmt::format("no real-time priority ({})", std::strerror(error));
}

void requestExactSleep() noexcept { ::prctl(PR_SET_TIMERSLACK, 1UL); }

std::string lockMemory() {
  return ::mlockall(MCL_CURRENT | MCL_FUTURE) == 0 ? std::string() : fmt::format("memory not locked ({})", std::strerror(errno));
}

bool writeAll(int descriptor, const void* data, std::size_t size) noexcept {
  for (const char* at = static_cast<const char*>(data); size > 0;) {
    const ssize_t written = ::write(descriptor, at, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    at += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

bool syncFile(int descriptor) noexcept { return ::fdatasync(descriptor) == 0; }

bool syncFolder(const std::string& folder) noexcept {
  const Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return opened >= 0 && ::fsync(opened) == 0;
}

void holdStandardDescriptors() noexcept {
  for (int descriptor = 0; descriptor <= STDERR_FILENO; ++descriptor)
    if (::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF) (void)!::open("/dev/null", O_RDWR);  // takes the lowest that is free
}

int aboveStandardDescriptors(int descriptor) noexcept {
  if (descriptor < 0 || descriptor > STDERR_FILENO) return descriptor;
  const int copy = ::fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  const int fault = errno;
  ::close(descriptor);
  errno = fault;
  return copy;
}

void keepFreedMemory() noexcept {
  // Both: a threshold of one's own ends glibc's moving of the other, and large blocks would be mapped and unmapped each time.
  mallopt(M_MMAP_THRESHOLD, 64 << 20);
  mallopt(M_TRIM_THRESHOLD, 128 << 20);
}

DiskSpace diskSpace(const std::string& path) noexcept {
  struct statvfs disk {};
  if (::statvfs(path.c_str(), &disk) != 0) return {};
  return {static_cast<std::uint64_t>(disk.f_bavail) * disk.f_frsize, static_cast<std::uint64_t>(disk.f_blocks) * disk.f_frsize};
}

}  // namespace reachlab::os
