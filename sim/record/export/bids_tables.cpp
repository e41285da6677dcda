#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "base/table_text.h"
#include "base/text_file.h"
#include "sim/record/export/bids.h"
#include "sim/record/export/tidy_csv.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/whole_file.h"

namespace reachlab::record {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kReadme = R"(# Reaching with simulated objects

Recorded with reachlab. One run is one block, recorded continuously; trials are the rows of the events files, with their outcome. The
raw logs lie in `sourcedata/`: `reach export` writes every file here again from them, and `reach replay` simulates every run again, bit for
bit.

What was moved and asked (masses in kg, springs in N/m, coupling, the constraint's formula, start, target, duration, tolerances), with which
device and method, is in `code/experiments/`, a file a run: `experiment` there is an experiment file for `reach run`. `TaskDescription` in
`motion.json` says it in words.

Positions are in metres in one right-handed frame: x to the subject's right, y up, z towards the subject. `latency` is the time of the
protocol and the physics in ticks of 1 ms; `measured_time` is the computer's clock. Both count from the first sample, as `onset` does in the
events files. Forces are MISC channels in newtons.
)";

// A table that a person may have added rows and columns to: what is there stays, what is new or was unknown is filled in.
class KeptTable {
 public:
  KeptTable(std::string path, std::vector<std::string> columns) : path_(std::move(path)) {
    if (isThere(path_)) table_ = parseTsv(readWholeFile(path_));
    for (const std::string& column : columns)
      if (std::find(table_.columns.begin(), table_.columns.end(), column) == table_.columns.end()) {
        table_.columns.push_back(column);
        for (auto& row : table_.rows) row.emplace_back("n/a");
      }
  }

  /// Cells of the row whose first cell is `key`.
  void set(const std::string& key, const std::map<std::string, std::string>& cells) {
    auto row = std::find_if(table_.rows.begin(), table_.rows.end(), [&](const auto& r) { return r[0] == key; });
    if (row == table_.rows.end()) {
      table_.rows.emplace_back(table_.columns.size(), "n/a");
      row = std::prev(table_.rows.end());
      (*row)[0] = key;
    }
    for (std::size_t i = 1; i < table_.columns.size(); ++i) {
      const auto cell = cells.find(table_.columns[i]);
      if (cell != cells.end() && !cell->second.empty() && (*row)[i] == "n/a") (*row)[i] = cell->second;
    }
  }

  std::string write() {
    std::stable_sort(table_.rows.begin(), table_.rows.end(), [](const auto& a, const auto& b) { return a[0] < b[0]; });
    writeFileAtomically(path_, toText(table_));
    return path_;
  }

 private:
  std::string path_;
  TsvTable table_;
};

std::string descriptionJson(const std::string& version) {
  Json j = Json::object();
  j["Name"] = "Reaching with simulated objects";
  j["BIDSVersion"] = "1.9.0";
  j["DatasetType"] = "raw";
  j["License"] = "n/a";
  j["Authors"] = {"n/a"};
  j["Acknowledgements"] = "n/a";
  j["HowToAcknowledge"] = "n/a";
  j["Funding"] = {"n/a"};
  j["EthicsApprovals"] = {"n/a"};
  j["ReferencesAndLinks"] = {"n/a"};
  j["DatasetDOI"] = "n/a";
  j["GeneratedBy"] = Json::array({{{"Name", "reachlab"}, {"Version", version.empty() ? "n/a" : version}}});
  return j.dump(2) + "\n";
}

std::string participantsJson() {
  Json j = Json::object();
  j["age"] = {{"Description", "Age of the participant"}, {"Units", "years"}};
  j["sex"] = {{"Description", "Sex as reported by the participant"}, {"Levels", {{"F", "female"}, {"M", "male"}, {"O", "other"}}}};
  j["handedness"] = {{"Description", "Handedness as reported by the participant"},
                     {"Levels", {{"R", "right"}, {"L", "left"}, {"A", "ambidextrous"}}}};
  return j.dump(2) + "\n";
}

// BIDS gives times without a zone.
std::string acquisitionTime(const RunConfiguration& c) {
  const bool zone = !c.startedUtc.empty() && c.startedUtc.back() == 'Z';
  return zone ? c.startedUtc.substr(0, c.startedUtc.size() - 1) : c.startedUtc;
}

std::map<std::string, std::string> cellsOf(const Participant& p) {
  return {{"age", p.age ? fmt::format("{}", *p.age) : ""}, {"sex", p.sex}, {"handedness", p.handedness}};
}

}  // namespace

std::vector<std::string> keptOfParticipant(const std::string& folder, const std::string& subject, const Participant& participant) {
  const std::string path = folder + "/participants.tsv";
  std::vector<std::string> kept;
  if (!isThere(path)) return kept;
  const TsvTable table = parseTsv(readWholeFile(path));
  const std::map<std::string, std::string> now = cellsOf(participant);
  for (const auto& row : table.rows)
    for (std::size_t i = 1; i < table.columns.size() && row[0] == "sub-" + subject; ++i)
      if (const auto cell = now.find(table.columns[i]);
          cell != now.end() && !cell->second.empty() && row[i] != "n/a" && row[i] != cell->second)
        kept.push_back(fmt::format("{} has the {} {} for sub-{} and keeps it: {} is recorded in the log alone", path, cell->first, row[i],
                                   subject, cell->second));
  return kept;
}

std::vector<std::string> writeBidsTables(const std::vector<RunConfiguration>& runs, const std::string& folder) {
  std::vector<std::string> written;
  const auto writeIfNew = [&](const std::string& name, const std::string& text) {
    const std::string path = folder + "/" + name;
    if (isThere(path)) return;
    writeFileAtomically(path, text);
    written.push_back(path);
  };
  if (runs.empty()) return written;
  writeIfNew("dataset_description.json", descriptionJson(runs.back().softwareVersion));
  writeIfNew("README.md", kReadme);
  writeIfNew("participants.json", participantsJson());

  KeptTable participants(folder + "/participants.tsv", {"participant_id", "age", "sex", "handedness"});
  std::map<std::string, KeptTable> sessions, scans;
  for (const RunConfiguration& c : runs) {
    const std::string subject = "sub-" + c.subject, session = "ses-" + c.session;
    participants.set(subject, cellsOf(c.participant));
    const std::string sessionsFile = fmt::format("{}/{}/{}_sessions.tsv", folder, subject, subject);
    sessions.try_emplace(sessionsFile, sessionsFile, std::vector<std::string>{"session_id", "acq_time"})
        .first->second.set(session, {{"acq_time", acquisitionTime(c)}});
    const std::string scansFile = fmt::format("{}/{}/{}/{}_{}_scans.tsv", folder, subject, session, subject, session);
    KeptTable& ofSession = scans.try_emplace(scansFile, scansFile, std::vector<std::string>{"filename", "acq_time"}).first->second;
    for (int hand = 1; hand <= c.table.hands; ++hand)
      ofSession.set(motionPath(c, hand) + "_motion.tsv", {{"acq_time", acquisitionTime(c)}});
  }
  written.push_back(participants.write());
  for (auto& [path, table] : sessions) written.push_back(table.write());
  for (auto& [path, table] : scans) written.push_back(table.write());
  return written;
}

std::vector<std::string> writeBids(const std::vector<RunLog>& runs, const std::string& folder) {
  std::vector<std::string> written;
  std::vector<RunConfiguration> configurations;
  for (const RunLog& run : runs) {
    const std::vector<std::string> files = writeBidsRun(run, folder);
    written.insert(written.end(), files.begin(), files.end());
    configurations.push_back(run.configuration());
  }
  const std::vector<std::string> tables = writeBidsTables(configurations, folder);
  written.insert(written.end(), tables.begin(), tables.end());
  return written;
}

}  // namespace reachlab::record
