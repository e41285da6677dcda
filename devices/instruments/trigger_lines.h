#pragma once
#include <array>
#include <cstddef>
#include <memory>

#include "devices/instruments/instrument.h"

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

/// A line as it is asked for.
struct TriggerLine {
  std::string name, path;                                // in messages; the device
  std::array<int, kMarkNames.size()> codes{1, 2, 4, 8};  // that go out, by mark; 0: no code
  double pulse = 0.005;                                  // [s] how long a line stays up
  int baud = 115200;                                     // of a byte line
  int codeOf(Mark mark) const { return codes[static_cast<std::size_t>(mark)]; }
};

/// Parallel port by ppdev. It puts the code on the eight data lines for the length of a pulse, then 0. A change of the status lines is
/// noted. Throws ResourceError.
std::unique_ptr<Instrument> openParallelPort(const TriggerLine& line, const PortCalls& calls = systemPortCalls());
/// The control lines of a serial port. RTS goes up for the length of a pulse at every mark whose code is not 0. Changes of CTS and DSR are
/// noted.
std::unique_ptr<Instrument> openSerialLines(const TriggerLine& line, const PortCalls& calls = systemPortCalls());
/// A byte on a serial line (an Arduino, a trigger box). The code is sent as one byte, and every byte that comes in is noted.
std::unique_ptr<Instrument> openByteLine(const TriggerLine& line, const PortCalls& calls = systemPortCalls());

}  // namespace reachlab::devices
