#pragma once
#include <linux/input.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// Tablets as the kernel shows them (/dev/input/event*, linux/input.h).
namespace reachlab::devices {

/// Range of one axis.
struct InputAxis {
  std::int32_t least = 0, most = 0;
  bool there() const noexcept { return most > least; }
  /// -1 … 1 about its middle.
  double share(std::int32_t value) const noexcept;
};

struct TabletNode {
  std::string path, name;  // "/dev/input/event3", as the kernel names it
  InputAxis x, y;
  std::string whyNot;  // the reason why the node cannot be opened, empty if it can
};

/// The tablets of the folder in the order of their numbers. A node that cannot be opened is listed too, since its kind is not known.
std::vector<TabletNode> findTablets(const std::string& folder = "/dev/input");

/// Keeps the state of the pen that events tell of. One thread.
class PenState {
 public:
  explicit PenState(const TabletNode& node) : x_(node.x), y_(node.y) {}
  /// True at the end of a report (SYN_REPORT).
  bool take(const input_event& event) noexcept;
  /// Position as shares of the tablet about its middle, x to the right, y up. False while the pen is away.
  bool position(double& x, double& y) const noexcept;
  /// Bit 0: the pen touches the tablet.
  std::uint32_t buttons() const noexcept { return touching_ ? 1 : 0; }

 private:
  struct Axis {
    explicit Axis(const InputAxis& r) : range(r) {}
    double share() const noexcept { return range.share(value); }
    InputAxis range;
    std::int32_t value = 0;
    bool told = false;
  };
  Axis x_, y_;
  bool near_ = false, touching_ = false;
};

/// An open node: events with the monotonic clock's times. One thread at a time.
class InputPort {
 public:
  /// Throws ResourceError in the system's words.
  explicit InputPort(const std::string& path);
  /// Takes over a descriptor that gives `input_event`s.
  explicit InputPort(int file) : file_(file) {}
  ~InputPort();
  InputPort(const InputPort&) = delete;
  InputPort& operator=(const InputPort&) = delete;
  /// Events read, waiting at most this long for the first; -1: it is gone.
  int read(std::span<input_event> events, int milliseconds) noexcept;

 private:
  int file_;
};

}  // namespace reachlab::devices
