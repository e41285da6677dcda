#include "base/text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/fault.h"

namespace reachlab {
namespace fs = std::filesystem;

bool isThere(const std::string& path) {
  std::error_code error;
  return fs::exists(path, error);
}

bool isFile(const std::string& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

bool isFolder(const std::string& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

std::string besideFile(const std::string& file, const std::string& name) {
  const fs::path beside = fs::path(file).parent_path() / name;
  return isFile(beside) ? beside.string() : name;
}

std::string readTextFile(const std::string& file, std::uintmax_t mostBytes) {
  std::error_code error;
  // A pipe or a device might never end, or never begin.
  if (isThere(file) && !isFile(file) && !isFolder(file)) throw FaultError(fileFault(file, "is no regular file", "a file on a disk"));
  if (const std::uintmax_t size = fs::file_size(file, error); !error && size > mostBytes)
    throw FaultError(fileFault(file, fmt::format("has {} bytes", size), fmt::format("up to {}", mostBytes)));
  std::ifstream in(file, std::ios::binary);
  if (!in) throw FaultError(fileFault(file, fmt::format("cannot be read: {}", std::strerror(errno))));
  std::ostringstream text;
  text << in.rdbuf();
  if (text.fail()) (void)in.peek();  // nothing was copied: an empty file is at its end, and what is no file (a folder) is bad
  if (in.bad() || (text.fail() && !in.eof())) throw FaultError(fileFault(file, fmt::format("cannot be read: {}", std::strerror(errno))));
  return std::move(text).str();
}

void requireSearchable(const std::string& path) {
  std::error_code error;
  (void)fs::exists(path, error);
  if (error) throw ResourceError(fmt::format("{}: cannot be read: {}", path, error.message()));
}

}  // namespace reachlab
