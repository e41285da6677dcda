#include "sim/record/log/append_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/fault.h"
#include "base/system/os.h"
#include "sim/record/log/foreign_file.h"

namespace reachlab::record {
namespace {

// One sentence a person can act on: what failed, where, why, what to do.
[[noreturn]] void fail(std::string_view what, const std::string& path) {
  const int fault = errno;
  std::string_view remedy = "check the folder and its permissions";
  if (fault == EFBIG)
    remedy = "its disk or a limit of this process (ulimit -f) allows no larger file: choose another disk or raise the limit";
  if (fault == ENOSPC || fault == EDQUOT) remedy = "free space on the disk or choose another folder";
  if (fault == EACCES || fault == EPERM) remedy = "choose a folder that can be written";
  if (fault == EROFS) remedy = "what is on it is safe: choose a folder on another disk, or mount it for writing";
  if (fault == EEXIST) remedy = "nothing is overwritten: choose another name";
  if (fault == EIO || fault == ENODEV || fault == ENXIO) remedy = "the disk has gone: what was synced before is safe on it";
  throw ResourceError(fmt::format("{}: {}: {}; {}", path, what, std::strerror(fault), remedy));
}

bool writeAll(int descriptor, const std::uint8_t* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(descriptor, data, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    data += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

// After a rename or a creation the folder itself must reach the disk, or the name may be lost with the power.
void syncFolderOf(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  // Some network file systems have no such thing and say EINVAL: there it is theirs to keep.
  if (!os::syncFolder(folder.empty() ? "." : folder) && errno != EINVAL) fail("its name cannot be synced to the disk", path);
}

// The exclusive lock of a log, held as long as the descriptor is open.
void lockExclusively(int descriptor, const std::string& path) {
  while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EINTR) continue;
    if (errno == EWOULDBLOCK)
      throw ResourceError(fmt::format("{}: is being written by another program{}; wait until its run has ended", path, writerOf(path)));
    throw ResourceError(
        fmt::format("{}: cannot be locked against a second program: {}; choose a folder on a disk with locks", path, std::strerror(errno)));
  }
}

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

AppendFile AppendFile::create(const std::string& path) {
  makeFolders(std::filesystem::path(path).parent_path().string());
  const int descriptor = os::aboveStandardDescriptors(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0644));
  if (descriptor < 0) fail("cannot be created", path);
  AppendFile file(descriptor, path, 0);
  lockExclusively(descriptor, path);
  syncFolderOf(path);
  return file;
}

AppendFile AppendFile::openAt(const std::string& path, std::uint64_t size) {
  const int descriptor = os::aboveStandardDescriptors(::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  if (descriptor < 0) fail("cannot be opened for writing", path);
  AppendFile file(descriptor, path, size);
  lockExclusively(descriptor, path);
  if (::ftruncate(descriptor, static_cast<off_t>(size)) != 0) fail("cannot be cut to its good part", path);
  return file;
}

AppendFile::~AppendFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

AppendFile::AppendFile(AppendFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), path_(std::move(other.path_)), size_(other.size_), torn_(other.torn_) {}

AppendFile& AppendFile::operator=(AppendFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(path_, other.path_);
  std::swap(size_, other.size_);
  std::swap(torn_, other.torn_);
  return *this;
}

void AppendFile::append(std::span<const std::uint8_t> bytes) {
  if (torn_ && ::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) fail("cannot be cut to its good part", path_);
  torn_ = false;
  if (!writeAll(descriptor_, bytes.data(), bytes.size())) {
    const int fault = errno;
    torn_ = ::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0;
    errno = fault;
    fail("cannot be written", path_);
  }
  size_ += bytes.size();
}

void AppendFile::sync() {
  if (!os::syncFile(descriptor_)) fail("cannot be synced to the disk", path_);
  struct stat open {
  }, named{};
  const bool there =
      ::fstat(descriptor_, &open) == 0 && ::stat(path_.c_str(), &named) == 0 && open.st_ino == named.st_ino && open.st_dev == named.st_dev;
  if (!there)
    throw ResourceError(path_ + ": is no longer there: its disk was taken away or it was deleted; put it back before the next run");
}

AtomicFile::AtomicFile(const std::string& path) : path_(path) {
  makePlaceFor(path);
  descriptor_ = openTemporary(path, temporary_);
  if (descriptor_ < 0) fail("cannot be created", path);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  removeTemporary(temporary_);
  ::close(descriptor_);
}

void AtomicFile::giveUp() {
  const int reason = errno;
  removeTemporary(temporary_);
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  errno = reason;
  fail("cannot be written", path_);
}

void AtomicFile::append(std::string_view piece) {
  waiting_ += piece;
  if (waiting_.size() >= kBytesAWrite) flush();
}

void AtomicFile::flush() {
  if (!writeAll(descriptor_, reinterpret_cast<const std::uint8_t*>(waiting_.data()), waiting_.size())) giveUp();
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
  ::close(std::exchange(descriptor_, -1));
  if (isNew) syncFolderOf(path_);
  return isNew;
}

void AtomicFile::commit() {
  sync();
  if (!putInPlace(temporary_, path_)) giveUp();
  ::close(std::exchange(descriptor_, -1));
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

FolderHold::FolderHold(const std::string& folder, WithoutLocks otherwise) {
  makeFolders(folder);
  descriptor_ = os::aboveStandardDescriptors(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  const bool refuse = otherwise == WithoutLocks::Refuse;
  if (descriptor_ < 0 && refuse) throw ResourceError(fmt::format("{}: cannot be opened: {}", folder, std::strerror(errno)));
  while (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX) != 0) {
    if (errno == EINTR) continue;
    const int fault = errno;
    ::close(descriptor_);
    descriptor_ = -1;
    if (refuse)
      throw ResourceError(fmt::format("{}: cannot be locked against a second program: {}; choose a folder on a disk with locks", folder,
                                      std::strerror(fault)));
  }
}

FolderHold::~FolderHold() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

ForeignFile::ForeignFile(const std::string& path) : path_(path) {
  makePlaceFor(path);
  descriptor_ = openTemporary(path, temporary_);
  if (descriptor_ < 0) fail("cannot be created", path);
}

ForeignFile::~ForeignFile() {
  if (descriptor_ < 0) return;
  removeTemporary(temporary_);
  ::close(descriptor_);
}

void ForeignFile::commit() {
  if (!os::syncFile(descriptor_) || !putInPlace(temporary_, path_)) fail("cannot be written", path_);
  ::close(std::exchange(descriptor_, -1));
  syncFolderOf(path_);
}

void ForeignFile::giveUp(const std::string& what) {
  // A library says only that it failed. If the disk takes nothing more either, then that is why.
  const int own = ::open(openFileOf(descriptor_).c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  const std::vector<std::uint8_t> some(kBytesAWrite);
  const bool good = own >= 0 && writeAll(own, some.data(), some.size()) && os::syncFile(own);
  const int reason = errno;
  if (own >= 0) ::close(own);
  errno = reason;
  if (!good) fail("cannot be written", path_);
  throw ResourceError(fmt::format("{}: cannot be written: {}; check the folder and the space on its disk", path_, what));
}

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

void removeLeftovers(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  constexpr auto kOld = std::chrono::minutes(10);  // another program may be writing one this moment
  for (auto entry = fs::recursive_directory_iterator(folder, error); !error && entry != fs::end(entry); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with('.') || !name.ends_with(kTemporaryEnding) || !entry->is_regular_file(error)) continue;
    if (fs::file_time_type::clock::now() - entry->last_write_time(error) > kOld) fs::remove(entry->path(), error);
    error.clear();
  }
}

void makeFolders(const std::string& path) {
  if (path.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!error) return;
  errno = error.value();
  fail("cannot be made", path);
}

std::string writerOf(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return {};
  std::ifstream locks("/proc/locks");  // NUMBER: FLOCK ADVISORY WRITE PID MAJOR:MINOR:INODE 0 EOF
  for (std::string number, kind, how, what, process, file, rest; locks >> number >> kind >> how >> what >> process >> file;) {
    std::getline(locks, rest);
    if (kind == "FLOCK" && file.ends_with(fmt::format(":{}", status.st_ino))) return fmt::format(" (process {})", process);
  }
  return {};
}

bool isBeingWritten(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return false;
  const bool locked = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return locked;
}

}  // namespace reachlab::record
