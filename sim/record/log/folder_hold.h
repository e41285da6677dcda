#pragma once
#include <string>

#include "base/system/descriptor.h"

namespace reachlab::record {

/// Makes a folder and the folders above it. Throws ResourceError.
void makeFolders(const std::string& path);

/// For a lock that the file system refused: throws ResourceError with the reason in errno.
[[noreturn]] void refuseWithoutLocks(const std::string& path);

/// Locks a folder against other programs as long as it lives, so that files that belong together come from one program. Waits for another
/// holder. Makes the folder. One thread.
class FolderHold {
 public:
  enum class WithoutLocks { Refuse, HoldNothing };  // on a file system without locks
  /// Throws ResourceError where `Refuse` is asked for and the folder cannot be locked.
  FolderHold(const std::string& folder, WithoutLocks otherwise);

 private:
  os::Descriptor descriptor_;
};

}  // namespace reachlab::record
