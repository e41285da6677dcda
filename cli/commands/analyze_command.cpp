#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "analysis/report/alternatives.h"
#include "analysis/report/wording.h"
#include "analysis/report/write_analysis.h"
#include "analysis/tables.h"
#include "base/as_number.h"
#include "base/error.h"
#include "base/fault.h"
#include "cli/commands/commands.h"
#include "cli/output/analysis_json.h"
#include "cli/output/progress_line.h"
#include "cli/terminal/analysis_plan.h"
#include "cli/terminal/at_option.h"
#include "cli/terminal/criterion_option.h"
#include "cli/terminal/option_words.h"
#include "sim/record/export/exporters.h"
#include "sim/session/session.h"

namespace reachlab::cli {
namespace {

struct AnalyzeOptions {
  std::string dataset, out, plan, experiment, onset = "percent", duration = "task", masses;
  std::vector<std::string> criteria;
  int recovery = 0, jobs = 0;
  std::uint64_t seed = 1;
  bool alternatives = false, json = false, progress = false;
  analysis::AnalysisOptions how;  // without what `analysisOptions` makes of the members above
};

std::vector<double> parseMasses(const std::string& text) {
  std::vector<double> masses;
  for (const std::string& part : partsBetweenCommas(text)) {
    const auto mass = asNumber<double>(part);
    if (!mass || !(*mass >= 0) || !std::isfinite(*mass))
      throw FaultError(Fault{"--hand-masses", "is " + text, "masses in kg, 0 or more, with commas between: 0,1,2,4,8"});
    masses.push_back(*mass);
  }
  return masses;
}

analysis::AnalysisOptions analysisOptions(const AnalyzeOptions& o) {
  analysis::AnalysisOptions s = o.how;
  s.measure.onset.rule = o.onset == "absolute" ? analysis::OnsetRule::Absolute
                         : o.onset == "task"   ? analysis::OnsetRule::Task
                                               : analysis::OnsetRule::Percent;
  s.predictFor = o.duration == "mean" ? analysis::PredictionDuration::Moved : analysis::PredictionDuration::Task;
  if (!o.masses.empty()) s.handMasses = parseMasses(o.masses);
  s.keepScatter = o.recovery > 0;
  for (const std::string& name : o.criteria) s.drawn.push_back(parseCriterion(name));
  return s;
}

void printRecovery(const analysis::TruthRecovery& recovery) {
  fmt::print("recovery: {} simulated studies a truth\n", recovery.studies);
  for (std::size_t t = 0; t < recovery.counts.size(); ++t) {
    fmt::print("  truth {}:", analysis::nameOfCandidate(recovery.candidates[t]));
    for (std::size_t k = 0; k < recovery.counts[t].size(); ++k)
      if (recovery.counts[t][k] > 0)
        fmt::print(" {} {}", recovery.counts[t][k],
                   k < recovery.candidates.size() ? analysis::nameOfCandidate(recovery.candidates[k]) : "undecided");
    fmt::print("\n");
  }
  for (const analysis::OtherTruth& o : recovery.others)
    fmt::print("  people with {}: {} named right, {} wrong ({}), {} undecided\n", o.name, o.right, o.wrong,
               analysis::shareText(o.wrong, o.studies()), o.undecided);
}

void printSummary(const analysis::Analysis& analysis, const analysis::DatasetIndex& dataset, const analysis::AnalysisFiles& files,
                  const std::optional<analysis::TruthRecovery>& recovery) {
  for (const std::string& note : dataset.notes) fmt::print(stderr, "note: {}\n", note);
  if (const std::string learning = analysis::describeLearning(analysis); !learning.empty()) fmt::print("{}\n", learning);
  fmt::print("{}\n", analysis::describeConclusion(analysis.overall, analysis.common));
  if (const std::string evidence = analysis::describeEvidence(analysis.overall, analysis.common); !evidence.empty())
    fmt::print("{}\n", evidence);
  if (const std::string over = analysis::describeTogether(analysis); !over.empty()) fmt::print("{}\n", over);
  for (std::size_t c = 0; c < analysis.conditions.size(); ++c) {
    const analysis::ConditionResult& r = analysis.results[c];
    fmt::print("{}: {}\n", analysis.conditions[c].name, analysis::describeCounts(r));
    if (analysis.conditions.size() > 1) fmt::print("  {}\n", analysis::describeConclusion(r.conclusion, analysis::namesOf(r.candidates)));
  }
  if (const std::string others = analysis::describeAlternatives(analysis); !others.empty()) fmt::print("{}\n", others);
  if (recovery) printRecovery(*recovery);
  fmt::print("{} tables, {} figures and {}\n", files.tables.size(), files.figures.size(), files.report);
}

/// The plan and every departure from it, a sentence each.
std::vector<std::string> describePlan(const AnalysisPlan& plan) {
  std::vector<std::string> sentences{fmt::format("Analysis plan: {} of {}, SHA-256 {}.", plan.file, plan.date, plan.sha256)};
  if (plan.departures.empty()) sentences.push_back("The analysis follows the plan.");
  for (const std::string& departure : plan.departures) sentences.push_back("Departure from the plan: " + departure);
  return sentences;
}

/// Every option that is not its default, so that the report can be made again.
std::string commandOf(const AnalyzeOptions& o) {
  const AnalyzeOptions usual;
  const analysis::OnsetOptions& onset = o.how.measure.onset;
  std::string text = "reach analyze " + o.dataset;
  const auto add = [&](bool changed, const std::string& words) { text += changed ? " " + words : ""; };
  for (const std::string& c : o.criteria) text += " --criterion " + c;
  add(o.how.handMass.has_value(), fmt::format("--hand-mass {}", o.how.handMass.value_or(0)));
  add(!o.masses.empty(), "--hand-masses " + o.masses);
  add(o.how.handDamping != 0, fmt::format("--hand-damping {}", o.how.handDamping));
  add(o.duration == "mean", "--prediction-duration mean");
  add(o.onset != usual.onset, "--onset " + o.onset);
  add(onset.percent != usual.how.measure.onset.percent, fmt::format("--onset-percent {}", onset.percent));
  add(onset.speed != usual.how.measure.onset.speed, fmt::format("--onset-speed {}", onset.speed));
  add(o.how.measure.cutoff != usual.how.measure.cutoff, fmt::format("--cutoff {}", o.how.measure.cutoff));
  add(o.how.learningBin != usual.how.learningBin, fmt::format("--learning-bin {}", o.how.learningBin));
  add(o.how.residuals, "--residuals");
  add(o.alternatives, "--alternatives");
  add(o.recovery > 0, fmt::format("--recovery {}", o.recovery));
  add(o.recovery > 0 && o.seed != usual.seed, fmt::format("--seed {}", o.seed));
  add(!o.experiment.empty(), "--experiment " + o.experiment);
  add(!o.plan.empty(), "--plan " + o.plan);
  add(o.how.includePractice, "--include-practice");
  return text;
}

void refuseWithoutEffect(const CLI::App& command, const AnalyzeOptions& o) {
  const struct {
    const char *option, *when;
    bool counts;
  } options[] = {{"--jobs", "without --recovery", o.recovery > 0},
                 {"--seed", "without --recovery", o.recovery > 0},
                 {"--hand-masses", "beside --hand-mass", !o.how.handMass},
                 {"--onset-percent", "without --onset percent", o.onset == "percent"},
                 {"--onset-speed", "without --onset absolute", o.onset == "absolute"}};
  for (const auto& [option, when, counts] : options)
    if (command.count(option) > 0 && !counts) throw FaultError(Fault{option, fmt::format("changes nothing {}", when)});
}

void run(CLI::App& command, const AnalyzeOptions& o) {
  std::optional<AnalysisPlan> plan;
  if (!o.plan.empty()) {
    plan = atOption("--plan", [&] { return readAnalysisPlan(o.plan); });
    applyPlan(command, *plan);  // changes o, and lists what it does not plan
  } else {
    refuseWithoutEffect(command, o);
  }
  const analysis::AnalysisOptions options = analysisOptions(o);  // refused before hours of reading
  ProgressLine line;
  const auto progress = [&line, told = o.progress || line.onTerminal()](const char* what, std::size_t done, std::size_t of) {
    if (!told) return;
    if (of > 0) line.tell(fmt::format("{} {} of {}", what, done, of));
    if (done == of) line.end();
  };
  analysis::AnalysisBuilder builder(options);
  const std::vector<analysis::Alternative> alternatives =
      o.alternatives ? analysis::alternativesTo(options) : std::vector<analysis::Alternative>{};
  std::vector<analysis::AnalysisBuilder> others;
  for (const analysis::Alternative& alternative : alternatives) others.emplace_back(alternative.options);
  const auto all = [&](auto&& tell) {
    for (analysis::AnalysisBuilder& other : others) tell(other);
    tell(builder);
  };
  const analysis::DatasetIndex dataset = analysis::readDataset(
      o.dataset,
      {[&](analysis::TrialData&& trial, std::size_t condition) {
         for (analysis::AnalysisBuilder& other : others) other.add(analysis::TrialData(trial), condition);
         builder.add(std::move(trial), condition);
       },
       [&] { all([](analysis::AnalysisBuilder& each) { each.beginRun(); }); },
       [&] { all([](analysis::AnalysisBuilder& each) { each.takeBackRun(); }); }},
      o.experiment, [&](std::size_t done, std::size_t of, const std::string&) { progress("reading run", done + 1, of); });
  if (!o.experiment.empty() && dataset.runs.front().isLog)
    throw FaultError(Fault{"--experiment", "changes nothing where the logs have their experiments", "no such option"});
  const auto fitting = [&](std::size_t done, std::size_t of) { progress("fitting trial", done, of); };
  analysis::Analysis analysis = builder.finish(dataset.conditions, fitting);
  std::vector<analysis::AlternativeConclusion> rows;
  for (std::size_t i = 0; i < others.size(); ++i) {
    progress("other choice", i + 1, others.size());
    const auto of = analysis::conclusionsOf(others[i].finish(dataset.conditions), alternatives[i].choice);
    rows.insert(rows.end(), of.begin(), of.end());
  }
  if (o.alternatives) analysis::addAlternatives(analysis, std::move(rows));
  std::optional<analysis::TruthRecovery> recovery;
  if (o.recovery > 0)
    recovery = analysis::recover(analysis, o.recovery, o.seed, static_cast<unsigned>(std::max(0, o.jobs)),
                                 [&](std::size_t done, std::size_t of) { progress("simulated study", done, of); });
  std::string folder = o.dataset;
  while (folder.size() > 1 && folder.back() == '/') folder.pop_back();
  if (plan) {
    std::vector<std::string> starts;
    for (const analysis::AnalysedRun& r : dataset.runs) starts.push_back(r.configuration.startedUtc);
    checkDate(*plan, starts);
  }
  const analysis::ReportHeader header{folder, REACHLAB_VERSION, commandOf(o), plan ? describePlan(*plan) : std::vector<std::string>{}};
  const std::string out = o.out.empty() ? analysis::analysisFolderOf(folder) : o.out;
  const analysis::AnalysisFiles files =
      atOption("--out", [&] { return analysis::writeAnalysis(analysis, dataset, header, out, recovery); });
  if (o.out.empty() && std::filesystem::is_directory(folder))
    record::describeDerivative(out, "Analysis of reaching movements", "reachlab " REACHLAB_VERSION);
  if (o.json) fmt::print("{}", summaryJson(analysis, dataset, files, recovery, plan));
  else
    for (const std::string& sentence : header.plan) fmt::print("{}\n", sentence);
  if (!o.json) printSummary(analysis, dataset, files, recovery);
  if (!dataset.unreadable.empty())
    throw ResourceError(fmt::format("{} of {} runs could not be read and are not in these results: {}", dataset.unreadable.size(),
                                    dataset.unreadable.size() + dataset.runs.size(), fmt::join(dataset.unreadable, "; ")));
}

}  // namespace

void addAnalyzeCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("analyze", "Tables (CSV), figures (SVG, PDF) and a report (HTML) of recorded sessions");
  const auto o = std::make_shared<AnalyzeOptions>();
  command->add_option("dataset", o->dataset, "Data folder of `reach run`, a session's folder in it, or one log")->required();
  command->add_option("--out", o->out,
                      "Folder to write to [default: " + analysis::analysisFolderOf("DATASET") + ", or beside a single log]");
  command
      ->add_option("--criterion", o->criteria,
                   "Draw this criterion and tell its ε; repeat for more. Every criterion is compared all the same [default: all]")
      ->allow_extra_args(false);
  command->add_option("--hand-mass", o->how.handMass, "Mass of the hand in the predictions [kg] [default: the experiment's]")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--hand-damping", o->how.handDamping, "Damping of the hand in the predictions [N s/m]")
      ->check(CLI::NonNegativeNumber);
  command->add_option(
      "--hand-masses", o->masses,
      "Masses of the hand [kg], with commas. The fits of (4) to (6) search between the least and the largest of them [default: "
      "0,1,2,4,8]");
  command
      ->add_option("--prediction-duration", o->duration,
                   "Paper's epsilon: predict for the task's T, or for the mean duration moved. The fits choose their own")
      ->check(CLI::IsMember({"task", "mean"}))
      ->capture_default_str();
  command->add_option("--onset", o->onset, "Rule for onset and offset of a movement")
      ->check(CLI::IsMember({"percent", "absolute", "task"}))
      ->capture_default_str();
  command->add_option("--onset-percent", o->how.measure.onset.percent, "Share of the trial's peak speed [%]")->capture_default_str();
  command->add_option("--onset-speed", o->how.measure.onset.speed, "Speed for --onset absolute [m/s]")->capture_default_str();
  command->add_option("--cutoff", o->how.measure.cutoff, "Zero-lag Butterworth on the hand's velocity [Hz], 0: none")
      ->capture_default_str();
  command->add_flag("--residuals", o->how.residuals,
                    "Write residuals.csv too: velocity, weight and the residual of every candidate at every sample of the fits");
  command->add_flag("--alternatives", o->alternatives,
                    "Analyse again with each of some other choices (cut-off, onset, hand masses, failed trials, criteria), and say which "
                    "conclusions change. Takes about 15 times as long");
  command
      ->add_option("--recovery", o->recovery,
                   "Simulate that many studies of this very design for each truth, and say how often each is named (all processors)")
      ->check(CLI::Range(1, 100000));
  command->add_option("--jobs", o->jobs, "Threads of the recovery [default: one per processor]")->check(CLI::PositiveNumber);
  command->add_option("--seed", o->seed, "Seed of the recovery")->check(CLI::Validator(session::seedFault, "SEED"))->capture_default_str();
  command->add_option("--learning-bin", o->how.learningBin, "Trials a point of the learning curve")->capture_default_str();
  command->add_option("--experiment", o->experiment, "Experiment of a dataset without logs (file or shipped name)");
  command->add_option(
      "--plan", o->plan,
      "Analysis plan (JSON): options that were chosen before the data. The report names the plan and every departure from it");
  command->add_flag("--include-practice", o->how.includePractice, "Count practice blocks too");
  command->add_flag("--progress", o->progress, "Write progress to a log or a pipe too");
  command->add_flag("--json", o->json, "Summary as JSON on stdout");
  command->footer(
      "Every number of a figure or of the report is in a CSV file; docs/analysis.md defines measures and columns. The same data and\n"
      "options give the same bytes.\n\n"
      "Examples:\n"
      "  reach analyze data\n"
      "  reach analyze data --out results --cutoff 12 --onset-percent 3\n"
      "  reach analyze data --recovery 20\n"
      "  reach analyze data --alternatives\n"
      "  reach analyze data --plan analysis-plan.json\n"
      "  reach analyze data --hand-mass 1 --criterion min-hand-jerk --criterion min-hand-force-change --json");
  command->callback([o, command] { run(*command, *o); });
}

}  // namespace reachlab::cli
