#pragma once
#include <functional>
#include <string>
#include <string_view>

namespace reachlab::record {

/// Takes a long text piece by piece.
using TakePiece = std::function<void(std::string_view piece)>;

/// Replaces `path` in one step (temporary file, fsync, rename) by text that is appended piece by piece. A reader sees the old or the new
/// file, never a part. Makes the folders above it. Without `commit` nothing is left. One thread. Members throw ResourceError.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void append(std::string_view piece);
  void commit();
  /// Puts the file in place only if the name is free. False: a file has the name, and it is not changed.
  bool commitNew();

 private:
  void flush();
  void sync();
  [[noreturn]] void giveUp();
  std::string path_, temporary_, waiting_;
  int descriptor_ = -1;
};
/// The same with the whole text at once.
void writeFileAtomically(const std::string& path, std::string_view text);
/// The same for a new file: of several programs that write it at once, one program succeeds. False: the file exists already.
bool createFileAtomically(const std::string& path, std::string_view text);

/// AtomicFile for a library that writes by name. The library writes `temporary()` and closes it. Then `commit` puts the file in the
/// position of `path` once it is on the disk. Without `commit` nothing is left, also where the program is killed. One thread. Members throw
/// ResourceError.
class ForeignFile {
 public:
  explicit ForeignFile(const std::string& path);
  ~ForeignFile();
  ForeignFile(const ForeignFile&) = delete;
  ForeignFile& operator=(const ForeignFile&) = delete;

  const std::string& temporary() const { return temporary_; }
  void commit();
  /// Reports that the library could not write, in the form of every other write, with the name of the content.
  [[noreturn]] void giveUp(const std::string& what);

 private:
  std::string path_, temporary_;
  int descriptor_ = -1;
};

/// Removes the temporary files of killed programs in a folder and the folders below it (`.….reachlab-tmp`, older than ten minutes). Throws
/// nothing: files that cannot be removed stay.
void removeLeftovers(const std::string& folder);

}  // namespace reachlab::record
