#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "base/system/descriptor.h"

namespace reachlab::record {

/// A file that only grows, held under an exclusive lock so that no second program writes or repairs it. Move-only. One thread at a time.
/// Members throw ResourceError naming the file, the fault and the remedy.
class AppendFile {
 public:
  /// Creates a new file. A file that exists is refused.
  static AppendFile create(const std::string& path);
  /// All or nothing: a part that a full disk has let through is cut off again. While it cannot be cut off, nothing is written behind it,
  /// since reading ends at an incomplete record.
  void append(std::span<const std::uint8_t> bytes);
  /// Returns when everything appended is on the disk (fdatasync) and the file still has its name. Without this check a folder that was
  /// unmounted or deleted under an open file would take writes silently.
  void sync();
  /// Size of the complete appended data [bytes].
  std::uint64_t size() const { return size_; }
  const std::string& path() const { return path_; }

 private:
  AppendFile(int descriptor, std::string path, std::uint64_t size) : descriptor_(descriptor), path_(std::move(path)), size_(size) {}
  os::Descriptor descriptor_;
  std::string path_;
  std::uint64_t size_ = 0;  // of the good part
  bool torn_ = false;       // a part of a record follows the good part
};

/// True while another program holds the file's lock (a run is being recorded into it).
bool isBeingWritten(const std::string& path);
/// The holder of the lock, as " (process 1234)". Empty without a holder, or when the system does not name it.
std::string writerOf(const std::string& path);

}  // namespace reachlab::record
