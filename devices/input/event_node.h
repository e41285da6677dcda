#pragma once
#include <linux/input.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/math/vec3.h"

/// Tablets as the kernel lists them (/dev/input/event*, linux/input.h).
namespace reachlab::devices {

/// The range of one axis.
struct InputAxis {
  std::int32_t least = 0, most = 0;
  std::int32_t perMm = 0;  // units per millimetre; 0: the kernel does not tell
  bool there() const noexcept { return most > least; }
  double half() const noexcept { return (static_cast<double>(most) - least) / 2; }
  /// [units] from its middle, within its range.
  double fromMiddle(std::int32_t value) const noexcept;
};

struct TabletNode {
  std::string path, name;  // "/dev/input/event3", as the kernel names it
  InputAxis x, y;
  std::string whyNot;  // the reason why the node cannot be opened, empty if it can
};

/// The tablets of the folder in the order of their numbers. A node that cannot be opened is listed too, because its kind is unknown.
std::vector<TabletNode> findTablets(const std::string& folder);
/// The tablets of this computer, those of /dev/input. Another list may take its place before a device is opened.
extern std::vector<TabletNode> (*listTablets)();

/// Keeps the state of the pen that the events report. One thread.
class PenState {
 public:
  explicit PenState(const TabletNode& node) : rangeX_(node.x), rangeY_(node.y) {}
  /// True at the end of a report (SYN_REPORT).
  bool take(const input_event& event) noexcept;
  /// The position on the tablet from its middle, in halves of its width, x to the right, y up. The same way of the pen counts as much on
  /// either axis: a millimetre where the kernel tells both resolutions, otherwise a unit. Nothing while the pen is away.
  std::optional<Vec3> position() const noexcept;
  /// Bit 0: the pen touches the tablet.
  std::uint32_t buttons() const noexcept { return touching_ ? 1 : 0; }

 private:
  InputAxis rangeX_, rangeY_;
  std::optional<std::int32_t> x_, y_;  // as the events told
  bool near_ = false, touching_ = false;
};

/// An open node. Its events have times of the monotonic clock. One thread at a time.
class InputPort {
 public:
  /// Throws ResourceError with the system's message.
  explicit InputPort(const std::string& path);
  ~InputPort();
  InputPort(const InputPort&) = delete;
  InputPort& operator=(const InputPort&) = delete;
  /// The number of events that were read, waiting at most this long for the first event. -1: the node is gone.
  int read(std::span<input_event> events, int milliseconds) noexcept;

 private:
  int file_;
};

}  // namespace reachlab::devices
