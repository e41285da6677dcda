#pragma once
#include <string>

namespace reachlab::record {

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

}  // namespace reachlab::record
