#include "analysis/conclusions/fit_window.h"

#include <algorithm>
#include <cmath>

namespace reachlab::analysis {

std::optional<FitWindow> makeFitWindow(const TrialData& trial, const TrialSignals& signals) {
  constexpr double kLead = 0.3, kEdge = 0.05, kShare = 0.05, kRate = 100;
  const std::size_t recorded = std::min(trial.hand.size(), signals.handVelocity.size());
  const auto edge = static_cast<std::size_t>(std::lround(kEdge * trial.rate)),
             lead = static_cast<std::size_t>(std::lround(kLead * trial.rate));
  if (recorded < edge + 10) return std::nullopt;
  const auto begin = signals.handVelocity.begin(), end = begin + static_cast<std::ptrdiff_t>(recorded);
  const double peak = *std::max_element(begin, end);
  if (!(peak > 0)) return std::nullopt;
  const auto moves = static_cast<std::size_t>(std::find_if(begin, end, [&](double v) { return v > kShare * peak; }) - begin);
  const std::size_t from = moves > lead ? moves - lead : 0;
  const std::size_t every = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(trial.rate / kRate)));
  FitWindow window;
  window.rate = trial.rate / static_cast<double>(every);
  window.begin = trial.first + static_cast<double>(from) / trial.rate;
  for (std::size_t i = from; i < recorded - edge; i += every) window.velocity.push_back(signals.handVelocity[i]);
  window.weight.assign(window.velocity.size(), 1.0);
  if (window.velocity.size() < 10) return std::nullopt;
  return window;
}

}  // namespace reachlab::analysis
