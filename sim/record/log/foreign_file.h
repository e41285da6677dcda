#pragma once
#include <string>

namespace reachlab::record {

/// AtomicFile for a library that writes by name: it is given `temporary()` and closes it, then `commit` puts it in the place of `path` once
/// it is on the disk. Without `commit` nothing is left, also where the program is killed. One thread; members throw ResourceError.
class ForeignFile {
 public:
  explicit ForeignFile(const std::string& path);
  ~ForeignFile();
  ForeignFile(const ForeignFile&) = delete;
  ForeignFile& operator=(const ForeignFile&) = delete;

  const std::string& temporary() const { return temporary_; }
  void commit();
  /// The library could not write: says so as every other write does, with what was being written.
  [[noreturn]] void giveUp(const std::string& what);

 private:
  std::string path_, temporary_;
  int descriptor_ = -1;
};

}  // namespace reachlab::record
