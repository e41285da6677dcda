#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/adaptation/state_space.h"
#include "analysis/conclusions/comparison.h"
#include "cli/commands/commands.h"
#include "cli/output/json_text.h"
#include "sim/session/session.h"

namespace reachlab::cli {
namespace {

struct AdaptationRequest {
  std::string series;
  int resamples = 400;
  std::uint64_t seed = 1;
  bool json = false;
};

std::string sentenceOf(const analysis::AdaptationFit& fit) {
  const double gain = fit.one.bic - fit.two.bic;
  switch (fit.count) {
    case analysis::StateCount::Two:
      return fmt::format("Two states describe the series better than one: their BIC is lower by {:.1f}.", gain);
    case analysis::StateCount::One:
      return fmt::format("One state is enough: its BIC is lower by {:.1f}. The second state of the fit means nothing.", -gain);
    case analysis::StateCount::Undecided: break;
  }
  return fmt::format("The series cannot tell one state from two: their BIC differ by {:.1f}, and less than 6 is no strong evidence.",
                     std::abs(gain));
}

nlohmann::ordered_json jsonOf(const analysis::LearningFit& fit, const std::vector<std::string>& endings) {
  nlohmann::ordered_json object, intervals;
  for (std::size_t k = 0; k < fit.states.size(); ++k) {
    object["a" + endings[k]] = fit.states[k].retention;
    object["b" + endings[k]] = fit.states[k].learningRate;
    intervals["a" + endings[k]] = {fit.intervals[k][0].low, fit.intervals[k][0].high};
    intervals["b" + endings[k]] = {fit.intervals[k][1].low, fit.intervals[k][1].high};
  }
  object["mse"] = fit.meanSquare;
  object["bic"] = fit.bic;
  object["interval_95"] = intervals;
  return object;
}

void printStates(const analysis::LearningFit& fit, const std::vector<const char*>& names) {
  for (std::size_t k = 0; k < fit.states.size(); ++k) {
    const auto& [retention, rate] = fit.intervals[k];
    fmt::print("{:<7} retention {:.4f} [{:.4f}, {:.4f}]   learning rate {:.4f} [{:.4f}, {:.4f}]\n", names[k], fit.states[k].retention,
               retention.low, retention.high, fit.states[k].learningRate, rate.low, rate.high);
  }
}

/// Both states begin at 0: a response before the first perturbation is taken for learning that is not there.
void warnOfBaseline(const analysis::AdaptationSeries& series) {
  std::vector<double> baseline;
  for (const analysis::AdaptationTrial& trial : series) {
    if (trial.perturbation.value_or(0) != 0) break;
    if (trial.response) baseline.push_back(*trial.response);
  }
  const analysis::TTest test = analysis::computeTTest(baseline);
  if (baseline.size() > 2 && test.p < 0.001)
    fmt::print(
        stderr,
        "warning: the responses before the first perturbation are {:.3g} on average, and the model begins at 0. Subtract that mean from "
        "every response first\n",
        test.mean);
}

void fitSeries(const AdaptationRequest& r) {
  const auto series = analysis::readAdaptationSeries(r.series);
  warnOfBaseline(series);
  const analysis::AdaptationFit fit = analysis::fitAdaptation(series, r.resamples, r.seed);
  constexpr double kNone = 1e-6;  // a learning rate that changes no response
  if (fit.one.states[0].learningRate < kNone)
    fmt::print(stderr,
               "warning: the fitted learning rate is 0, because the responses do not follow the perturbation. Check their sign: a response "
               "that cancels a perturbation of 1 is 1, not -1\n");
  if (r.json) {
    nlohmann::ordered_json object;
    object["two_state"] = jsonOf(fit.two, {"_f", "_s"});
    object["one_state"] = jsonOf(fit.one, {""});
    object["states"] = fit.count == analysis::StateCount::Two ? "two" : fit.count == analysis::StateCount::One ? "one" : "undecided";
    object["sentence"] = sentenceOf(fit);
    object["responses"] = fit.responses;
    object["channel_trials"] = fit.channels;
    fmt::print("{}", jsonText(object));
    return;
  }
  fmt::print("{} responses, {} channel trials\n", fit.responses, fit.channels);
  printStates(fit.two, {"fast", "slow"});
  printStates(fit.one, {"single"});
  fmt::print("Root mean square residual: {:.3g} with two states, {:.3g} with one.\n{}\n", std::sqrt(fit.two.meanSquare),
             std::sqrt(fit.one.meanSquare), sentenceOf(fit));
}

}  // namespace

void addAdaptationCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("adaptation", "Fits a two-state model of learning to a series of trials");
  const auto r = std::make_shared<AdaptationRequest>();
  command->add_option("series", r->series, "CSV file with the columns perturbation (empty in channel trials) and response")->required();
  command->add_option("--resamples", r->resamples, "Bootstrap series for the intervals [default: 400]")->check(CLI::Range(100, 100000));
  command->add_option("--seed", r->seed, "Seed of the bootstrap [default: 1]")->check(CLI::Validator(session::seedFault, "SEED"));
  command->add_flag("--json", r->json, "an object");
  command->footer(
      "The model is Smith, Ghazizadeh & Shadmehr (2006): a fast and a slow state learn from each trial's error and forget. The response of a trial\n"
      "is what the person compensates before that trial's error is learned. Perturbation and response need one common unit. Both states begin at 0:\n"
      "subtract the mean response of the baseline first.\n\n"
      "Examples:\n  reach adaptation series.csv\n  reach adaptation series.csv --json");
  command->callback([r] { fitSeries(*r); });
}

}  // namespace reachlab::cli
