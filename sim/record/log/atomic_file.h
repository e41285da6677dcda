#pragma once
#include <functional>
#include <string>
#include <string_view>

#include "base/system/descriptor.h"

namespace reachlab::record {

/// Takes a long text piece by piece.
using TakePiece = std::function<void(std::string_view piece)>;

/// A file that takes the position of `path` in one step (temporary file, fsync, rename). A reader sees the old or the new file, never a part.
/// Makes the folders above it. Until it is put in place, nothing is left of it. One thread. Members throw ResourceError.
class TemporaryFile {
 protected:
  explicit TemporaryFile(const std::string& path);
  ~TemporaryFile();
  void drop();
  void close() { descriptor_ = os::Descriptor(); }
  std::string path_, temporary_;
  os::Descriptor descriptor_;
};

/// Text that is appended piece by piece.
class AtomicFile : TemporaryFile {
 public:
  explicit AtomicFile(const std::string& path) : TemporaryFile(path) {}
  void append(std::string_view piece);
  void commit();
  /// Puts the file in place only if the name is free. False: a file has the name, and it is not changed.
  bool commitNew();

 private:
  void flush();
  void sync();
  [[noreturn]] void giveUp();
  std::string waiting_;
};
/// The same with the whole text at once.
void writeFileAtomically(const std::string& path, std::string_view text);
/// The same for a new file: of several programs that write it at once, one program succeeds. False: the file exists already.
bool createFileAtomically(const std::string& path, std::string_view text);

/// For a library that writes by name. The library writes `temporary()` and closes it. Then `commit` puts the file in place once it is on the
/// disk.
class ForeignFile : TemporaryFile {
 public:
  explicit ForeignFile(const std::string& path) : TemporaryFile(path) {}
  const std::string& temporary() const { return temporary_; }
  void commit();
  /// Reports that the library could not write, in the form of every other write, with the name of the content.
  [[noreturn]] void giveUp(const std::string& what);
};

/// Whether a file of this name, without its folder, is a temporary one of the above.
bool isTemporaryName(std::string_view name);
/// Removes the temporary files of killed programs in a folder and the folders below it (`.….reachlab-tmp`, older than ten minutes). Throws
/// nothing: files that cannot be removed stay.
void removeLeftovers(const std::string& folder);

}  // namespace reachlab::record
