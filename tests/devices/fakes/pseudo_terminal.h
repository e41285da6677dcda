#pragma once
#include <pty.h>
#include <unistd.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace reachlab::test {

/// A serial line without a device: the test has the wire at one end, and `path` names the other.
struct PseudoTerminal {
  PseudoTerminal() {
    char name[128] = {};
    if (::openpty(&wire, &slave, name, nullptr, nullptr) != 0) throw std::runtime_error("openpty");
    path = name;
  }
  ~PseudoTerminal() {
    ::close(slave);
    cut();
  }
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;
  /// The test's end is gone.
  void cut() {
    if (wire >= 0) ::close(std::exchange(wire, -1));
  }
  int wire = -1, slave = -1;
  std::string path;
};

}  // namespace reachlab::test
