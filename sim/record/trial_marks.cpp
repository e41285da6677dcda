#include "sim/record/trial_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "base/json/json_reader.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/log.h"
#include "sim/record/log/whole_file.h"

namespace reachlab::record {
namespace {

constexpr int kMostTrials = 10'000'000;
const NumberRange kSinceArming{0, 1e6, true, "a time in s, 0 or more"};

TrialMark readMark(FaultList& faults, const JsonNode& node, std::size_t index) {
  TrialMark mark;
  ObjectReader reader(faults, node, fmt::format("trials[{}]", index));
  if (reader.required("trial", "the number of a trial") != nullptr) reader.integer("trial", 1, kMostTrials, mark.trial);
  reader.boolean("flagged", mark.flagged);
  if (const JsonNode* excluded = reader.optional("excluded");
      excluded != nullptr && excluded->kind == JsonNode::Kind::String && excluded->string.empty())
    faults.add(*excluded, reader.keyPath("excluded"), "is empty", "the reason, or no such key");
  reader.text("excluded", mark.excluded);
  reader.text("note", mark.note);
  const auto time = [&](const char* key, std::optional<double>& value) {
    if (reader.optional(key) == nullptr) return;
    double seconds = 0;
    reader.number(key, kSinceArming, seconds);
    value = seconds;
  };
  time("onset_s", mark.onset);
  time("offset_s", mark.offset);
  if (mark.onset && mark.offset && !(*mark.onset < *mark.offset))
    faults.add(node, reader.keyPath("offset_s"), "is not after onset_s", "a later time");
  reader.finish();
  return mark;
}

}  // namespace

const TrialMark* RunMarks::find(int trial) const {
  const auto found = std::lower_bound(trials.begin(), trials.end(), trial, [](const TrialMark& m, int t) { return m.trial < t; });
  return found != trials.end() && found->trial == trial ? &*found : nullptr;
}

void RunMarks::set(const TrialMark& mark) {
  auto place = std::lower_bound(trials.begin(), trials.end(), mark.trial, [](const TrialMark& m, int t) { return m.trial < t; });
  if (place != trials.end() && place->trial == mark.trial) place = trials.erase(place);
  if (!mark.empty()) trials.insert(place, mark);
}

std::string marksPathOf(const std::string& logPath) {
  constexpr std::string_view kLogs[] = {kLogEnding, ".reach"};
  for (const std::string_view ending : kLogs)
    if (logPath.ends_with(ending)) return logPath.substr(0, logPath.size() - ending.size()) + "_marks.json";
  return logPath + "_marks.json";
}

namespace {

// `trials`: those of the run, where only they may be named.
RunMarks readMarks(const std::string& logPath, const std::vector<RecordedTrial>* trials) {
  const std::string file = marksPathOf(logPath);
  std::error_code error;
  RunMarks marks;
  std::set<int> seen;
  if (!std::filesystem::exists(file, error)) return marks;
  const std::string text = readWholeFile(file);
  const JsonNode root = parseJson(text, file);
  FaultList faults(file);
  ObjectReader reader(faults, root, "");
  double version = 1;
  reader.requiredNumber("schema_version", {1, 1, true, "1, the version that this program reads"}, version);
  const auto check = [&](int trial, const JsonNode& at, const std::string& key) {
    const auto isIt = [&](const RecordedTrial& t) { return t.trial == trial; };
    if (!seen.insert(trial).second) faults.add(at, key, fmt::format("is {} for the second time", trial), "each trial once");
    else if (trials != nullptr && std::none_of(trials->begin(), trials->end(), isIt))
      faults.add(at, key, fmt::format("is {}, which the run does not have", trial),
                 trials->empty() ? "no marks, because the run has no trials"
                                 : fmt::format("{} to {}", trials->front().trial, trials->back().trial));
  };
  if (const JsonNode* list = reader.required("trials", "an array of marks")) {
    if (list->kind != JsonNode::Kind::Array) faults.add(*list, "trials", "is no array", "an array of marks");
    for (std::size_t i = 0; i < list->items.size(); ++i) {
      const TrialMark mark = readMark(faults, list->items[i], i);
      if (mark.trial > 0) check(mark.trial, *list->items[i].find("trial"), fmt::format("trials[{}].trial", i));
      marks.set(mark);
    }
  }
  reader.finish();
  faults.throwIfAny();
  return marks;
}

}  // namespace

RunMarks readMarks(const std::string& logPath) { return readMarks(logPath, nullptr); }
RunMarks readMarks(const RunLog& run) { return readMarks(run.path(), &run.trials()); }

void writeMarks(const std::string& logPath, const RunMarks& marks) {
  const std::string file = marksPathOf(logPath);
  if (marks.trials.empty()) {
    std::error_code error;
    std::filesystem::remove(file, error);
    if (error) throw ResourceError(fmt::format("{}: cannot be removed: {}", file, error.message()));
    return;
  }
  nlohmann::ordered_json trials = nlohmann::ordered_json::array();
  for (const TrialMark& mark : marks.trials) {
    nlohmann::ordered_json one{{"trial", mark.trial}};
    if (mark.flagged) one["flagged"] = true;
    if (!mark.excluded.empty()) one["excluded"] = mark.excluded;
    if (mark.onset) one["onset_s"] = *mark.onset;
    if (mark.offset) one["offset_s"] = *mark.offset;
    if (!mark.note.empty()) one["note"] = mark.note;
    trials.push_back(one);
  }
  writeFileAtomically(file, nlohmann::ordered_json{{"schema_version", 1}, {"trials", trials}}.dump(1) + "\n");
}

}  // namespace reachlab::record
