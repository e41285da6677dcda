#include "analysis/conclusions/shape_fits.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "analysis/measures/statistics.h"

namespace reachlab::analysis {
namespace {

constexpr double kMinCost = 1e-12;      // of the cost of not moving: below, a fit is exact
constexpr double kPlanStep = 0.018;     // of ln P
constexpr int kPlansAside = 3;          // steps to either side of a centre: 5 %
constexpr double kPlanNearTime = 0.07;  // P lies within that of the median fitted T
constexpr int kMaxSteps = 45;           // P between 0.44 and 2.25 times its first value
constexpr int kPlanRounds = 12;         // of the search for the consistent plan
constexpr int kPlanFineRounds = 4;      // of the parabolas about the best plan
constexpr double kLeastGain = 0.002;    // of the mean score: a smaller gain ends them
// Durations from which a fit starts, times the duration by the moments of v^2. A hand with two humps has several minima.
constexpr std::array kStarts{1.0, 0.82, 1.22};

double scoreOf(const MovementFit& fit, double rest) { return std::log(std::max(fit.found ? fit.cost : rest, kMinCost * rest)); }

double sumOver(const std::vector<double>& score, const std::vector<std::size_t>& trials) {
  double sum = 0;
  for (const std::size_t i : trials) sum += score[i];
  return sum;
}

double medianDuration(const ShapeFits& fits) {
  std::vector<double> durations;
  for (const MovementFit& f : fits.trials) durations.push_back(f.duration);
  return medianOf(std::move(durations));
}

/// The least of the parabola in ln P through the costs of a plan and of one on either side, and how far the mean score would fall to it.
/// The parabola is laid through costs and not through scores, which are their logarithms: without scatter a score has a cusp at its least, and
/// no parabola follows it. nullopt: the least does not lie between the two plans.
struct NearerPlan {
  double plan = 0, gain = 0;
};
std::optional<NearerPlan> nearerPlan(const ShapeFits& before, const ShapeFits& middle, const ShapeFits& after) {
  if (before.score.size() != middle.score.size() || after.score.size() != middle.score.size() || middle.score.empty()) return std::nullopt;
  double below = 0, above = 0;  // costs less that of the middle, which is 1 in each trial
  for (std::size_t i = 0; i < middle.score.size(); ++i) {
    below += std::exp(std::min(60.0, before.score[i] - middle.score[i])) - 1;
    above += std::exp(std::min(60.0, after.score[i] - middle.score[i])) - 1;
  }
  const double left = std::log(before.plan / middle.plan), right = std::log(after.plan / middle.plan);
  const double curvature = (above / right - below / left) / (right - left), slope = above / right - curvature * right;
  if (!(curvature > 0)) return std::nullopt;
  const double x = -slope / (2 * curvature);
  if (!(x > left && x < right)) return std::nullopt;
  return NearerPlan{middle.plan * std::exp(x), slope * slope / (4 * curvature) / static_cast<double>(middle.score.size())};
}

/// The plan of least cost, between the steps. nullopt: a neighbour of the best step was not fitted.
std::optional<double> leastCost(const std::map<int, ShapeFits>& plans) {
  const auto best = std::min_element(plans.begin(), plans.end(),
                                     [&](const auto& a, const auto& b) { return sumOf(a.second.score) < sumOf(b.second.score); });
  if (best == plans.end()) return std::nullopt;
  const auto before = plans.find(best->first - 1), after = plans.find(best->first + 1);
  if (before == plans.end() || after == plans.end()) return std::nullopt;
  const std::optional<NearerPlan> between = nearerPlan(before->second, best->second, after->second);
  return between ? between->plan : best->second.plan;
}

/// The best plan, refined by the parabola through its neighbours in ln P.
JudgedShape bestPlan(const FamilyFits& fits, const std::vector<std::size_t>& by) {
  JudgedShape best;
  const auto farness = [&](const ShapeFits& f) {
    std::vector<double> durations;
    for (const std::size_t i : by) durations.push_back(f.trials[i].duration);
    return std::abs(f.plan / medianOf(std::move(durations)) - 1);
  };
  const std::pair<const int, ShapeFits>* place = nullptr;
  const std::pair<const int, ShapeFits>* nearest = nullptr;
  double least = 0, nearness = 0;
  for (const auto& entry : fits.plans) {
    const double far = farness(entry.second);
    if (nearest == nullptr || far < nearness) nearest = &entry, nearness = far;
    if (far > kPlanNearTime) continue;
    const double sum = sumOver(entry.second.score, by);
    if (place == nullptr || sum < least) place = &entry, least = sum;
  }
  if (place == nullptr) place = nearest;
  if (place == nullptr) return best;
  best = {TimeLaw::OnePlan, place->second.plan, place->second.score, sumOver(place->second.score, by), true};
  if (!fits.between.trials.empty() && farness(fits.between) <= kPlanNearTime && sumOver(fits.between.score, by) < best.sum)
    best = {TimeLaw::OnePlan, fits.between.plan, fits.between.score, sumOver(fits.between.score, by), true};
  const auto before = fits.plans.find(place->first - 1), after = fits.plans.find(place->first + 1);
  if (before == fits.plans.end() || after == fits.plans.end()) return best;
  const double b = sumOver(place->second.score, by);
  const double a = sumOver(before->second.score, by), c = sumOver(after->second.score, by);
  const double curvature = a - 2 * b + c;
  if (!(curvature > 0)) return best;
  const double x = std::clamp(0.5 * (a - c) / curvature, -0.5, 0.5);
  if (b - (a - c) * (a - c) / (8 * curvature) >= best.sum) return best;
  best.score = place->second.score;
  for (std::size_t i = 0; i < best.score.size(); ++i)
    best.score[i] += x * (after->second.score[i] - before->second.score[i]) / 2 +
                     x * x * (before->second.score[i] - 2 * place->second.score[i] + after->second.score[i]) / 2;
  best.plan = place->second.plan * std::exp(kPlanStep * x);
  best.sum = sumOver(best.score, by);
  return best;
}

}  // namespace

std::string_view nameOf(TimeLaw law) { return law == TimeLaw::Anew ? "anew" : "one-plan"; }

double medianOf(std::vector<double> values) {
  const std::size_t n = values.size();
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n / 2), values.end());
  const double upper = values[n / 2];
  if (n % 2 == 1) return upper;
  return (upper + *std::max_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n / 2))) / 2;
}

ShapeFitter::ShapeFitter(std::span<const FitWindow> windows, std::span<const double> rest) : windows_(windows), rest_(rest) {
  for (const FitWindow& w : windows) moments_.push_back(momentsOf(w));
}

ShapeFits ShapeFitter::fitPlan(const ProfileFamily& family, double plan, std::span<const MovementFit> nearby, Starts starts) const {
  ShapeFits fits;
  fits.plan = plan;
  Profile profile;
  if (!family.at(plan, profile)) return fits;
  const ProfileMoments shape = momentsOf(profile);
  const ProfilePieces pieces(profile);
  for (std::size_t i = 0; i < windows_.size(); ++i) {
    MovementFit best;
    const auto tryFrom = [&](const MovementFit& start) {
      const MovementFit fit = fitMovement(windows_[i], pieces, start, kRoughFit);
      if (fit.found && (!best.found || fit.cost < best.cost)) best = fit;
    };
    const bool near = !nearby.empty() && nearby[i].found;
    if (starts == Starts::Nearby && near) best = nearby[i];
    else {
      for (const double factor : kStarts) tryFrom(startFrom(moments_[i], shape, factor));
      if (near) tryFrom(nearby[i]);
    }
    if (best.found) best = fitMovement(windows_[i], pieces, best);
    fits.trials.push_back(best);
    fits.score.push_back(scoreOf(best, rest_[i]));
  }
  return fits;
}

FamilyFits ShapeFitter::fit(const ProfileFamily& family, double typical, bool withPlans) const {
  FamilyFits out;
  Profile scratch;
  if (!family.at(typical, scratch)) return out;
  const ProfileMoments shape = momentsOf(scratch);
  for (std::size_t i = 0; i < windows_.size(); ++i) {
    MovementFit best;
    for (const double factor : kStarts) {
      const MovementFit fit = fitMovement(windows_[i], family, startFrom(moments_[i], shape, factor), scratch, kRoughFit);
      if (fit.found && (!best.found || fit.cost < best.cost)) best = fit;
    }
    if (best.found) best = fitMovement(windows_[i], family, best, scratch);
    out.anew.trials.push_back(best);
    out.anew.score.push_back(scoreOf(best, rest_[i]));
  }
  if (withPlans) fitPlans(family, out, Starts::Several);
  return out;
}

FamilyFits ShapeFitter::fitNear(const ProfileFamily& family, const FamilyFits& similar) const {
  FamilyFits out;
  Profile scratch;
  for (std::size_t i = 0; i < windows_.size(); ++i) {
    out.anew.trials.push_back(fitMovement(windows_[i], family, similar.anew.trials[i], scratch));
    out.anew.score.push_back(scoreOf(out.anew.trials.back(), rest_[i]));
  }
  fitPlans(family, out, Starts::Nearby);
  return out;
}

/// Adds the fits with one plan, around the plan that is consistent with the durations it leads to.
void ShapeFitter::fitPlans(const ProfileFamily& family, FamilyFits& out, Starts thorough) const {
  std::vector<double> durations;
  for (const MovementFit& f : out.anew.trials)
    if (f.found) durations.push_back(f.duration);
  if (durations.empty()) return;
  const double centre = medianOf(durations);
  // The trials' fits at the nearest plan are good starts. Only the first plan and the consistent plan need several starts.
  const auto at = [&](int step, Starts starts = Starts::Nearby) -> const ShapeFits& {
    const auto known = out.plans.find(step);
    if (known != out.plans.end() && starts == Starts::Nearby) return known->second;
    const auto after = out.plans.lower_bound(step);
    auto nearest = after;
    if (after != out.plans.begin() && (after == out.plans.end() || step - std::prev(after)->first < after->first - step))
      nearest = std::prev(after);
    const bool none = nearest == out.plans.end() || nearest->second.trials.empty();
    const std::vector<MovementFit>& nearby = none ? out.anew.trials : nearest->second.trials;
    return out.plans.insert_or_assign(step, fitPlan(family, centre * std::exp(kPlanStep * step), nearby, starts)).first->second;
  };
  // The consistent plan: its fitted durations have it for their median.
  int consistent = 0;
  for (int round = 0; round < kPlanRounds; ++round) {
    const ShapeFits& fits = at(consistent, round == 0 ? thorough : Starts::Nearby);
    if (fits.trials.empty()) break;
    const int next = std::clamp(static_cast<int>(std::lround(std::log(medianDuration(fits) / centre) / kPlanStep)), -kMaxSteps, kMaxSteps);
    if (next == consistent) break;
    consistent = next;
  }
  if (consistent != 0) at(consistent, thorough);
  for (int k = 0; k <= kPlansAside; ++k)
    for (const int step : {k, -k, consistent + k, consistent - k}) at(step);
  std::erase_if(out.plans, [](const auto& entry) { return entry.second.trials.empty(); });
  const std::optional<double> plan = leastCost(out.plans);
  if (!plan) return;
  out.between = fitPlan(family, *plan, out.anew.trials, thorough);
  // Where the scatter is small, the steps are wide beside the valley of the cost.
  const auto beside = [&](double sign) -> const ShapeFits* {
    const ShapeFits* nearest = nullptr;
    for (const auto& [step, fits] : out.plans) {
      const double way = sign * std::log(fits.plan / *plan);
      if (way > 0 && (nearest == nullptr || way < sign * std::log(nearest->plan / *plan))) nearest = &fits;
    }
    return nearest;
  };
  const ShapeFits *least = beside(-1), *largest = beside(1);
  if (least == nullptr || largest == nullptr) return;
  ShapeFits before = *least, after = *largest;
  for (int round = 0; round < kPlanFineRounds; ++round) {
    const std::optional<NearerPlan> next = nearerPlan(before, out.between, after);
    if (!next || next->gain < kLeastGain) break;
    ShapeFits fresh = fitPlan(family, next->plan, out.between.trials, Starts::Nearby);
    if (!(sumOf(fresh.score) < sumOf(out.between.score))) break;
    ShapeFits& end = fresh.plan > out.between.plan ? before : after;
    end = std::exchange(out.between, std::move(fresh));
  }
}

JudgedShape chooseShape(const FamilyFits& fits, const std::vector<std::size_t>& by) {
  if (fits.anew.score.empty()) return {};
  const JudgedShape anew{TimeLaw::Anew, 0, fits.anew.score, sumOver(fits.anew.score, by), true};
  JudgedShape plan = bestPlan(fits, by);
  return plan.any && plan.sum < anew.sum ? plan : anew;
}

}  // namespace reachlab::analysis
