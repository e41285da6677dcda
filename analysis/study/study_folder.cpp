#include "analysis/study/study_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "analysis/study/gzip.h"
#include "analysis/study/hdf5_table.h"
#include "analysis/study/points.h"
#include "analysis/study/trial_row.h"
#include "base/fault.h"
#include "base/system/descriptor.h"
#include "base/system/hold_alone.h"
#include "base/text_file.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/folder_hold.h"
#include "sim/record/log/whole_file.h"

namespace reachlab::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string designPath(const std::string& folder) { return folder + "/study.json"; }

// All that the design was made of, so that it is the same wherever the folder is taken.
std::string textOf(const StudyFolder& folder) {
  const Design& design = folder.design;
  Json json = Json::object();
  json["schema_version"] = 1;
  json["program"] = "reachlab " REACHLAB_VERSION;
  json["fingerprint"] = fmt::format("{:016x}", folder.fingerprint);
  json["name"] = design.name;
  json["points"] = pointCount(design);
  json["subjects"] = design.subjects;
  json["chunks"] = folder.chunks.count();
  json["subjects_per_chunk"] = folder.chunks.pairsPerChunk;
  json["file"] = fs::path(design.file).filename().string();
  json["text"] = design.text;
  json["plan_name"] = design.plan;
  json["plan"] = design.planText;
  json["experiments"] = Json::object();
  for (const auto& [name, text] : design.experimentTexts) json["experiments"][name] = text;
  if (!design.definitionTexts.empty()) json["definitions"] = Json(design.definitionTexts);
  return json.dump(2) + "\n";
}

StudyFolder folderOf(Design design, const std::string& path) {
  StudyFolder folder{path, std::move(design), {}, 0};
  folder.chunks = planChunks(folder.design);
  folder.fingerprint = fingerprintOf(folder.design);
  return folder;
}

}  // namespace

StudyFolder makeFolder(const Design& design, const std::string& path) {
  StudyFolder folder = folderOf(design, path);
  record::makeFolders(path);
  record::removeLeftovers(path);
  const std::string file = designPath(path), text = textOf(folder);
  std::error_code error;
  if (!isThere(file) && !fs::is_empty(path, error))
    throw ResourceError(path + ": holds other files, and no study; allowed: a new folder, or that of this study");
  if (!record::createFileAtomically(file, text) && record::readWholeFile(file) != text)
    throw ResourceError(file +
                        ": is of another study, or of this one with other files or another version of the program; allowed: a folder of "
                        "its own for each study");
  return folder;
}

StudyFolder openFolder(const std::string& path) {
  const std::string file = designPath(path);
  requireSearchable(file);
  if (!isThere(file)) throw FaultError(Fault{"study", file + " is not there", "the folder that a study was written to"});
  try {
    const Json json = Json::parse(record::readWholeFile(file));
    using Texts = std::map<std::string, std::string>;
    Design design = parseDesign(json.at("text").get<std::string>(), json.at("file").get<std::string>(),
                                NamedTexts{json.at("plan_name").get<std::string>(), json.at("plan").get<std::string>(),
                                           json.at("experiments").get<Texts>(), json.value("definitions", Texts())});
    StudyFolder folder = folderOf(std::move(design), path);
    folder.fingerprint = std::stoull(json.at("fingerprint").get<std::string>(), nullptr, 16);
    return folder;
  } catch (const Json::exception& fault) {
    throw FaultError(Fault{"study", fmt::format("{} is no study's: {}", file, fault.what()), "the file as the program wrote it"});
  }
}

ChunksToDo chunksToDo(const StudyFolder& folder, const Shard& shard) {
  ChunksToDo todo;
  for (std::int64_t chunk = 0; chunk < folder.chunks.count(); ++chunk) {
    if (!shard.has(chunk)) continue;
    if (isChunkThere(folder.path, chunk, folder.fingerprint)) ++todo.there;
    else todo.missing.push_back(chunk);
  }
  return todo;
}

bool areTablesThere(const StudyFolder& folder) {
  const auto isThere = [&](const char* name) {
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(folder.path + name, error);
    return !error && bytes > 0;
  };
  return isThere("/trials.csv.gz") && isThere("/trials.h5") && isThere("/trials.json");
}

bool mergeTables(const StudyFolder& folder) {
  // A thousand shares end one by one: each stops looking at the first chunk that is missing.
  for (std::int64_t chunk = 0; chunk < folder.chunks.count(); ++chunk)
    if (!isChunkThere(folder.path, chunk, folder.fingerprint)) return false;
  // One program merges at a time, where the file system has locks. Without, two would write the same bytes.
  const os::Descriptor hold(::open((folder.path + "/.merge").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (hold >= 0) os::lock(hold, LOCK_EX);
  if (areTablesThere(folder)) return true;
  const std::vector<Column> columns = columnsOf(folder.design);
  std::string header;
  for (const Column& column : columns) header += (header.empty() ? "" : ",") + column.name;
  const std::string dictionary = dictionaryOf(folder.design);
  record::AtomicFile csv(folder.path + "/trials.csv.gz");
  csv.append(gzipMember(header + "\n"));
  std::int64_t next = 0;
  const auto nextRows = [&]() -> std::optional<ChunkRows> {
    if (next == folder.chunks.count()) return std::nullopt;
    ChunkRows rows = readChunk(folder.path, next++, folder.fingerprint);
    csv.append(rows.csvGz);
    return rows;
  };
  writeHdf5Table(folder.path + "/trials.h5", columns, dictionary, folder.design.profiles ? kProfileNumbers : 0, nextRows);
  record::writeFileAtomically(folder.path + "/trials.json", dictionary);
  csv.commit();
  return true;
}

StudyStatus statusOf(const StudyFolder& folder) {
  StudyStatus status;
  status.chunks = folder.chunks.count();
  const std::int64_t most = mostTrialsOfSubject(folder.design);
  status.trials = trialsOfPairs(folder.design, most, 0, folder.chunks.pairs);
  std::vector<std::pair<fs::file_time_type, std::int64_t>> done;  // when, trials
  for (std::int64_t chunk = 0; chunk < status.chunks; ++chunk) {
    if (!isChunkThere(folder.path, chunk, folder.fingerprint)) continue;  // a damaged one throws, since it does not count as done
    std::error_code error;
    const auto when = fs::last_write_time(chunkPath(folder.path, chunk), error);
    if (error) continue;
    const PairRange range = folder.chunks.at(chunk);
    done.emplace_back(when, trialsOfPairs(folder.design, most, range.first, range.end));
    status.trialsDone += done.back().second;
  }
  status.chunksDone = static_cast<std::int64_t>(done.size());
  status.tables = areTablesThere(folder);
  std::sort(done.begin(), done.end());
  // From the last pause on (a night between two parts says nothing of the rate), an hour at most.
  std::size_t first = done.empty() ? 0 : done.size() - 1;
  while (first > 0 && done[first].first - done[first - 1].first < std::chrono::minutes(10) &&
         done.back().first - done[first - 1].first < std::chrono::hours(1))
    --first;
  std::int64_t trials = 0;
  for (std::size_t i = first + 1; i < done.size(); ++i) trials += done[i].second;
  const double seconds = done.empty() ? 0 : std::chrono::duration<double>(done.back().first - done[first].first).count();
  if (trials > 0 && seconds > 0) {
    status.rate = static_cast<double>(trials) / seconds;
    status.secondsLeft = static_cast<double>(status.trials - status.trialsDone) / status.rate;
  }
  return status;
}

}  // namespace reachlab::study
