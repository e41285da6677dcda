#include "sim/record/log/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "base/fault.h"

namespace reachlab::record {

std::string readWholeFile(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // opening a pipe would wait for its writer
  if (descriptor < 0) throw ResourceError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  struct stat status {};
  const bool known = ::fstat(descriptor, &status) == 0;
  if (!known || !S_ISREG(status.st_mode) || status.st_size > kMaxBytesOfAFile) {
    ::close(descriptor);
    if (known && S_ISREG(status.st_mode))
      throw FaultError(Fault{{}, fmt::format("has {} bytes", status.st_size), fmt::format("up to {}", kMaxBytesOfAFile), FilePlace{path}});
    throw ResourceError(path + ": is no regular file; allowed: a file on a disk");
  }
  std::string text(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t done = 0;
  ssize_t count = 1;
  while (done < text.size() && count > 0) {
    count = ::read(descriptor, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) count = 1;
    else if (count > 0) done += static_cast<std::size_t>(count);
  }
  const int fault = errno;
  ::close(descriptor);
  if (count < 0) throw ResourceError(fmt::format("{}: cannot be read: {}", path, std::strerror(fault)));
  text.resize(done);
  return text;
}

}  // namespace reachlab::record
