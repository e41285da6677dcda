#include "sim/record/log/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <random>

#include "base/error.h"
#include "base/system/os.h"
#include "sim/record/log/disk_fault.h"
#include "sim/record/log/folder_hold.h"

namespace reachlab::record {
namespace {

constexpr std::string_view kTemporaryEnding = ".reachlab-tmp";
constexpr std::size_t kBytesAWrite = 1 << 16;

// Beside `path`, under a name that nobody can have put there before; `make` says whether it could.
template <class Make>
int withFreeName(const std::string& path, std::string& name, Make&& make) {
  std::random_device entropy;
  for (int tries = 0; tries < 100; ++tries) {
    const std::filesystem::path whole(path);
    const std::uint64_t number = (static_cast<std::uint64_t>(entropy()) << 32) ^ entropy();
    name = (whole.parent_path() / fmt::format(".{:016x}{}", number, kTemporaryEnding)).string();
    const int made = make();
    if (made >= 0 || errno != EEXIST) return made;
  }
  return -1;
}

std::string openFileOf(int descriptor) { return fmt::format("/proc/self/fd/{}", descriptor); }
bool hasNoName(const std::string& name) { return name.starts_with("/proc/self/fd/"); }

// A file without a name, which goes with the program however that ends; where the file system knows none, one with a name.
int openTemporary(const std::string& path, std::string& name) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const int nameless = os::aboveStandardDescriptors(::open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0644));
  if (nameless >= 0) {
    name = openFileOf(nameless);
    return nameless;
  }
  return withFreeName(path, name, [&] {
    return os::aboveStandardDescriptors(::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644));
  });
}

// Puts what was written in the place of `path`. A rename puts the new name in place of a link, never through it.
bool putInPlace(const std::string& temporary, const std::string& path) {
  std::string named = temporary;
  if (hasNoName(temporary) &&
      withFreeName(path, named, [&] { return ::linkat(AT_FDCWD, temporary.c_str(), AT_FDCWD, named.c_str(), AT_SYMLINK_FOLLOW); }) < 0)
    return false;
  if (::rename(named.c_str(), path.c_str()) == 0) return true;
  const int reason = errno;
  ::unlink(named.c_str());
  errno = reason;
  return false;
}

// A rename would put a file in the place of a device or a pipe.
void makePlaceFor(const std::string& path) {
  makeFolders(std::filesystem::path(path).parent_path().string());
  std::error_code error;
  const std::filesystem::file_status there = std::filesystem::status(path, error);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there))
    throw ResourceError(path + ": cannot be written: is no regular file; choose a file on a disk");
}

void removeTemporary(const std::string& temporary) {
  if (!hasNoName(temporary)) ::unlink(temporary.c_str());
}

}  // namespace

TemporaryFile::TemporaryFile(const std::string& path) : path_(path) {
  makePlaceFor(path);
  descriptor_ = os::Descriptor(openTemporary(path, temporary_));
  if (descriptor_ < 0) failByErrno("cannot be created", path);
}

TemporaryFile::~TemporaryFile() { drop(); }

void TemporaryFile::drop() {
  if (descriptor_ < 0) return;
  removeTemporary(temporary_);
  close();
}

void AtomicFile::giveUp() {
  const int reason = errno;
  drop();
  errno = reason;
  failByErrno("cannot be written", path_);
}

void AtomicFile::append(std::string_view piece) {
  waiting_ += piece;
  if (waiting_.size() >= kBytesAWrite) flush();
}

void AtomicFile::flush() {
  if (!os::writeAll(descriptor_, waiting_.data(), waiting_.size())) giveUp();
  waiting_.clear();
}

void AtomicFile::sync() {
  flush();
  if (!os::syncFile(descriptor_)) giveUp();
}

bool AtomicFile::commitNew() {
  sync();
  bool isNew = ::linkat(AT_FDCWD, temporary_.c_str(), AT_FDCWD, path_.c_str(), AT_SYMLINK_FOLLOW) == 0;
  if (isNew || errno == EEXIST) {
    removeTemporary(temporary_);
  } else {
    // Without hard links a file system cannot tell who comes first.
    if ((errno != EPERM && errno != EOPNOTSUPP) || !putInPlace(temporary_, path_)) giveUp();
    isNew = true;
  }
  close();
  if (isNew) syncFolderOf(path_);
  return isNew;
}

void AtomicFile::commit() {
  sync();
  if (!putInPlace(temporary_, path_)) giveUp();
  close();
  syncFolderOf(path_);
}

void writeFileAtomically(const std::string& path, std::string_view text) {
  AtomicFile file(path);
  file.append(text);
  file.commit();
}

bool createFileAtomically(const std::string& path, std::string_view text) {
  AtomicFile file(path);
  file.append(text);
  return file.commitNew();
}

void ForeignFile::commit() {
  if (!os::syncFile(descriptor_) || !putInPlace(temporary_, path_)) failByErrno("cannot be written", path_);
  close();
  syncFolderOf(path_);
}

void ForeignFile::giveUp(const std::string& what) {
  // A library says only that it failed. If the disk takes nothing more either, then that is why.
  const os::Descriptor own(::open(openFileOf(descriptor_).c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  const std::string some(kBytesAWrite, '\0');
  if (own < 0 || !os::writeAll(own, some.data(), some.size()) || !os::syncFile(own)) failByErrno("cannot be written", path_);
  throw ResourceError(fmt::format("{}: cannot be written: {}; check the folder and the space on its disk", path_, what));
}

bool isTemporaryName(std::string_view name) { return name.starts_with('.') && name.ends_with(kTemporaryEnding); }

void removeLeftovers(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  constexpr auto kOld = std::chrono::minutes(10);  // another program may be writing one this moment
  for (auto entry = fs::recursive_directory_iterator(folder, error); !error && entry != fs::end(entry); entry.increment(error)) {
    if (!isTemporaryName(entry->path().filename().string()) || !entry->is_regular_file(error)) continue;
    if (fs::file_time_type::clock::now() - entry->last_write_time(error) > kOld) fs::remove(entry->path(), error);
    error.clear();
  }
}

}  // namespace reachlab::record
