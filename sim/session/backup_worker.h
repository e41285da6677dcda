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

/// Keeps a second data folder up to date on a thread of its own, so that nobody waits for its disk. Members: the controlling thread's.
class BackupWorker {
 public:
  BackupWorker(std::string dataset, std::string backup);
  /// Finishes what was asked for.
  ~BackupWorker();
  BackupWorker(const BackupWorker&) = delete;
  BackupWorker& operator=(const BackupWorker&) = delete;

  /// A run has ended: it is copied soon, with all that is not in the backup yet.
  void request();
  BackupState state() const;
  /// Waits until what was requested is done.
  BackupState finish();

 private:
  void work(const std::stop_token& stop);
  std::string dataset_, backup_;
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable_any changed_;
  bool asked_ = false;
  BackupState state_;
  std::jthread thread_;
};

}  // namespace reachlab::session
