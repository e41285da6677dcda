#pragma once
#include <cstddef>
#include <cstdint>

namespace reachlab::devices {

/// The calls of the operating system that drive ports, with their errno. This is the lowest level at which a test can replace a port.
struct PortCalls {
  int (*open)(const char* path, int flags);
  int (*close)(int file);
  int (*control)(int file, unsigned long request, void* argument);
  long (*write)(int file, const void* bytes, std::size_t count);
  long (*read)(int file, void* bytes, std::size_t count);
};
const PortCalls& systemPortCalls();

}  // namespace reachlab::devices
