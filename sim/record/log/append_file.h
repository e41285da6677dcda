#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace reachlab::record {

/// A file that only grows, held under an exclusive lock so that no second program writes or repairs it. Move-only. One thread at a time.
/// Members throw ResourceError naming the file, the fault and the remedy.
class AppendFile {
 public:
  /// Creates a new file. A file that exists is refused.
  static AppendFile create(const std::string& path);
  /// Opens an existing file, cut back to `size` bytes.
  static AppendFile openAt(const std::string& path, std::uint64_t size);
  ~AppendFile();
  AppendFile(AppendFile&& other) noexcept;
  AppendFile& operator=(AppendFile&& other) noexcept;

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
  int descriptor_ = -1;
  std::string path_;
  std::uint64_t size_ = 0;  // of the good part
  bool torn_ = false;       // a part of a record follows the good part
};

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

/// Locks a folder against other programs as long as it lives, so that files that belong together come from one program. Waits for another
/// holder. Makes the folder. One thread.
class FolderHold {
 public:
  enum class WithoutLocks { Refuse, HoldNothing };  // on a file system without locks
  /// Throws ResourceError where `Refuse` is asked for and the folder cannot be locked.
  FolderHold(const std::string& folder, WithoutLocks otherwise);
  ~FolderHold();
  FolderHold(const FolderHold&) = delete;
  FolderHold& operator=(const FolderHold&) = delete;

 private:
  int descriptor_;
};
/// Removes the temporary files of killed programs in a folder and the folders below it (`.….reachlab-tmp`, older than ten minutes). Throws
/// nothing: files that cannot be removed stay.
void removeLeftovers(const std::string& folder);
/// The whole file. Throws ResourceError (also for a pipe or a device, which might never end), FaultError beyond kMaxBytesOfAFile.
inline constexpr std::int64_t kMaxBytesOfAFile = 1ll << 30;
std::string readWholeFile(const std::string& path);
/// Makes a folder and the folders above it. Throws ResourceError.
void makeFolders(const std::string& path);
/// True while another program holds the file's lock (a run is being recorded into it).
bool isBeingWritten(const std::string& path);
/// The holder of the lock, as " (process 1234)". Empty without a holder, or when the system does not name it.
std::string writerOf(const std::string& path);

}  // namespace reachlab::record
