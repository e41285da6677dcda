#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/fault.h"
#include "cli/commands/commands.h"
#include "cli/output/json_text.h"
#include "cli/output/readable_logs.h"
#include "cli/output/trial_line.h"
#include "cli/output/trial_profile.h"
#include "cli/terminal/at_option.h"
#include "sim/record/export/tidy_csv.h"
#include "sim/record/log/append_file.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/run_log.h"
#include "sim/record/log/trial_measures.h"

namespace reachlab::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ShowOptions {
  std::string what, figure;
  int trial = 0;
  bool json = false;
};

int countOf(const record::RunLog& log, trial::Outcome outcome) {
  return static_cast<int>(std::count_if(log.trials().begin(), log.trials().end(),
                                        [&](const auto& trial) { return trial.result.outcome == outcome && !trial.planned.catchTrial; }));
}

std::string stateOf(const record::RunLog& log) {
  if (record::isBeingWritten(log.path())) return "being recorded";
  if (log.goodBytes() < log.fileBytes()) return "damaged";
  return log.closed() ? "whole" : "broken off";
}

// Columns as wide as their longest cell, two blanks between; numbers to the right.
std::string alignedTable(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) {
      const bool isNumber = &row != &rows.front() && !row[k].empty() && row[k].find_first_not_of("0123456789.-") == std::string::npos;
      line += (k > 0 ? "  " : "") + (isNumber ? fmt::format("{:>{}}", row[k], widths[k]) : fmt::format("{:<{}}", row[k], widths[k]));
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string rounded(double value, int digits) { return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : std::string(); }

std::string runsTable(const std::vector<record::RunLog>& logs) {
  std::vector<std::vector<std::string>> rows{{"subject", "session", "run", "block", "condition", "phase", "trials", "catch", "success",
                                              "failure", "aborted", "interrupted", "device", "started_utc", "log"}};
  for (const record::RunLog& log : logs) {
    const record::RunConfiguration& c = log.configuration();
    rows.push_back(
        {c.subject, c.session, std::to_string(c.run), std::to_string(c.block), record::conditionOf(c), c.practice ? "practice" : "recorded",
         std::to_string(log.trials().size()),
         std::to_string(std::count_if(log.trials().begin(), log.trials().end(), [](const auto& t) { return t.planned.catchTrial; })),
         std::to_string(countOf(log, trial::Outcome::Success)), std::to_string(countOf(log, trial::Outcome::Failure)),
         std::to_string(countOf(log, trial::Outcome::Aborted)), std::to_string(countOf(log, trial::Outcome::Interrupted)), c.device,
         c.startedUtc.substr(0, 19), stateOf(log)});
  }
  return alignedTable(rows);
}

std::string trialsTable(const record::RunLog& log) {
  struct Shown {
    std::string_view measure;
    int digits;
  };
  static constexpr Shown kShown[] = {
      {"movement_time_s", 3}, {"task_reaction_time_s", 3}, {"peak_hand_speed_m_per_s", 3}, {"peak_force_n", 2}, {"clamped_ticks", 0}};
  const record::RunConfiguration& c = log.configuration();
  std::vector<std::vector<std::string>> rows{{"trial", "outcome", "reason", "mass", "by", ""}};
  if (c.scenes) rows.front().insert(rows.front().begin() + 1, {"kind", "target"});
  for (const Shown& shown : kShown) rows.front().emplace_back(shown.measure);
  for (const record::RecordedTrial& t : log.trials()) {
    const bool success = t.result.outcome == trial::Outcome::Success;
    rows.push_back({std::to_string(t.trial), std::string(trial::nameOf(t.result.outcome)) + (t.planned.catchTrial ? " (catch)" : ""),
                    success ? "" : std::string(trial::nameOf(t.result.reason)), t.result.mass > 0 ? std::to_string(t.result.mass) : "",
                    t.result.by != 0 ? rounded(t.result.by, 4) : "", t.result.by != 0 ? record::unitOf(t.result.reason) : ""});
    if (const record::RunScene* scene = record::sceneOf(c, t.planned))
      rows.back().insert(rows.back().begin() + 1, {scene->kind, scene->target});
    for (const Shown& shown : kShown) rows.back().push_back(rounded(record::tickMeasure(shown.measure).of(t), shown.digits));
  }
  return alignedTable(rows);
}

Json trialJson(const record::RunLog& log, const record::RecordedTrial& t) {
  const record::TrialTimes times = record::timesOf(t, log.firstSampleTick());
  const record::RunScene* scene = record::sceneOf(log.configuration(), t.planned);
  Json json{{"trial", t.trial},
            {"condition", record::conditionOf(log.configuration(), t.planned)},
            {"kind", scene != nullptr ? Json(scene->kind) : Json()},
            {"target", scene != nullptr ? Json(scene->target) : Json()},
            {"catch_trial", t.planned.catchTrial},
            {"outcome", trial::nameOf(t.result.outcome)},
            {"reason", trial::nameOf(t.result.reason)},
            {"by_unit", record::unitOf(t.result.reason)},
            {"start_s", times.start},
            {"armed_s", times.armed},
            {"go_s", times.go},
            {"task_onset_s", times.onset},
            {"end_s", times.end},
            {"complete", t.complete}};
  for (const record::TickMeasure& measure : record::tickMeasures()) {
    const double value = measure.of(t);
    Json& out = json[std::string(measure.name)];
    if (measure.count && std::isfinite(value)) out = static_cast<std::int64_t>(value);
    else out = value;
  }
  return json;
}

Json runJson(const record::RunLog& log) {
  const record::RunConfiguration& c = log.configuration();
  Json trials = Json::array();
  for (const record::RecordedTrial& t : log.trials()) trials.push_back(trialJson(log, t));
  return {{"log", log.path()},
          {"state", stateOf(log)},
          {"subject", c.subject},
          {"session", c.session},
          {"run", c.run},
          {"block", c.block},
          {"condition", record::conditionOf(c)},
          {"practice", c.practice},
          {"experiment", c.experimentName},
          {"device", c.device},
          {"method", c.method},
          {"seed", c.sessionSeed},
          {"started_utc", c.startedUtc},
          {"software", c.softwareVersion},
          {"trials", trials}};
}

const record::RecordedTrial& trialOf(const std::vector<record::RunLog>& logs, int number) {
  if (logs.size() != 1)
    throw FaultError(Fault{"--trial", fmt::format("there are {} runs here", logs.size()), "the log of one run, such as " + logs[0].path()});
  const std::vector<record::RecordedTrial>& trials = logs[0].trials();
  const auto found = std::find_if(trials.begin(), trials.end(), [&](const auto& t) { return t.trial == number; });
  if (found != trials.end()) return *found;
  if (trials.empty()) throw FaultError(Fault{"--trial", logs[0].path() + " has no trials"});
  throw FaultError(Fault{"--trial", fmt::format("is {}", number), fmt::format("{} to {}", trials.front().trial, trials.back().trial)});
}

void showTrial(const record::RunLog& log, const record::RecordedTrial& trial, bool asJson) {
  const ShownTrial profile = profileOf(log, trial);
  const char* timeColumn = profile.sinceOnset ? "since_onset_s" : "since_start_s";
  if (asJson) {
    Json json = trialJson(log, trial);
    json["samples"] = {{timeColumn, profile.time},
                       {"hand_speed_m_per_s", profile.handSpeed},
                       {"first_mass_speed_m_per_s", profile.firstSpeed},
                       {"last_mass_speed_m_per_s", profile.lastSpeed},
                       {"coupling_force_n", profile.force}};
    fmt::print("{}", jsonText(json));
    return;
  }
  fmt::print("{}\n", trialLine(trial.trial, trial.result, record::sceneOf(log.configuration(), trial.planned)));
  std::vector<std::vector<std::string>> rows{
      {timeColumn, "hand_speed_m_per_s", "first_mass_speed_m_per_s", "last_mass_speed_m_per_s", "coupling_force_n"}};
  for (std::size_t i = 0; i < profile.time.size(); ++i)
    rows.push_back({rounded(profile.time[i], 3), rounded(profile.handSpeed[i], 4), rounded(profile.firstSpeed[i], 4),
                    rounded(profile.lastSpeed[i], 4), rounded(profile.force[i], 3)});
  fmt::print("{}", alignedTable(rows));
}

void show(const ShowOptions& options) {
  if (!options.figure.empty() && options.trial == 0) throw FaultError(Fault{"--figure", "draws one trial", "beside --trial N"});
  const ReadableLogs readable = openReadableLogs(options.what);
  const std::vector<record::RunLog>& logs = readable.runs;
  if (options.trial > 0) {
    const record::RecordedTrial& trial = trialOf(logs, options.trial);
    if (!options.figure.empty())
      atOption("--figure",
               [&] { record::writeFileAtomically(options.figure, figure::renderFor(options.figure, drawTrial(logs[0], trial))); });
    if (options.figure.empty() || options.json) showTrial(logs[0], trial, options.json);
    return;
  }
  if (options.json) {
    Json runs = Json::array();
    for (const record::RunLog& log : logs) runs.push_back(runJson(log));
    fmt::print("{}", jsonText(runs));
  } else {
    fmt::print("{}", runsTable(logs));
    if (logs.size() == 1) fmt::print("\n{}", trialsTable(logs[0]));
  }
  readable.tellUnreadable();
}

}  // namespace

void addShowCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("show", "What was recorded: sessions, runs, trials; one trial as a table or a figure");
  const auto options = std::make_shared<ShowOptions>();
  command->add_option("what", options->what, "A dataset, a session's folder (data/sub-01/ses-01), or a log (…_log.reach)")->required();
  command->add_option("--trial", options->trial, "Shows this trial of a log, sample by sample")->check(CLI::Range(1, 1000000));
  command->add_option("--figure", options->figure, "Draws the trial's speeds and force: FILE.svg, FILE.pdf or FILE.png");
  command->add_flag("--json", options->json, "The same as JSON, numbers unrounded");
  command->footer(
      "Numbers are rounded for reading; reach export has them in full. Of several runs one line each, of a log its trials too.\n\n"
      "Examples:\n"
      "  reach show data\n"
      "  reach show data/sourcedata/sub-01_ses-01_task-chainmoderate_run-01_log.reach\n"
      "  reach show data/sourcedata/sub-01_ses-01_task-chainmoderate_run-01_log.reach --trial 3 --figure trial-3.svg");
  command->callback([options] { show(*options); });
}

}  // namespace reachlab::cli
