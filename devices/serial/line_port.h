#pragma once
#include <memory>
#include <string>
#include <string_view>

namespace reachlab::devices {

/// A serial line that carries text lines. One thread at a time.
class LinePort {
 public:
  virtual ~LinePort() = default;
  /// False: it is gone, or takes nothing any more.
  virtual bool send(std::string_view line) noexcept = 0;
  enum class Got { Line, Nothing, Gone };
  /// The next whole line without its end, waiting at most this long. What is longer than kLongestLine without an end is thrown away.
  virtual Got receive(std::string& line, int milliseconds) noexcept = 0;
  static constexpr std::size_t kLongestLine = 256;
};

/// A terminal device, raw, 115200 baud. Throws ResourceError in the system's words.
std::unique_ptr<LinePort> openSerial(const std::string& path);

}  // namespace reachlab::devices
