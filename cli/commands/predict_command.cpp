#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <iostream>
#include <memory>

#include "base/fault.h"
#include "base/json/json_reader.h"
#include "base/number_range.h"
#include "cli/commands/commands.h"
#include "cli/output/predict_output.h"
#include "cli/output/progress_line.h"
#include "cli/terminal/criterion_option.h"
#include "sim/experiment/checked_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/tested_ranges.h"
#include "sim/record/log/atomic_file.h"

namespace reachlab::cli {
namespace {

constexpr int kMostSamples = 1'000'000;

struct PredictArguments {
  std::string experiment, criterion, point, sweep, out, figure;
  int samples = 201;
  bool json = false, time = false;
  predict::PredictOptions options;  // without its point, which `runPredict` takes from the name
};

void writeText(const std::string& text, const std::string& path) {
  if (path.empty()) {
    std::cout << text << std::flush;
    return;
  }
  record::writeFileAtomically(path, text);
}

void writeFigure(const figure::Figure& figure, const std::string& path) {
  record::writeFileAtomically(path, figure::renderFor(path, figure));
}

// Median of repeated computations, on stderr: a figure for the machine at hand.
void reportTime(const experiment::CompiledExperiment& experiment, predict::Criterion criterion, const predict::PredictOptions& options) {
  constexpr int kRuns = 21;
  std::vector<double> microseconds;
  for (int i = 0; i < kRuns; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    predict::predict(experiment, criterion, options);
    microseconds.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
  }
  std::nth_element(microseconds.begin(), microseconds.begin() + kRuns / 2, microseconds.end());
  std::cerr << fmt::format("computed in {:.0f} us (median of {})\n", microseconds[kRuns / 2], kRuns);
}

// A prediction on a thread of its own; who waits longer than a moment is told so, on a terminal.
std::unique_ptr<predict::Prediction> predictPatiently(const experiment::CompiledExperiment& experiment, predict::Criterion criterion,
                                                      const predict::PredictOptions& options) {
  using namespace std::chrono_literals;
  const auto begin = std::chrono::steady_clock::now();
  auto result = std::async(std::launch::async, [&] { return predict::predict(experiment, criterion, options); });
  ProgressLine line;
  for (auto pause = 250ms; line.onTerminal() && result.wait_for(pause) != std::future_status::ready; pause = 500ms) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    line.tell(fmt::format("computing {} … {:.1f} s", predict::nameOf(criterion), seconds));
  }
  line.end();
  return result.get();
}

void runSweep(const PredictArguments& arguments, const experiment::CompiledExperiment& experiment, predict::Criterion criterion,
              const predict::PredictOptions& options) {
  const predict::Sweep sweep = predict::parseSweep(arguments.sweep);
  const auto begin = std::chrono::steady_clock::now();
  double shown = 0;
  const auto rows = predict::computeSweep(experiment, criterion, options, sweep, [&](int done, int total) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (seconds < shown + 1) return;
    shown = seconds;
    std::cerr << fmt::format("{} of {}\n", done, total);
  });
  for (const predict::SweepRow& row : rows) {
    if (!row.prediction) {
      std::cerr << fmt::format("{} = {}: {}\n", sweep.key, row.value, row.refusal);
      continue;
    }
    for (const std::string& warning : row.prediction->warnings)
      std::cerr << fmt::format("warning: {} = {}: {}\n", sweep.key, row.value, warning);
  }
  if (std::none_of(rows.begin(), rows.end(), [](const predict::SweepRow& row) { return row.prediction != nullptr; }))
    throw RefusedError(fmt::format("--sweep: none of the {} values of {} has a prediction", rows.size(), sweep.key));
  writeText(writeSweepCsv(sweep, rows), arguments.out);
  if (!arguments.figure.empty()) writeFigure(drawSweep(sweep, rows, criterion), arguments.figure);
}

void runPredict(const PredictArguments& arguments) {
  const predict::Criterion criterion = parseCriterion(arguments.criterion);
  if (arguments.samples < 2 || arguments.samples > kMostSamples)
    throw FaultError(Fault{"--samples", fmt::format("is {}", arguments.samples), fmt::format("2 to {}", kMostSamples)});
  if (const NumberRange range = experiment::durationRange();
      arguments.options.duration != 0 && !isWithin(range, arguments.options.duration))
    throw FaultError(Fault{"--duration", fmt::format("is {} s", arguments.options.duration), range.allowed});
  if (arguments.json && !arguments.sweep.empty()) throw FaultError(Fault{"--sweep", "writes CSV rows; --json is for a single prediction"});
  if (arguments.time && !arguments.sweep.empty()) throw FaultError(Fault{"--sweep", "is not timed; --time is for a single prediction"});
  if (!arguments.out.empty() && arguments.out == arguments.figure)
    throw FaultError(Fault{"--figure", "is the file of --out", "another file"});
  const experiment::CompiledExperiment experiment = experiment::openExperiment(arguments.experiment);
  if (!experiment.experiment().task)
    throw FaultError(atTheirPlaces({predict::missingTaskFault()}, experiment.experiment().text, arguments.experiment));
  predict::PredictOptions options = arguments.options;
  for (const predict::PointIs point : {predict::PointIs::BehindSpring, predict::PointIs::Hand})
    if (arguments.point == nameOf(point)) options.point = point;
  if (!arguments.sweep.empty()) return runSweep(arguments, experiment, criterion, options);

  const auto prediction = predictPatiently(experiment, criterion, options);
  for (const std::string& warning : prediction->warnings) std::cerr << "warning: " << warning << '\n';
  if (arguments.time) reportTime(experiment, criterion, options);
  if (arguments.json) std::cout << writePredictionJson(*prediction) << std::flush;
  if (!arguments.json || !arguments.out.empty()) writeText(writePredictionCsv(*prediction, arguments.samples), arguments.out);
  if (!arguments.figure.empty()) writeFigure(drawPrediction(*prediction, arguments.samples), arguments.figure);
}

std::string footer() {
  std::string text = "Criteria:\n";
  for (const predict::Criterion c : predict::kAllCriteria) text += fmt::format("  {:24}{}\n", predict::nameOf(c), predict::describe(c));
  text += "Keys of --sweep:\n";
  for (const predict::SweepKey& key : predict::sweepKeys()) text += fmt::format("  {:28}{}\n", key.name, key.meaning);
  return text +
         "Examples:\n"
         "  reach predict chain-moderate --criterion min-hand-jerk > hand.csv\n"
         "  reach predict parallel --criterion min-hand-force-change --hand-mass 1 --json\n"
         "  reach predict dingwell --criterion min-hand-jerk --sweep duration_s=0.5:3:0.05 --out family.csv --figure family.svg\n";
}

}  // namespace

void addPredictCommand(CLI::App& app, int&) {
  CLI::App* command =
      app.add_subcommand("predict", "What the hand should do under one optimality criterion: profiles (CSV) or numbers (JSON)");
  const auto arguments = std::make_shared<PredictArguments>();
  command->add_option("experiment", arguments->experiment, "Experiment file, or the name of a shipped one")->required();
  command->add_option("--criterion", arguments->criterion, "min-hand-jerk, min-crackle … `reach help predict` lists them all")->required();
  command->add_option("--duration", arguments->options.duration, "Movement time [s] [default: the task's]")->check(CLI::PositiveNumber);
  command->add_option("--hand-mass", arguments->options.handMass, "Mass of the hand [kg] [default: the experiment's]")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--hand-damping", arguments->options.handDamping, "Damping of the hand itself [N s/m] [default: 0]")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--point", arguments->point,
                   "What an object of kind point is: behind-spring (default on a line) or hand, one with the hand [default: elsewhere]")
      ->check(CLI::IsMember({"behind-spring", "hand"}));
  command->add_option("--samples", arguments->samples, "Rows from 0 to T [default: 201]");
  command->add_option("--unknowns", arguments->options.unknowns, "Unknowns of arm and curve predictions [default: chosen for 1e-8]")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--sweep", arguments->sweep, "KEY=FROM:TO:STEP: one row for each value, on all cores");
  command->add_flag("--json", arguments->json,
                    "Cost, peaks, jumps, condition and travel time as JSON instead of the CSV (beside it with --out)");
  command->add_option("--out", arguments->out, "File for the CSV [default: standard output]");
  command->add_option("--figure", arguments->figure, "Draws profiles or family: FILE.svg, FILE.pdf or FILE.png");
  command->add_flag("--time", arguments->time, "Tells on stderr how long the computation takes");
  command->footer(footer());
  command->callback([arguments] { runPredict(*arguments); });
}

}  // namespace reachlab::cli
