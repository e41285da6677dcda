#include "sim/record/log/run_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/fault.h"
#include "sim/record/log/disk_fault.h"
#include "sim/record/log/folder_hold.h"

namespace reachlab::record {
namespace {

constexpr auto kFlushEvery = std::chrono::milliseconds(60);  // leaves room for a late recorder within the 100 ms that are promised
constexpr std::uint32_t kTicksPerBlock = 1000;
constexpr std::uint32_t kTicksPerClockLook = 16;
constexpr std::uint64_t kBytesPerDiskLook = 1 << 20;

// What a full disk would take with it is more than this recording.
void keepReserve(const std::string& path, const os::DiskSpace& disk, std::uint64_t diskReserve) {
  if (const std::string fault = reserveFault(path, disk, diskReserve); !fault.empty()) throw ResourceError(fault);
}

// Nothing is created for a run that nobody could read or that the disk has no space for, and nothing is left of a log whose first record
// the disk does not take.
LogWriter createLog(const std::string& path, const RunConfiguration& configuration, std::uint64_t diskReserve) {
  const std::string text = readableText(configuration, path);
  const std::string folder = std::filesystem::path(path).parent_path().string();
  makeFolders(folder);
  keepReserve(path, os::diskSpace(folder.empty() ? "." : folder), diskReserve);
  std::error_code error;
  const bool another = std::filesystem::exists(path, error);
  try {
    LogWriter log = LogWriter::create(path);
    log.append(RecordType::Configuration, asBytes(text));
    return log;
  } catch (const ResourceError&) {
    if (!another) std::filesystem::remove(path, error);
    throw;
  }
}

}  // namespace

std::string readableText(const RunConfiguration& configuration, const std::string& origin) {
  std::string text = toJson(configuration);
  (void)configurationFromJson(text, origin);
  if (text.size() <= kMaxPayloadBytes) return text;
  throw FaultError(inFile(origin, {Fault{"configuration", fmt::format("has {} bytes", text.size()),
                                         fmt::format("up to {}: plan fewer trials a run", kMaxPayloadBytes)}}));
}

RunWriter::RunWriter(const std::string& path, const RunConfiguration& configuration, std::uint64_t diskReserve, CutBy cutBy)
    : cutBy_(cutBy), diskReserve_(diskReserve), log_(createLog(path, configuration, diskReserve)), samples_(configuration.table.size()),
      tracker_(configuration.firstTrial) {
  for (int hand = 2; hand <= configuration.table.hands; ++hand) handBlocks_.emplace_back(hand);
  log_.sync();
  lookedAt_ = log_.size();
}

void RunWriter::announce(const TrialSetup& setup) {
  flush();
  tracker_.announce(setup);
  put(RecordType::TrialSetup, setup);
}

bool RunWriter::add(const QueuedTick& tick, std::span<const haptics::DeviceSample> devices, const double* row) {
  lastTick_ = tick.stamp.tick;
  // A trial begins a block of its own, so that it can be read without the one before.
  const auto step = tracker_.add(tick.stamp, tick.facts, events_);
  if (step.started) {
    std::vector<RecordedEvent> own;
    own.swap(events_);
    flush();
    events_.swap(own);
    tracker_.trial().offset = log_.size();
    tracker_.trial().sequence = log_.nextSequence();
  }
  ticks_.add(tick.stamp, devices[0]);
  for (std::size_t i = 0; i < handBlocks_.size(); ++i) handBlocks_[i].add(devices[i + 1]);
  if (row != nullptr) samples_.add(tick.stamp.tick, row);
  if (step.finished) {
    flush();
    writeTrial(tracker_.trial());
    return true;
  }
  if (ticks_.count() >= kTicksPerBlock || ticks_.count() % kTicksPerClockLook == 0) flushIfDue();
  return false;
}

void RunWriter::flushIfDue() {
  const bool due = cutBy_ == CutBy::Clock && std::chrono::steady_clock::now() - flushed_ >= kFlushEvery;
  if (due || ticks_.count() >= kTicksPerBlock) flush();
}

void RunWriter::flush() {
  if (log_.size() - lookedAt_ > kBytesPerDiskLook) {
    lookedAt_ = log_.size();
    keepReserve(log_.path(), os::diskSpace(log_.path()), diskReserve_);
  }
  const auto putBlock = [this](RecordType type, Block& block) {
    if (!block.empty()) log_.append(type, block.payload());
    block.clear();
  };
  putBlock(RecordType::Ticks, ticks_);
  for (HandBlock& block : handBlocks_) putBlock(RecordType::HandTicks, block);
  putBlock(RecordType::Samples, samples_);
  for (const RecordedEvent& event : events_) put(RecordType::Event, event);
  events_.clear();
  flushed_ = std::chrono::steady_clock::now();
}

void RunWriter::writeTrial(RecordedTrial trial) {
  const std::uint32_t sequence = log_.nextSequence();
  lastLink_ = {put(RecordType::Trial, trial, lastLink_), sequence};
  log_.sync();
  lastTrial_ = trial;
}

void RunWriter::note(const std::string& text) {
  events_.push_back({lastTick_, EventKind::Note, tracker_.underWay() ? tracker_.trial().trial : 0, 0, text});
  flush();
}

void RunWriter::add(const std::vector<RecordedEvent>& events) {
  events_.insert(events_.end(), events.begin(), events.end());
  flush();
}

void RunWriter::close() {
  flush();
  if (tracker_.underWay()) writeTrial(tracker_.brokenOff());
  put(RecordType::End, lastLink_);
  log_.sync();
}

}  // namespace reachlab::record
