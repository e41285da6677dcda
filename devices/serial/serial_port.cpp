#include "devices/serial/serial_port.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/serial.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <new>

#include "base/error.h"
#include "base/system/descriptor.h"
#include "base/system/hold_alone.h"
#include "base/system/os.h"

namespace reachlab::devices {
namespace {

class SerialPort final : public MessageLink {
 public:
  explicit SerialPort(const std::string& path) : file_(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
    if (file_ < 0) refuse(path, "", errno == EACCES ? "; install packaging/udev/70-reachlab.rules and plug it in again" : "");
    os::holdAlone(file_, path);
    termios line{};
    if (::tcgetattr(file_, &line) != 0) refuse(path, "is no serial line: ");
    ::cfmakeraw(&line);
    ::cfsetspeed(&line, B115200);
    line.c_cflag |= CLOCAL | CREAD;
    if (::tcsetattr(file_, TCSANOW, &line) != 0) refuse(path, "cannot be set to 115200 baud, raw: ");
    ::tcflush(file_, TCIOFLUSH);
    serial_struct driver{};  // some drivers gather bytes for 16 ms unless told otherwise; one that does not know the wish needs none
    if (::ioctl(file_, TIOCGSERIAL, &driver) == 0) {
      driver.flags |= ASYNC_LOW_LATENCY;
      (void)::ioctl(file_, TIOCSSERIAL, &driver);
    }
  }

  bool send(std::string_view line) noexcept override {
    constexpr int kPatienceMs = 20;
    while (!line.empty()) {
      const ssize_t sent = ::write(file_, line.data(), line.size());
      if (sent > 0) {
        line.remove_prefix(static_cast<std::size_t>(sent));
        continue;
      }
      pollfd at{file_, POLLOUT, 0};
      if (sent < 0 && errno != EAGAIN && errno != EINTR) return lose(errno);
      const int ready = ::poll(&at, 1, kPatienceMs);
      if (ready <= 0) return lose(ready < 0 ? errno : ETIMEDOUT);
      if ((at.revents & (POLLERR | POLLHUP)) != 0) return lose(EIO);
    }
    return true;
  }

  Got receive(std::string& line, int milliseconds) noexcept override try {
    constexpr std::int64_t kNsPerMs = 1'000'000;
    const std::int64_t end = os::now() + (milliseconds + 2) * kNsPerMs;  // also of a line that never ends
    for (bool waited = false;; waited = true) {
      const std::string_view waiting(waiting_.data(), count_);
      if (const std::size_t feed = waiting.find('\n'); feed != std::string_view::npos) {
        line.assign(waiting, 0, feed);
        count_ -= feed + 1;
        std::memmove(waiting_.data(), waiting_.data() + feed + 1, count_);
        return Got::Message;
      }
      if (count_ > kLongestLine) count_ = 0;
      if (waited && os::now() > end) return Got::Nothing;
      pollfd at{file_, POLLIN, 0};
      const int ready = ::poll(&at, 1, waited ? 1 : milliseconds);
      if (ready < 0 && errno != EINTR) return gone(errno);
      if (ready <= 0) return Got::Nothing;
      const ssize_t got = ::read(file_, waiting_.data() + count_, kLongestLine);
      if (got > 0) count_ += static_cast<std::size_t>(got);
      else if (got == 0 || (errno != EAGAIN && errno != EINTR)) return gone(got == 0 ? EIO : errno);
    }
  } catch (const std::bad_alloc&) {  // `line` has no room, and there is none
    return gone(ENOMEM);
  }

  std::string fault() const override { return std::strerror(fault_); }

 private:
  [[noreturn]] void refuse(const std::string& path, const char* what, const char* remedy = "") const {
    const int error = errno;
    throw ResourceError(fmt::format("{}: {}{}{}", path, what, std::strerror(error), remedy));
  }
  bool lose(int error) noexcept {
    fault_ = error;
    return false;
  }
  Got gone(int error) noexcept {
    fault_ = error;
    return Got::Gone;
  }

  os::Descriptor file_;
  int fault_ = 0;
  std::array<char, 2 * kLongestLine> waiting_{};
  std::size_t count_ = 0;  // of the bytes that wait
};

}  // namespace

std::unique_ptr<MessageLink> openSerial(const std::string& path) { return std::make_unique<SerialPort>(path); }

}  // namespace reachlab::devices
