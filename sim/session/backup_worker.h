#pragma once
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace reachlab::session {

struct BackupState {
  enum class Kind { Idle, Working, Verified, Failed };
  Kind kind = Kind::Idle;
  std::string sentence;  // for a person; empty while idle
};

/// Keeps a second data folder up to date on a separate thread, so that no person waits for its disk. The controlling thread calls the
/// members.
class BackupWorker {
 public:
  BackupWorker(std::string dataset, std::string backup);
  /// Finishes the requested copy.
  ~BackupWorker();

  /// A run has ended. It is copied soon, with all other runs that the backup lacks.
  void request();
  BackupState state() const;
  /// Waits until the requested copy is done.
  BackupState finish();

 private:
  void work(const std::stop_token& stop);
  std::string dataset_, backup_;
  mutable std::mutex mutex_;  // guards the members below
  std::condition_variable_any changed_;
  bool asked_ = false;
  BackupState state_;
  std::jthread thread_;
};

}  // namespace reachlab::session
