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

bool isTablet(int file) {
  const Bits keys(file, EV_KEY, KEY_CNT), axes(file, EV_ABS, ABS_CNT);
  return axes.has(ABS_X) && axes.has(ABS_Y) && keys.has(BTN_TOOL_PEN);
}

InputAxis axisOf(int file, std::size_t axis) {
  input_absinfo info{};
  return ::ioctl(file, EVIOCGABS(axis), &info) >= 0 ? InputAxis{info.minimum, info.maximum, info.resolution} : InputAxis{};
}

std::string refusal(const std::string& path, int error) {
  return fmt::format("{}: {}{}", path, std::strerror(error), error == EACCES ? "; the group `input` may read it" : "");
}

int numberOf(const std::string& path) {
  const std::size_t at = path.find_last_not_of("0123456789");
  return at + 1 < path.size() ? std::atoi(path.c_str() + at + 1) : 0;
}

}  // namespace

double InputAxis::fromMiddle(std::int32_t value) const noexcept {
  const double middle = (static_cast<double>(least) + most) / 2;
  return there() ? std::clamp(value - middle, -half(), half()) : 0;
}

std::vector<TabletNode> findTablets(const std::string& folder) {
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().filename().string().starts_with("event")) paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end(), [](const std::string& a, const std::string& b) { return numberOf(a) < numberOf(b); });
  std::vector<TabletNode> found;
  for (const std::string& path : paths) {
    const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) {
      found.push_back({.path = path, .name = {}, .x = {}, .y = {}, .whyNot = refusal(path, errno)});
      continue;
    }
    if (isTablet(file)) {
      char name[256] = {};
      (void)::ioctl(file, EVIOCGNAME(sizeof name - 1), name);
      found.push_back({.path = path, .name = name, .x = axisOf(file, ABS_X), .y = axisOf(file, ABS_Y), .whyNot = {}});
    }
    ::close(file);
  }
  return found;
}

std::vector<TabletNode> (*listTablets)() = [] { return findTablets("/dev/input"); };

bool PenState::take(const input_event& event) noexcept {
  if (event.type == EV_ABS && (event.code == ABS_X || event.code == ABS_Y)) (event.code == ABS_X ? x_ : y_) = event.value;
  if (event.type == EV_KEY && event.code == BTN_TOOL_PEN) near_ = event.value != 0;
  if (event.type == EV_KEY && event.code == BTN_TOUCH) touching_ = event.value != 0;
  return event.type == EV_SYN && event.code == SYN_REPORT;
}

std::optional<Vec3> PenState::position() const noexcept {
  if (!near_ || !x_ || !y_ || !rangeX_.there()) return std::nullopt;
  const bool told = rangeX_.perMm > 0 && rangeY_.perMm > 0;
  const double aspect = told ? static_cast<double>(rangeX_.perMm) / rangeY_.perMm : 1;
  return 1 / rangeX_.half() * Vec3{rangeX_.fromMiddle(*x_), -aspect * rangeY_.fromMiddle(*y_), 0};
}

InputPort::InputPort(const std::string& path) : file_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
  if (file_ < 0) throw ResourceError(refusal(path, errno));
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
