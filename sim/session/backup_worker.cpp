#include "sim/session/backup_worker.h"

#include <fmt/format.h>

#include "base/system/error_report.h"
#include "sim/session/backup.h"

namespace reachlab::session {
namespace {

BackupState backUpNow(const std::string& dataset, const std::string& backup) {
  try {
    const BackupReport report = backUp(dataset, backup);
    return {BackupState::Kind::Verified,
            fmt::format("backup {}: all {} finished run{} there and verified ({} file{}, {:.1f} MB copied now)", backup, report.runs,
                        report.runs == 1 ? " is" : "s are", report.copiedFiles, report.copiedFiles == 1 ? "" : "s",
                        1e-6 * static_cast<double>(report.copiedBytes))};
  } catch (const std::exception& error) {
    return {BackupState::Kind::Failed,
            fmt::format("backup {}: not made: {}; the recording itself is safe", backup, errorReportOf(error).sentence)};
  }
}

}  // namespace

BackupWorker::BackupWorker(std::string dataset, std::string backup)
    : dataset_(std::move(dataset)), backup_(std::move(backup)), thread_([this](const std::stop_token& stop) { work(stop); }) {}

BackupWorker::~BackupWorker() {
  (void)finish();
  thread_.request_stop();
  changed_.notify_all();
}

void BackupWorker::request() {
  const std::scoped_lock lock(mutex_);
  asked_ = true;
  state_ = {BackupState::Kind::Working, fmt::format("backup {}: being copied", backup_)};
  changed_.notify_all();
}

BackupState BackupWorker::state() const {
  const std::scoped_lock lock(mutex_);
  return state_;
}

BackupState BackupWorker::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return state_.kind != BackupState::Kind::Working; });
  return state_;
}

void BackupWorker::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return asked_; })) {
    asked_ = false;
    lock.unlock();
    BackupState done = backUpNow(dataset_, backup_);
    lock.lock();
    if (!asked_) state_ = std::move(done);  // else a run has ended meanwhile, and is copied next
    changed_.notify_all();
  }
}

}  // namespace reachlab::session
