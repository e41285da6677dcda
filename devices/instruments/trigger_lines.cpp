#include "devices/instruments/trigger_lines.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/ppdev.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>

#include "base/error.h"
#include "base/fault.h"
#include "base/system/os.h"

namespace reachlab::devices {
namespace {

class Port {
 public:
  Port(std::string path, const PortCalls& calls, int flags) : path_(std::move(path)), calls_(calls) {
    file_ = calls_.open(path_.c_str(), flags | O_CLOEXEC);
    if (file_ < 0) fail(errno == EACCES ? "; become a member of the group that owns it (ls -l shows it)" : "");
  }
  ~Port() {
    if (file_ >= 0) calls_.close(file_);
  }
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  /// False where the port does not know the request; errno tells why.
  bool tryControl(unsigned long request, void* argument) const { return calls_.control(file_, request, argument) >= 0; }
  void control(unsigned long request, void* argument) const {
    while (!tryControl(request, argument))
      if (errno != EINTR) fail();
  }
  void write(unsigned char byte) const {
    while (calls_.write(file_, &byte, 1) != 1)
      if (errno != EINTR) fail();
  }
  /// Bytes that are there; none is no fault.
  std::size_t read(std::span<unsigned char> bytes) const {
    const long got = calls_.read(file_, bytes.data(), bytes.size());
    if (got > 0) return static_cast<std::size_t>(got);
    if (got == 0 || errno == EAGAIN || errno == EINTR) return 0;
    fail();
  }
  [[noreturn]] void fail(const std::string& remedy = "") const {
    throw ResourceError(fmt::format("{}: {}{}", path_, std::strerror(errno), remedy));
  }

 private:
  std::string path_;
  const PortCalls& calls_;
  int file_ = -1;
};

/// A line that is up for a while after a mark.
class PulsedLine : public Instrument {
 public:
  bool send(const Marker& marker) override {
    const int code = line_.codeOf(marker.mark);
    if (code == 0) return false;
    put(code);
    downAt_ = os::now() + std::llround(line_.pulse * 1e9);
    return true;
  }
  void look(std::int64_t now, std::vector<InstrumentNote>& notes) override {
    if (downAt_ != 0 && now >= downAt_) {
      put(0);
      downAt_ = 0;
    }
    const unsigned status = inputs();
    if (known_ && status != status_) notes.push_back({now, "in", static_cast<double>(status)});
    status_ = status;
    known_ = true;
  }
  void end(std::vector<InstrumentNote>&) override {
    if (std::exchange(downAt_, 0) != 0) put(0);
  }

 protected:
  explicit PulsedLine(const TriggerLine& line) : Instrument(line.name), line_(line) {}
  virtual void put(int code) = 0;
  virtual unsigned inputs() = 0;  // a bit a line

 private:
  TriggerLine line_;
  std::int64_t downAt_ = 0;  // 0: no pulse is up
  unsigned status_ = 0;
  bool known_ = false;
};

class ParallelPort final : public PulsedLine {
 public:
  ParallelPort(const TriggerLine& line, const PortCalls& calls) : PulsedLine(line), port_(line.path, calls, O_RDWR) {
    port_.control(PPCLAIM, nullptr);
    put(0);
  }
  ~ParallelPort() override { (void)port_.tryControl(PPRELEASE, nullptr); }

 private:
  void put(int code) override {
    auto byte = static_cast<unsigned char>(code);
    port_.control(PPWDATA, &byte);
  }
  unsigned inputs() override {
    unsigned char byte = 0;
    port_.control(PPRSTATUS, &byte);
    return byte;
  }
  Port port_;
};

class SerialLines final : public PulsedLine {
 public:
  SerialLines(const TriggerLine& line, const PortCalls& calls) : PulsedLine(line), port_(line.path, calls, O_RDWR | O_NOCTTY | O_NONBLOCK) {
    put(0);
  }

 private:
  void put(int code) override {
    int line = TIOCM_RTS;
    port_.control(code != 0 ? TIOCMBIS : TIOCMBIC, &line);
  }
  unsigned inputs() override {
    int lines = 0;
    port_.control(TIOCMGET, &lines);
    return ((lines & TIOCM_CTS) != 0 ? 1u : 0u) | ((lines & TIOCM_DSR) != 0 ? 2u : 0u);
  }
  Port port_;
};

speed_t speedOf(int baud) {
  constexpr std::pair<int, speed_t> kSpeeds[]{{9600, B9600},     {19200, B19200},   {38400, B38400},    {57600, B57600},
                                              {115200, B115200}, {230400, B230400}, {1000000, B1000000}};
  for (const auto& [known, speed] : kSpeeds)
    if (known == baud) return speed;
  throw FaultError(Fault{"instrument", fmt::format("baud={}", baud), "9600, 19200, 38400, 57600, 115200, 230400, 1000000"});
}

class ByteLine final : public Instrument {
 public:
  ByteLine(const TriggerLine& line, const PortCalls& calls)
      : Instrument(line.name), line_(line), port_(line.path, calls, O_RDWR | O_NOCTTY | O_NONBLOCK) {
    termios settings{};  // the kernel's begins the same, and is shorter
    port_.control(TCGETS, &settings);
    ::cfmakeraw(&settings);
    ::cfsetspeed(&settings, speedOf(line.baud));
    settings.c_cflag |= CLOCAL | CREAD;
    port_.control(TCSETS, &settings);
  }

  bool send(const Marker& marker) override {
    const int code = line_.codeOf(marker.mark);
    if (code == 0) return false;
    port_.write(static_cast<unsigned char>(code));
    return true;
  }
  void look(std::int64_t now, std::vector<InstrumentNote>& notes) override {
    std::array<unsigned char, 64> bytes;
    for (std::size_t i = 0, count = port_.read(bytes); i < count; ++i) notes.push_back({now, "in", static_cast<double>(bytes[i])});
  }

 private:
  TriggerLine line_;
  Port port_;
};

}  // namespace

const PortCalls& systemPortCalls() {
  static const PortCalls calls{
      [](const char* path, int flags) { return ::open(path, flags); },
      [](int file) { return ::close(file); },
      [](int file, unsigned long request, void* argument) { return ::ioctl(file, request, argument); },
      [](int file, const void* bytes, std::size_t count) { return static_cast<long>(::write(file, bytes, count)); },
      [](int file, void* bytes, std::size_t count) { return static_cast<long>(::read(file, bytes, count)); },
  };
  return calls;
}

std::unique_ptr<Instrument> openParallelPort(const TriggerLine& line, const PortCalls& calls) {
  return std::make_unique<ParallelPort>(line, calls);
}
std::unique_ptr<Instrument> openSerialLines(const TriggerLine& line, const PortCalls& calls) {
  return std::make_unique<SerialLines>(line, calls);
}
std::unique_ptr<Instrument> openByteLine(const TriggerLine& line, const PortCalls& calls) {
  return std::make_unique<ByteLine>(line, calls);
}

}  // namespace reachlab::devices
