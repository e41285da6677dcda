#include "sim/record/log/run_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <type_traits>

#include "base/fault.h"
#include "base/text_file.h"
#include "base/ticks.h"
#include "sim/record/log/logs_folder.h"
#include "sim/record/log/records.h"
#include "sim/record/log/run_names.h"

namespace reachlab::record {
namespace {

constexpr std::uint64_t kNoTick = std::numeric_limits<std::uint64_t>::max();

// The trial that was under way when the log broke off, put together from what was logged of it.
struct OpenTrial {
  std::vector<TrialSetup> setups;
  RecordedTrial trial;
  bool underWay = false;

  void add(const RecordedEvent& event) {
    if (event.kind == EventKind::TrialStart) begin(event);
    if (!underWay || event.trial != trial.trial) return;
    if (event.kind == EventKind::Armed) trial.armedTick = event.tick;
    if (event.kind == EventKind::Go) trial.goTick = event.tick;
    if (event.kind == EventKind::Onset) trial.result.onsetTick = event.tick;
    if (event.kind == EventKind::ChannelBroken) trial.channelBroken = true;
  }
  void begin(const RecordedEvent& event) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    trial = beginTrial(event.trial, static_cast<int>(event.value), event.tick, setups);
    trial.peakHandSpeed = trial.handPathLength = trial.peakForce = trial.meanForce = unknown;
    underWay = true;
  }
  RecordedTrial brokenOff(std::uint64_t lastTick) const {
    RecordedTrial t = trial;
    t.lastTick = std::max(t.lastTick, lastTick);
    breakOff(t);
    return t;
  }
};

// Looks backwards from the end of a log that was not closed for its last trial record.
bool findLastTrial(LogReader& reader, TrialLink& link) {
  ByteWriter payload;
  encode(RecordedTrial{}, TrialLink{}, payload);
  const std::uint64_t whole = kRecordFrameBytes + payload.size();
  RecordView record;
  for (std::uint64_t end = reader.fileSize(); end >= kLogHeaderBytes + whole; --end) {
    if (!reader.readAt(end - whole, RecordType::Trial, static_cast<std::uint32_t>(payload.size()), record)) continue;
    link = {record.offset, record.sequence};
    return true;
  }
  return false;
}

}  // namespace

RecordedTrial beginTrial(int number, int index, std::uint64_t tick, const std::vector<TrialSetup>& setups) {
  RecordedTrial trial;
  trial.trial = number;
  trial.planned.index = index;
  for (const TrialSetup& setup : setups)
    if (setup.trial == number) trial.planned = setup.planned;
  trial.startTick = trial.lastTick = tick;
  return trial;
}

void breakOff(RecordedTrial& trial) {
  const std::uint64_t onset = trial.result.onsetTick;
  trial.result = {.outcome = trial::Outcome::Interrupted, .reason = trial::Reason::Program, .onsetTick = onset, .endTick = trial.lastTick};
  if (onset > 0) trial.result.movementTime = secondsBetween(onset, trial.lastTick);
  trial.complete = false;
}

SampleRows SampleRows::between(std::uint64_t first, std::uint64_t last) const {
  SampleRows part;
  part.columns = columns;
  const auto from = std::lower_bound(ticks.begin(), ticks.end(), first), to = std::upper_bound(from, ticks.end(), last);
  part.ticks.assign(from, to);
  const auto row = [&](auto at) { return values.begin() + (at - ticks.begin()) * static_cast<std::ptrdiff_t>(columns); };
  part.values.assign(row(from), row(to));
  return part;
}

std::string_view nameOf(EventKind kind) {
  constexpr std::string_view kNames[]{"unknown",     "trial_start",  "armed",        "go",          "onset",         "trial_end",
                                      "clamp_begin", "clamp_end",    "device_lost",  "device_back", "ticks_missed",  "step_fault",
                                      "note",        "device_state", "intervention", "instrument",  "channel_broken"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(kLastEventKind) + 1);
  return kNames[static_cast<std::size_t>(kind)];
}

RunLog RunLog::open(const std::string& path, LogCheck check) try {
  LogReader reader(path);
  RecordView record;
  if (!reader.next(record) || record.type != RecordType::Configuration)
    throw FaultError(Fault{.what = "the configuration at the start of the log is damaged, so nothing in it can be read"});
  RunLog log;
  log.path_ = path;
  log.fileBytes_ = reader.fileSize();
  log.configuration_ = configurationFromJson(asText(record.payload), path);
  const std::uint64_t first = reader.goodEnd();
  if (check != LogCheck::Trials || !log.readChain(reader)) {
    log.trials_.clear();
    reader.seek(first, 1);
    log.scan(reader);
  }
  for (RecordedTrial& trial : log.trials_) log.placeInScene(trial.planned);
  return log;
} catch (const FaultError& error) {
  throw FaultError(inFile(path, error.faults));
}

// The planned order says which scene a trial is done in.
void RunLog::placeInScene(trial::PlannedTrial& planned) const {
  if (!configuration_.scenes) return;
  const auto index = static_cast<std::size_t>(planned.index);
  if (planned.index < 0 || index >= configuration_.trials.size())
    throw FaultError(Fault{"trial.index", fmt::format("is {}, which was not planned", planned.index),
                           fmt::format("0 to {}", static_cast<int>(configuration_.trials.size()) - 1)});
  planned.scene = configuration_.trials[index].scene;
}

// From the last trial record back to the first. False when a link is broken: then only reading everything tells what is good.
bool RunLog::readChain(LogReader& reader) {
  const std::uint64_t endOffset = fileBytes_ - kRecordFrameBytes - kEndPayloadBytes;
  TrialLink link;
  RecordView record;
  closed_ = fileBytes_ > kEndPayloadBytes + kRecordFrameBytes + kLogHeaderBytes &&
            reader.readAt(endOffset, RecordType::End, kEndPayloadBytes, record);
  if (closed_) link = decodeEnd(record.payload);
  else if (!findLastTrial(reader, link)) return false;
  const TrialLink last = link;
  while (link.offset != 0) {
    reader.seek(link.offset, link.sequence);
    if (!reader.next(record) || record.type != RecordType::Trial) return false;
    const std::uint64_t at = link.offset;
    trials_.push_back(decodeTrial(record.payload, link));
    if (link.offset >= at) return false;
  }
  std::reverse(trials_.begin(), trials_.end());
  healthy_ = closed_;
  goodBytes_ = fileBytes_;
  if (closed_) return true;
  reader.seek(last.offset, last.sequence);  // and the tail behind it
  std::vector<RecordedTrial> before = std::move(trials_);
  trials_.clear();
  scan(reader);
  trials_.erase(trials_.begin());
  trials_.insert(trials_.begin(), before.begin(), before.end());
  return true;
}

void RunLog::scan(LogReader& reader) {
  OpenTrial open;
  RecordView record;
  TrialLink previous;
  std::vector<RecordedTick> ticks;
  TrialLink start;
  while (reader.next(record)) {
    if (record.type == RecordType::TrialSetup) {
      open.setups.push_back(decodeSetup(record.payload));
      start = {reader.goodEnd(), reader.nextSequence()};
    }
    if (record.type == RecordType::Event) open.add(decodeEvent(record.payload));
    if (record.type == RecordType::Ticks) {
      ticks.clear();
      decodeTicks(record.payload, ticks);
    }
    if (record.type == RecordType::Trial) {
      trials_.push_back(decodeTrial(record.payload, previous));
      open = {};
    }
    closed_ = record.type == RecordType::End;
  }
  goodBytes_ = reader.goodEnd();
  healthy_ = closed_ && goodBytes_ == fileBytes_;
  if (open.underWay) {
    trials_.push_back(open.brokenOff(ticks.empty() ? 0 : ticks.back().tick));
    trials_.back().offset = start.offset;
    trials_.back().sequence = start.sequence;
  }
}

template <typename Take>
void RunLog::each(RecordType type, std::uint64_t firstTick, Take&& take) const try {
  LogReader reader(path_);
  const auto after = std::upper_bound(trials_.begin(), trials_.end(), firstTick,
                                      [](std::uint64_t tick, const RecordedTrial& trial) { return tick < trial.startTick; });
  // Whoever asks from the first tick on asks for what was before it too: setups, notes.
  if (firstTick > 0 && after != trials_.begin() && std::prev(after)->offset != 0)
    reader.seek(std::prev(after)->offset, std::prev(after)->sequence);
  RecordView record;
  while (reader.goodEnd() < goodBytes_) {
    if (!reader.next(record))
      throw FaultError(fileFault(path_, fmt::format("damaged after byte {}; repair it with: reach recover {}", reader.goodEnd(), path_)));
    if (record.type != type) continue;
    if constexpr (std::is_void_v<decltype(take(record.payload))>) take(record.payload);
    else if (!take(record.payload)) return;
  }
} catch (const FaultError& error) {
  throw FaultError(inFile(path_, error.faults));
}

SampleRows RunLog::rows(std::uint64_t firstTick, std::uint64_t lastTick) const {
  SampleRows rows;
  rows.columns = configuration_.table.size();
  each(RecordType::Samples, firstTick, [&](std::span<const std::uint8_t> payload) {
    decodeSamples(payload, firstTick, lastTick, rows);
    return firstTickOf(payload) <= lastTick;
  });
  return rows;
}

SampleRows RunLog::allRows() const { return rows(0, kNoTick); }

std::uint64_t RunLog::firstSampleTick() const {
  std::uint64_t first = 0;
  each(RecordType::Samples, 0, [&](std::span<const std::uint8_t> payload) {
    first = firstTickOf(payload);
    return false;
  });
  return first;
}

void RunLog::eachBlock(const std::function<void(const SampleRows& block)>& take) const {
  SampleRows block;
  block.columns = configuration_.table.size();
  each(RecordType::Samples, 0, [&](std::span<const std::uint8_t> payload) {
    block.ticks.clear();
    block.values.clear();
    decodeSamples(payload, 0, kNoTick, block);
    take(block);
  });
}

std::vector<RecordedTick> RunLog::ticks() const {
  std::vector<RecordedTick> ticks;
  each(RecordType::Ticks, 0, [&](std::span<const std::uint8_t> payload) { decodeTicks(payload, ticks); });
  return ticks;
}

std::vector<std::vector<haptics::DeviceSample>> RunLog::otherTicks() const {
  std::vector<std::vector<haptics::DeviceSample>> hands(configuration_.otherHands.size());
  if (hands.empty()) return hands;
  each(RecordType::HandTicks, 0, [&](std::span<const std::uint8_t> payload) {
    const HandTicks hand = decodeHandTicks(payload);
    const auto index = static_cast<std::size_t>(hand.hand - 2);
    if (index >= hands.size()) throw FaultError(Fault{.what = fmt::format("hand {} in a log of {} hands", hand.hand, hands.size() + 1)});
    hands[index].insert(hands[index].end(), hand.samples.begin(), hand.samples.end());
  });
  return hands;
}

std::vector<RecordedEvent> RunLog::events() const {
  std::vector<RecordedEvent> events;
  each(RecordType::Event, 0, [&](std::span<const std::uint8_t> payload) { events.push_back(decodeEvent(payload)); });
  return events;
}

std::vector<TrialSetup> RunLog::setups() const {
  std::vector<TrialSetup> setups;
  each(RecordType::TrialSetup, 0,
       [&](std::span<const std::uint8_t> payload) { placeInScene(setups.emplace_back(decodeSetup(payload)).planned); });
  return setups;
}

std::vector<std::string> findLogs(const std::string& path) {
  namespace fs = std::filesystem;
  if (isFile(path)) return {path};
  requireSearchable(path);
  if (!isFolder(path)) throw FaultError(fileFault(path, "no such log or folder"));
  // A session's folder (sub-01/ses-01) holds the exported data; its logs lie in sourcedata of the same dataset, with its labels
  // in their names. A dataset may itself be called sub-pilot.
  std::string prefix;
  fs::path root = fs::absolute(path).lexically_normal();
  if (!root.has_filename()) root = root.parent_path();
  const std::string name = root.filename().string();
  const std::string parent = root.parent_path().filename().string();
  const bool isDataset = isFolder(root / kLogsFolder);
  if (!isDataset && name.starts_with("ses-") && parent.starts_with("sub-")) {
    prefix = parent + "_" + name + "_";
    root = root.parent_path().parent_path();
  } else if (!isDataset && name.starts_with("sub-")) {
    prefix = name + "_";
    root = root.parent_path();
  }
  if (isFolder(root / kLogsFolder)) root /= kLogsFolder;
  std::vector<std::string> logs;
  for (const fs::directory_entry& entry : fs::directory_iterator(root)) {
    const std::string file = entry.path().filename().string();
    if (file.ends_with(kLogEnding) && file.starts_with(prefix)) logs.push_back(entry.path().string());
  }
  if (logs.empty()) throw FaultError(fileFault(path, "no logs (…_log.reach) in this folder"));
  std::sort(logs.begin(), logs.end(), runBefore);
  return logs;
}

}  // namespace reachlab::record
