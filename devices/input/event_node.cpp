#include "devices/input/event_node.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>

#include "base/error.h"

namespace reachlab::devices {
namespace {

class Bits {
 public:
  Bits(int file, int type, std::size_t count) : bytes_(count / 8 + 1, 0) {
    (void)::ioctl(file, EVIOCGBIT(static_cast<unsigned>(type), bytes_.size()), bytes_.data());
  }
  bool has(std::size_t bit) const { return bit / 8 < bytes_.size() && (bytes_[bit / 8] >> bit % 8 & 1) != 0; }

 private:
  std::vector<std::uint8_t> bytes_;
};

bool isKind(int file, InputKind kind) {
  const Bits keys(file, EV_KEY, KEY_CNT), axes(file, EV_ABS, ABS_CNT);
  switch (kind) {
    case InputKind::Keyboard: return keys.has(KEY_LEFT) && keys.has(KEY_RIGHT) && keys.has(KEY_UP) && keys.has(KEY_DOWN) && keys.has(KEY_A);
    case InputKind::Gamepad: return axes.has(ABS_X) && axes.has(ABS_Y) && (keys.has(BTN_GAMEPAD) || keys.has(BTN_JOYSTICK));
    case InputKind::Tablet: break;
  }
  return axes.has(ABS_X) && axes.has(ABS_Y) && keys.has(BTN_TOOL_PEN);
}

int numberOf(const std::string& path) {
  const std::size_t at = path.find_last_not_of("0123456789");
  return at + 1 < path.size() ? std::atoi(path.c_str() + at + 1) : 0;
}

}  // namespace

double InputAxis::share(std::int32_t value) const noexcept {
  const double middle = (static_cast<double>(least) + most) / 2, half = (static_cast<double>(most) - least) / 2;
  return there() ? std::clamp((value - middle) / half, -1.0, 1.0) : 0;
}

std::vector<InputNode> findInputNodes(InputKind kind, const std::string& folder) {
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().filename().string().starts_with("event")) paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end(), [](const std::string& a, const std::string& b) { return numberOf(a) < numberOf(b); });
  std::vector<InputNode> found;
  for (const std::string& path : paths) {
    InputNode node;
    node.path = path;
    node.kind = kind;
    const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) {
      node.whyNot = fmt::format("{}: {}{}", path, std::strerror(errno), errno == EACCES ? "; the group `input` may read it" : "");
      found.push_back(node);  // of what kind it is cannot be seen
      continue;
    }
    if (isKind(file, kind)) {
      char name[256] = {};
      if (::ioctl(file, EVIOCGNAME(sizeof name - 1), name) > 0) node.name = name;
      for (std::size_t axis = 0; axis < node.axes.size(); ++axis) {
        input_absinfo info{};
        if (kind != InputKind::Keyboard && ::ioctl(file, EVIOCGABS(axis), &info) >= 0) node.axes[axis] = {info.minimum, info.maximum};
      }
      found.push_back(node);
    }
    ::close(file);
  }
  return found;
}

void InputState::key(std::uint16_t code, bool down) noexcept {
  constexpr std::uint16_t ways[6] = {KEY_RIGHT, KEY_LEFT, KEY_UP, KEY_DOWN, KEY_PAGEUP, KEY_PAGEDOWN};
  for (std::size_t i = 0; i < 6; ++i)
    if (ways[i] == code) held_[i] = down;
  if (code == BTN_TOOL_PEN) near_ = down;
  int bit = -1;
  if (code == KEY_SPACE || code == BTN_TOUCH) bit = 0;
  else if (code >= BTN_JOYSTICK && code < BTN_JOYSTICK + 16) bit = code - BTN_JOYSTICK;
  else if (code >= BTN_GAMEPAD && code < BTN_GAMEPAD + 15) bit = code - BTN_GAMEPAD;
  if (bit < 0) return;
  const std::uint32_t mask = 1u << bit;
  buttons_ = down ? buttons_ | mask : buttons_ & ~mask;
}

bool InputState::take(const input_event& event) noexcept {
  if (event.type == EV_ABS && event.code < ABS_CNT) {
    values_[event.code] = event.value;
    told_[event.code] = true;
  }
  if (event.type == EV_KEY) key(event.code, event.value != 0);  // 2: it repeats
  return event.type == EV_SYN && event.code == SYN_REPORT;
}

Deflection InputState::deflection() const noexcept {
  Deflection d;
  d.buttons = buttons_;
  if (node_.kind == InputKind::Keyboard) {
    d.push = {static_cast<double>(held_[0]) - held_[1], static_cast<double>(held_[2]) - held_[3], static_cast<double>(held_[5]) - held_[4]};
    return d;
  }
  const auto share = [&](std::size_t axis) { return told_[axis] ? node_.axes[axis].share(values_[axis]) : 0.0; };
  d.push = {share(ABS_X), -share(ABS_Y), share(ABS_RY)};
  return d;
}

bool InputState::pen(double& x, double& y) const noexcept {
  if (!told_[ABS_X] || !told_[ABS_Y]) return false;
  x = node_.axes[ABS_X].share(values_[ABS_X]);
  y = -node_.axes[ABS_Y].share(values_[ABS_Y]);
  return near_;
}

InputPort::InputPort(const std::string& path) : file_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
  if (file_ < 0) {
    const int error = errno;
    throw ResourceError(fmt::format("{}: {}{}", path, std::strerror(error), error == EACCES ? "; the group `input` may read it" : ""));
  }
  int clock = CLOCK_MONOTONIC;
  (void)::ioctl(file_, EVIOCSCLOCKID, &clock);
}

InputPort::~InputPort() { ::close(file_); }

int InputPort::read(std::span<input_event> events, int milliseconds) noexcept {
  pollfd at{file_, POLLIN, 0};
  const int ready = ::poll(&at, 1, milliseconds);
  if (ready == 0) return 0;
  if (ready < 0) return errno == EINTR ? 0 : -1;
  const ssize_t got = ::read(file_, events.data(), events.size_bytes());
  if (got < 0) return errno == EAGAIN || errno == EINTR ? 0 : -1;
  return got == 0 ? -1 : static_cast<int>(static_cast<std::size_t>(got) / sizeof(input_event));
}

}  // namespace reachlab::devices
