#include "sim/record/recover.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/error.h"
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
    encodeEnd(last, payload);
    writer.append(RecordType::End, payload.bytes());
  }
  writer.sync();
}

}  // namespace

Recovery recoverLog(const std::string& path) {
  if (isBeingWritten(path)) throw ResourceError(path + ": is being recorded into; end that run first");
  const RunLog log = RunLog::open(path);
  Recovery recovery;
  recovery.keptBytes = log.goodBytes();
  recovery.lostBytes = log.fileBytes() - log.goodBytes();
  recovery.trials = static_cast<int>(log.trials().size());
  if (log.healthy()) return recovery;
  recovery.interruptedTrial = !log.trials().empty() && !log.trials().back().complete;
  recovery.damagedOriginal = freeNameFor(path);

  const std::string mended = path + ".mended";
  std::error_code error;
  fs::remove(mended, error);  // of a recovery that was itself cut short
  writeMended(log, mended);
  // A second name for the original first, so that at every moment both its bytes and a log under its own name are there.
  fs::create_hard_link(path, recovery.damagedOriginal, error);
  if (error) {
    error.clear();
    fs::copy_file(path, recovery.damagedOriginal, error);
  }
  if (error) throw ResourceError(fmt::format("{}: the damaged original cannot be kept: {}", recovery.damagedOriginal, error.message()));
  fs::rename(mended, path, error);
  if (error) throw ResourceError(fmt::format("{}: cannot be replaced: {}", path, error.message()));
  recovery.mended = true;
  return recovery;
}

}  // namespace reachlab::record
