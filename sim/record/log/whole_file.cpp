#include "sim/record/log/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "base/fault.h"
#include "base/system/descriptor.h"

namespace reachlab::record {

std::string readWholeFile(const std::string& path) {
  const os::Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));  // opening a pipe would wait for its writer
  struct stat status {};
  if (file < 0 || ::fstat(file, &status) != 0) throw ResourceError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  if (!S_ISREG(status.st_mode)) throw ResourceError(path + ": is no regular file; allowed: a file on a disk");
  if (status.st_size > kMaxBytesOfAFile)
    throw FaultError(fileFault(path, fmt::format("has {} bytes", status.st_size), fmt::format("up to {}", kMaxBytesOfAFile)));
  std::string text(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t done = 0;
  ssize_t count = 1;
  while (done < text.size() && count > 0) {
    count = ::read(file, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) count = 1;
    else if (count > 0) done += static_cast<std::size_t>(count);
  }
  if (count < 0) throw ResourceError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  text.resize(done);
  return text;
}

}  // namespace reachlab::record
