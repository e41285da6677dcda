#pragma once
#include <linux/input.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "devices/io/rate_hand.h"

/// Keyboards, gamepads and tablets as the kernel shows them (/dev/input/event*, linux/input.h): hands for people without a force device.
namespace reachlab::devices {

enum class InputKind : std::uint8_t { Keyboard, Gamepad, Tablet };

/// Range of one axis.
struct InputAxis {
  std::int32_t least = 0, most = 0;
  bool there() const noexcept { return most > least; }
  /// -1 … 1 about its middle.
  double share(std::int32_t value) const noexcept;
};

struct InputNode {
  std::string path, name;  // "/dev/input/event3", as the kernel names it
  InputKind kind = InputKind::Keyboard;
  std::array<InputAxis, ABS_CNT> axes{};
  std::string whyNot;  // it cannot be opened; empty: it can
};

/// What is there of that kind, in the order of their numbers. A node that may not be read is listed where the system tells its kind.
std::vector<InputNode> findInputNodes(InputKind kind, const std::string& folder = "/dev/input");

/// Keeps the state that events tell of. One thread.
class InputState {
 public:
  explicit InputState(const InputNode& node) : node_(node) {}
  /// True at the end of a report (SYN_REPORT).
  bool take(const input_event& event) noexcept;
  /// Keyboard: arrows are x and y, page up and down z (towards the user is down). Gamepad: left stick x and y, right stick's y is z.
  Deflection deflection() const noexcept;
  /// Tablet: the pen's place as shares of the tablet about its middle, x to the right, y up; false while the pen is away.
  bool pen(double& x, double& y) const noexcept;
  std::uint32_t buttons() const noexcept { return buttons_; }

 private:
  void key(std::uint16_t code, bool down) noexcept;

  InputNode node_;
  std::array<std::int32_t, ABS_CNT> values_{};
  std::array<bool, ABS_CNT> told_{};
  std::array<bool, 6> held_{};  // right, left, up, down, away, towards
  std::uint32_t buttons_ = 0;
  bool near_ = false;
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
