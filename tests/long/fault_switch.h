// Put before every file that seeded_faults.py has written faults into: which of them is in force is read from the environment when a program
// starts (REACHLAB_FAULT), and each one that a program comes by is marked in a file that the programs it starts share (REACHLAB_FAULTS_SEEN).
#pragma once
#define _GLIBCXX_ASSERTIONS 1  // an index beyond the end is noticed, as in the sanitizers' build
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdlib>
#include <type_traits>
#pragma GCC diagnostic ignored "-Wnarrowing"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wfloat-conversion"
#pragma GCC diagnostic ignored "-Wparentheses"

namespace seeded_faults {
inline constexpr int kMost = 16384;
inline unsigned char unmarked[kMost];
inline constinit unsigned char* seen = unmarked;  // a byte a fault; the file's pages outlive a kill
inline constinit int inForce = 0;
inline constinit bool isReady = false;

/// Before any static initialiser. System calls as such: tests count and fail the library's.
__attribute__((constructor(101))) static void ready() {
  if (isReady) return;
  isReady = true;
  if (const char* number = std::getenv("REACHLAB_FAULT")) inForce = std::atoi(number);
  if (const char* file = std::getenv("REACHLAB_FAULTS_SEEN")) {
    const long descriptor = ::syscall(SYS_openat, AT_FDCWD, file, O_RDWR | O_CLOEXEC);
    if (descriptor < 0) return;
    const long place = ::syscall(SYS_mmap, nullptr, kMost, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    if (place > 0) seen = reinterpret_cast<unsigned char*>(place);
    ::syscall(SYS_close, descriptor);
  }
}
}  // namespace seeded_faults

inline bool seededFault(int number) noexcept {
  if (seeded_faults::seen[number] == 0) seeded_faults::seen[number] = 1;
  return seeded_faults::inForce == number;
}

/// Where both forms may be computed: marked only where they differ.
template <class T>
T seededFault(int number, T right, std::type_identity_t<T> wrong) {
  if constexpr (std::is_arithmetic_v<T>) {
    if (right == wrong || (right != right && wrong != wrong)) return right;
  }
  return seededFault(number) ? wrong : right;
}
