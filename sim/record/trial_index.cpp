#include "sim/record/trial_index.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "base/error.h"
#include "base/maybe_const.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/checksum.h"
#include "sim/record/log/whole_file.h"
#include "sim/record/log/records.h"
#include "sim/record/recover.h"

namespace reachlab::record {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "REACHIDX";
constexpr std::uint32_t kVersion = 3;

// What comes before the scenes and trials, in the order of its bytes.
template <MaybeConst<IndexedRun> T, class Visit>
void visitRun(T& run, const Visit& visit) {
  visit(run.path, run.subject, run.session, run.condition, run.experiment, run.device, run.startedUtc, run.loss);
  visit(run.bytes, run.changedNs, run.run, run.block, run.day);
  visit.marks(run.practice, run.healthy);
}

void encode(const IndexedRun& run, ByteWriter& out) {
  const PutMembers put{out};
  visitRun(run, put);
  put(static_cast<std::uint32_t>(run.scenes.size()));
  for (const IndexedScene& scene : run.scenes) put(scene.kind, scene.target, scene.condition);
  put(static_cast<std::uint32_t>(run.trials.size()));
  ByteWriter one;
  for (const RecordedTrial& trial : run.trials) {
    one.clear();
    record::encode(trial, {}, one);
    out.putText(asText(one.bytes()));
    put.marks(trial.complete);
    put(trial.planned.scene);
  }
}

bool decode(ByteReader& in, IndexedRun& run) {
  const GetMembers get{in};
  visitRun(run, get);
  std::uint32_t scenes = 0, trials = 0;
  get(scenes);
  if (!in.ok() || scenes > in.left()) return false;
  run.scenes.resize(scenes);
  for (IndexedScene& scene : run.scenes) get(scene.kind, scene.target, scene.condition);
  get(trials);
  if (!in.ok() || trials > in.left()) return false;
  run.trials.resize(trials);
  for (RecordedTrial& trial : run.trials) {
    TrialLink link;
    trial = decodeTrial(asBytes(in.getText()), link);
    get.marks(trial.complete);
    get(trial.planned.scene);
    if (trial.planned.scene < 0 || trial.planned.scene >= std::max(1, static_cast<int>(scenes))) return false;
  }
  return in.ok();
}

std::map<std::string, IndexedRun> readIndex(const std::string& file) {
  std::map<std::string, IndexedRun> known;
  std::error_code error;
  if (file.empty() || !fs::is_regular_file(file, error)) return known;
  try {
    const std::string text = readWholeFile(file);
    if (text.size() < kMagic.size() + 12 || !text.starts_with(kMagic)) return known;
    const std::string_view body(text.data() + kMagic.size(), text.size() - kMagic.size() - 4);
    std::uint32_t stored = 0;
    std::memcpy(&stored, text.data() + text.size() - 4, 4);
    if (stored != checksum(body.data(), body.size())) return known;
    ByteReader in(asBytes(body));
    if (in.get<std::uint32_t>() != kVersion) return known;
    const auto runs = in.get<std::uint32_t>();
    for (std::uint32_t i = 0; i < runs && in.ok(); ++i) {
      IndexedRun run;
      if (!decode(in, run)) return {};
      std::string path = run.path;
      known.emplace(std::move(path), std::move(run));
    }
  } catch (const Error&) {  // read anew
    known.clear();
  }
  return known;
}

void writeIndex(const TrialIndex& index, const std::string& file) {
  ByteWriter out;
  out.put(kVersion);
  out.put(static_cast<std::uint32_t>(index.runs.size()));
  for (const IndexedRun& run : index.runs) encode(run, out);
  const std::string_view body = asText(out.bytes());
  const std::uint32_t crc = checksum(body.data(), body.size());
  std::string text(kMagic);
  text.append(body);
  text.append(reinterpret_cast<const char*>(&crc), 4);
  try {
    writeFileAtomically(file, text);
  } catch (const ResourceError&) {  // a full disk, a folder that may not be written to: the next opening takes longer
  }
}

// Size and time of the last change [ns].
std::pair<std::uint64_t, std::int64_t> stampOf(const std::string& path) {
  std::error_code error;
  const auto bytes = fs::file_size(path, error);
  const auto changed = fs::last_write_time(path, error);
  return {error ? 0 : bytes, error ? 0 : std::chrono::duration_cast<std::chrono::nanoseconds>(changed.time_since_epoch()).count()};
}

IndexedRun readRun(const std::string& path) {
  const RunLog log = RunLog::open(path, LogCheck::Trials);
  IndexedRun run = indexedRunOf(path, log.configuration());
  run.healthy = log.healthy();
  run.loss = lossOf(log);
  run.trials = log.trials();
  return run;
}

}  // namespace

IndexedRun indexedRunOf(const std::string& path, const RunConfiguration& c) {
  IndexedRun run;
  run.path = path;
  run.subject = c.subject;
  run.session = c.session;
  run.condition = conditionOf(c);
  run.experiment = c.experimentName;
  run.device = c.device;
  run.startedUtc = c.startedUtc;
  run.run = c.run;
  run.block = c.block;
  run.day = c.day;
  run.practice = c.practice;
  if (c.scenes)
    for (const RunScene& scene : *c.scenes) run.scenes.push_back({scene.kind, scene.target, scene.condition});
  return run;
}

std::size_t TrialIndex::trialCount() const {
  std::size_t count = 0;
  for (const IndexedRun& run : runs) count += run.trials.size();
  return count;
}

TrialIndex openTrialIndex(const std::string& path, const std::string& indexFile, const IndexProgress& progress) {
  const std::vector<std::string> logs = findLogs(path);
  std::map<std::string, IndexedRun> known = readIndex(indexFile);
  TrialIndex index;
  bool given = false;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const auto stamp = stampOf(logs[i]);
    const auto found = known.find(logs[i]);
    const auto isOver = [](const IndexedRun& run) { return run.healthy || !run.loss.empty(); };  // else it was being recorded into
    if (found != known.end() && isOver(found->second) && stamp == std::pair(found->second.bytes, found->second.changedNs)) {
      index.runs.push_back(std::move(found->second));
      continue;
    }
    if (progress && !progress(i, logs.size())) {
      given = true;
      break;
    }
    ++index.read;
    try {
      index.runs.push_back(readRun(logs[i]));
      std::tie(index.runs.back().bytes, index.runs.back().changedNs) = stamp;
    } catch (const Error& error) {
      index.unreadable.emplace_back(error.what());
    }
  }
  const bool changed = index.read > 0 || known.size() != index.runs.size();
  if (!indexFile.empty() && changed && !given) writeIndex(index, indexFile);
  return index;
}

std::string indexFileFor(const std::string& path, const std::string& folder) {
  std::error_code error;
  const std::string whole = fs::weakly_canonical(fs::absolute(path, error), error).string();
  return fmt::format("{}/{:016x}.index", folder, std::hash<std::string>{}(whole));
}

}  // namespace reachlab::record
