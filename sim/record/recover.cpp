#include "sim/record/recover.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <vector>

#include "base/error.h"
#include "base/names.h"
#include "sim/record/configuration/limits.h"
#include "sim/record/log/append_file.h"
#include "sim/record/log/records.h"

namespace reachlab::record {
namespace {

namespace fs = std::filesystem;

std::string freeNameFor(const std::string& path) {
  std::string name = path + ".damaged";
  for (int k = 2; fs::exists(name); ++k) name = fmt::format("{}.damaged-{}", path, k);
  return name;
}

// Copies the good part of the log and closes it there.
void writeMended(const RunLog& log, const std::string& mended) {
  LogReader reader(log.path());
  LogWriter writer = LogWriter::create(mended);
  RecordView record;
  TrialLink last;
  bool ended = false;
  while (reader.goodEnd() < log.goodBytes() && reader.next(record)) {
    writer.append(record.type, record.payload);
    if (record.type == RecordType::Trial) last = {record.offset, record.sequence};
    ended = record.type == RecordType::End;
  }
  ByteWriter payload;
  if (!log.trials().empty() && !log.trials().back().complete) {
    encode(log.trials().back(), last, payload);
    const std::uint32_t sequence = writer.nextSequence();
    last = {writer.append(RecordType::Trial, payload.bytes()), sequence};
    payload.clear();
  }
  if (!ended) {
    encode(last, payload);
    writer.append(RecordType::End, payload.bytes());
  }
  writer.sync();
}

// The configuration of a log whose labels are longer than file names allow, with short ones and as many bytes: what lies behind it stays
// where it is. Nullopt: something else is wrong with it.
std::optional<std::string> withShortLabels(const RecordView& record) {
  using nlohmann::json;
  json object = json::parse(record.payload.begin(), record.payload.end(), nullptr, false);
  if (!object.is_object()) return std::nullopt;
  bool changed = false;
  for (const char* key : {"subject", "session", "task"}) {
    if (!object.contains(key) || !object[key].is_string()) continue;
    std::string label = object[key].get<std::string>();
    if (label.size() <= kMaxLabelLength) continue;
    object[key] = label.substr(0, kMaxLabelLength);
    changed = true;
  }
  std::string text = object.dump(1, ' ', false, json::error_handler_t::replace);
  if (!changed || text.size() > record.payload.size()) return std::nullopt;
  text.resize(record.payload.size(), ' ');
  return text;
}

std::optional<std::string> readableConfiguration(const std::string& path) {
  LogReader reader(path);
  RecordView record;
  if (!reader.next(record) || record.type != RecordType::Configuration) return std::nullopt;
  return withShortLabels(record);
}

void writeWithConfiguration(const std::string& path, const std::string& configuration, const std::string& mended) {
  LogReader reader(path);
  LogWriter writer = LogWriter::create(mended);
  for (RecordView record; reader.next(record);)
    if (record.type == RecordType::Configuration) writer.append(record.type, asBytes(configuration));
    else writer.append(record.type, record.payload);
  writer.sync();
}

// A second name for the original first, so that at every moment both its bytes and a log under its own name are there.
std::string replaceLog(const std::string& path, const std::string& mended) {
  const std::string original = freeNameFor(path);
  std::error_code error;
  fs::create_hard_link(path, original, error);
  if (error) {
    error.clear();
    fs::copy_file(path, original, error);
  }
  if (error) throw ResourceError(fmt::format("{}: the damaged original cannot be kept: {}", original, error.message()));
  fs::rename(mended, path, error);
  if (error) throw ResourceError(fmt::format("{}: cannot be replaced: {}", path, error.message()));
  return original;
}

// Where the disk is full, half of a file would stay.
struct Leftover {
  std::string path;
  void remove() const {
    std::error_code error;
    fs::remove(path, error);
  }
  ~Leftover() { remove(); }
};

}  // namespace

Recovery recoverLog(const std::string& given) {
  std::error_code unknown;
  const fs::path behind = fs::is_symlink(given, unknown) ? fs::canonical(given, unknown) : fs::path(given);  // the log itself is repaired
  const std::string path = unknown ? given : behind.string();
  if (isBeingWritten(path)) throw ResourceError(path + ": is being recorded into; end that run first");
  const std::string mended = path + ".mended";
  const Leftover leftover{mended};
  leftover.remove();  // of a recovery that was itself cut short
  if (const auto configuration = readableConfiguration(path)) {
    writeWithConfiguration(path, *configuration, mended);
    const RunLog log = RunLog::open(mended);  // nothing is replaced by what cannot be read either
    const std::uint64_t lost = fs::file_size(path) - log.fileBytes();
    const std::string original = replaceLog(path, mended);
    Recovery recovery = recoverLog(path);
    if (!recovery.mended) recovery.keptBytes = log.fileBytes();
    recovery.mended = true;
    recovery.lostBytes += lost;
    recovery.damagedOriginal = original;
    return recovery;
  }
  const RunLog log = RunLog::open(path);
  Recovery recovery;
  recovery.keptBytes = log.goodBytes();
  recovery.lostBytes = log.fileBytes() - log.goodBytes();
  recovery.trials = static_cast<int>(log.trials().size());
  if (log.healthy()) return recovery;
  recovery.interruptedTrial = !log.trials().empty() && !log.trials().back().complete;
  writeMended(log, mended);
  recovery.damagedOriginal = replaceLog(path, mended);
  recovery.mended = true;
  return recovery;
}

namespace {

// "8, 11 and 13 to 20", of ascending numbers.
std::string inWords(const std::vector<int>& numbers) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    if (last == i) parts.push_back(fmt::format("{}", numbers[i]));
    else parts.push_back(fmt::format("{} {} {}", numbers[i], last == i + 1 ? "and" : "to", numbers[last]));
    i = last + 1;
  }
  if (parts.size() == 1) return parts.front();
  return fmt::format("{} and {}", fmt::join(parts.begin(), parts.end() - 1, ", "), parts.back());
}

}  // namespace

std::string lossOf(const RunLog& log) {
  if (log.healthy() || isBeingWritten(log.path())) return {};
  std::string words = log.path() + (log.goodBytes() < log.fileBytes() ? ": the log is damaged." : ": the log was not closed in order.");
  std::set<int> there;
  for (const RecordedTrial& trial : log.trials()) there.insert(trial.planned.index);
  if (!log.trials().empty() && !log.trials().back().complete) words += fmt::format(" Trial {} broke off.", log.trials().back().trial);
  std::vector<int> missing;
  for (const trial::PlannedTrial& planned : log.configuration().trials)
    if (!there.contains(planned.index)) missing.push_back(planned.index + 1);
  std::sort(missing.begin(), missing.end());
  if (missing.size() == 1) words += fmt::format(" The planned trial {} is not in it.", missing.front());
  else if (!missing.empty()) words += fmt::format(" The planned trials {} are not in it.", inWords(missing));
  return words + " Close it in order with: reach recover " + shellWord(log.path());
}

}  // namespace reachlab::record
