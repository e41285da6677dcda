#include <fmt/format.h>
#include <unistd.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/at_option.h"
#include "cli/commands.h"
#include "cli/criterion_option.h"
#include "base/error.h"
#include "sim/analyze/tables.h"
#include "sim/analyze/wording.h"
#include "sim/analyze/write_analysis.h"

namespace reachlab::cli {
namespace {

struct AnalyzeOptions {
  std::string dataset, out, experiment, onset = "percent", duration = "auto";
  std::vector<std::string> criteria;
  double percent = 5, speed = 0.01, cutoff = 10, handMass = -1, handDamping = 0;
  int resamples = 2000, bin = 10;
  std::uint64_t seed = 1;
  bool includePractice = false, json = false;
};

analyze::StudyOptions studyOptions(const AnalyzeOptions& o) {
  analyze::StudyOptions s;
  s.measure.cutoff = o.cutoff;
  s.measure.onset.percent = o.percent;
  s.measure.onset.speed = o.speed;
  s.measure.onset.rule = o.onset == "absolute" ? analyze::OnsetRule::Absolute
                         : o.onset == "task"   ? analyze::OnsetRule::Task
                                               : analyze::OnsetRule::Percent;
  s.includePractice = o.includePractice;
  s.predictFor = o.duration == "task"   ? analyze::PredictionDuration::Task
                 : o.duration == "mean" ? analyze::PredictionDuration::Moved
                                        : analyze::PredictionDuration::Auto;
  s.ranking.resamples = o.resamples;
  s.ranking.seed = o.seed;
  s.learningBin = o.bin;
  if (o.handMass >= 0) s.handMass = o.handMass;
  s.handDamping = o.handDamping;
  for (const std::string& name : o.criteria) s.criteria.push_back(parseCriterion(name));
  return s;
}

nlohmann::ordered_json jsonOf(const analyze::Ranking& ranking, const std::vector<predict::Criterion>& criteria) {
  auto places = nlohmann::ordered_json::array();
  for (const analyze::RankedCriterion& p : ranking.places)
    places.push_back({{"criterion", predict::nameOf(criteria[p.criterion])},
                      {"epsilon_m_per_s", p.epsilon},
                      {"epsilon_interval_m_per_s", {p.interval.low, p.interval.high}},
                      {"difference_m_per_s", p.difference},
                      {"difference_interval_m_per_s", {p.differenceInterval.low, p.differenceInterval.high}},
                      {"apart_from_first", p.apartFromFirst}});
  auto ties = nlohmann::ordered_json::array();
  for (const auto& [i, j] : ranking.ties)
    ties.push_back({predict::nameOf(criteria[ranking.places[i].criterion]), predict::nameOf(criteria[ranking.places[j].criterion])});
  return {{"decided", ranking.decided()},
          {"trials", ranking.trials},
          {"subjects", ranking.subjects},
          {"places", places},
          {"not_told_apart", ties}};
}

std::string summaryJson(const analyze::StudyResult& study, const analyze::Dataset& dataset, const analyze::AnalysisFiles& files) {
  nlohmann::ordered_json j;
  j["report"] = files.report;
  j["tables"] = files.tables;
  j["figures"] = files.figures;
  j["runs"] = dataset.runs.size();
  j["notes"] = dataset.notes;
  j["conditions"] = nlohmann::ordered_json::array();
  for (std::size_t c = 0; c < study.conditions.size(); ++c) {
    const analyze::ConditionResult& r = study.results[c];
    nlohmann::ordered_json condition{{"name", study.conditions[c].name},    {"success", r.counts.success},
                                     {"failure", r.counts.failure},         {"aborted", r.counts.aborted},
                                     {"interrupted", r.counts.interrupted}, {"used", r.used}};
    if (r.used > 0) condition["mean_duration_s"] = r.duration.mean;
    condition["hand_ranking"] = jsonOf(r.handRanking, analyze::criteriaOf(r));
    condition["object_ranking"] = jsonOf(r.objectRanking, analyze::criteriaOf(r));
    if (r.handOverSubjects) condition["hand_ranking_over_subjects"] = jsonOf(*r.handOverSubjects, analyze::criteriaOf(r));
    j["conditions"].push_back(condition);
  }
  j["overall"] = jsonOf(study.overall, study.common);
  if (study.overallOverSubjects) j["overall_over_subjects"] = jsonOf(*study.overallOverSubjects, study.common);
  return j.dump(2) + "\n";
}

void printSummary(const analyze::StudyResult& study, const analyze::Dataset& dataset, const analyze::AnalysisFiles& files) {
  for (const std::string& note : dataset.notes) fmt::print(stderr, "note: {}\n", note);
  for (std::size_t c = 0; c < study.conditions.size(); ++c) {
    const analyze::ConditionResult& r = study.results[c];
    fmt::print("{}: {}\n", study.conditions[c].name, analyze::describeCounts(r));
    if (r.used > 0) fmt::print("  hand: {}\n", analyze::describeRanking(r.handRanking, analyze::criteriaOf(r)));
    const std::string durations = analyze::describeDurations(r);
    if (!durations.empty()) fmt::print("  {}\n", durations);
  }
  if (study.conditions.size() > 1 && !study.overall.places.empty()) {
    fmt::print("all conditions, over trials: {}\n", analyze::describeRanking(study.overall, study.common));
    if (study.overallOverSubjects)
      fmt::print("all conditions, over subjects: {}\n", analyze::describeRanking(*study.overallOverSubjects, study.common));
  }
  fmt::print("{} tables, {} figures and {}\n", files.tables.size(), files.figures.size(), files.report);
}

void run(const AnalyzeOptions& o) {
  const analyze::StudyOptions options = studyOptions(o);  // refused before hours of reading
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const auto progress = [terminal](const char* what, std::size_t done, std::size_t of) {
    if (terminal && of > 0) fmt::print(stderr, "\r{} {} of {} \033[K{}", what, done, of, done == of ? "\n" : "");
  };
  analyze::Dataset dataset = analyze::openDataset(
      o.dataset, o.experiment, [&](std::size_t done, std::size_t of, const std::string&) { progress("reading run", done + 1, of); });
  const analyze::StudyResult study = analyze::analyzeStudy(
      std::move(dataset.input), options, [&](std::size_t done, std::size_t of) { progress("measuring trial", done, of); });
  std::string folder = o.dataset;
  while (folder.size() > 1 && folder.back() == '/') folder.pop_back();
  const analyze::ReportHeader header{folder, REACHLAB_VERSION, "reach analyze " + o.dataset};
  const analyze::AnalysisFiles files = atOption(
      "--out", [&] { return analyze::writeAnalysis(study, dataset, header, o.out.empty() ? folder + "/derivatives/reachlab" : o.out); });
  if (o.json) fmt::print("{}", summaryJson(study, dataset, files));
  else printSummary(study, dataset, files);
}

}  // namespace

void addAnalyzeCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("analyze", "Tables (CSV), figures (SVG, PDF) and a report (HTML) of recorded sessions");
  const auto o = std::make_shared<AnalyzeOptions>();
  command->add_option("dataset", o->dataset, "Data folder of `reach run`, a session's folder in it, or one log")->required();
  command->add_option("--out", o->out, "Folder to write to (default: DATASET/derivatives/reachlab)");
  command
      ->add_option("--criterion", o->criteria, "Criterion to compare with; repeat for more (default: all that are defined for the object)")
      ->allow_extra_args(false);
  command->add_option("--hand-mass", o->handMass, "Mass of the hand in the predictions [kg] (default: the experiment's)")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--hand-damping", o->handDamping, "Damping of the hand in the predictions [N s/m]")->check(CLI::NonNegativeNumber);
  command
      ->add_option("--prediction-duration", o->duration,
                   "Predict for the task's T, for the mean duration moved, or (auto) for the task's where trials kept to it within 10 %")
      ->check(CLI::IsMember({"auto", "task", "mean"}))
      ->capture_default_str();
  command->add_option("--onset", o->onset, "Rule for onset and offset of a movement")
      ->check(CLI::IsMember({"percent", "absolute", "task"}))
      ->capture_default_str();
  command->add_option("--onset-percent", o->percent, "Share of the trial's peak speed [%]")->capture_default_str();
  command->add_option("--onset-speed", o->speed, "Speed for --onset absolute [m/s]")->capture_default_str();
  command->add_option("--cutoff", o->cutoff, "Zero-lag Butterworth on the hand's velocity [Hz], 0: none")->capture_default_str();
  command->add_option("--resamples", o->resamples, "Bootstrap resamples")->capture_default_str();
  command->add_option("--seed", o->seed, "Seed of the bootstrap")->capture_default_str();
  command->add_option("--learning-bin", o->bin, "Trials a point of the learning curve")->capture_default_str();
  command->add_option("--experiment", o->experiment, "Experiment of a dataset without logs (file or shipped name)");
  command->add_flag("--include-practice", o->includePractice, "Count practice blocks too");
  command->add_flag("--json", o->json, "Summary as JSON on stdout");
  command->footer(
      "Every number of a figure or of the report is in a CSV file; docs/analysis.md defines measures and columns. The same data and\n"
      "options give the same bytes.\n\n"
      "Examples:\n"
      "  reach analyze data\n"
      "  reach analyze data --out results --cutoff 12 --onset-percent 3\n"
      "  reach analyze data --hand-mass 1 --criterion min-hand-jerk --criterion min-hand-force-change --json");
  command->callback([o] { run(*o); });
}

}  // namespace reachlab::cli
