#include "analysis/conclusions/person_fit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace reachlab::analysis {
namespace {

constexpr double kMinCost = 1e-12;      // of the cost of not moving: below, a fit is exact
constexpr double kPlanStep = 0.018;     // of ln P
constexpr int kPlansAside = 3;          // steps to either side of a centre: 5 %
constexpr double kPlanNearTime = 0.07;  // P lies within that of the median fitted T
constexpr int kMaxSteps = 45;           // P between 0.44 and 2.25 times its first value

double medianOf(std::vector<double> values) {
  const std::size_t n = values.size();
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n / 2), values.end());
  const double upper = values[n / 2];
  if (n % 2 == 1) return upper;
  return (upper + *std::max_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n / 2))) / 2;
}

/// All trials fitted with one shape law.
struct Fits {
  std::vector<MovementFit> trials;
  std::vector<double> score;
  double plan = 0;  // [s]
};

double scoreOf(const MovementFit& fit, double rest) { return std::log(std::max(fit.found ? fit.cost : rest, kMinCost * rest)); }

struct FamilyFits {
  Fits anew;
  std::map<int, Fits> plans;  // by step of ln P
  Fits between;               // at the plan where the parabola through the costs of the best step and its neighbours is least; may be none
};

class Fitter {
 public:
  Fitter(std::span<const FitWindow> windows, std::span<const double> rest) : windows_(windows), rest_(rest) {
    for (const FitWindow& w : windows) moments_.push_back(momentsOf(w));
  }

  FamilyFits fit(const ProfileFamily& family, double taskDuration) {
    FamilyFits out;
    Profile scratch;
    Profile first;
    if (!family.at(taskDuration, first)) return out;
    const ProfileMoments shape = momentsOf(first);
    for (std::size_t i = 0; i < windows_.size(); ++i) {
      MovementFit best;
      for (const double factor : {1.0, 0.85, 1.18}) {
        const MovementFit fit = fitMovement(windows_[i], family, startFrom(moments_[i], shape, factor), scratch, kRoughFit);
        if (fit.found && (!best.found || fit.cost < best.cost)) best = fit;
      }
      if (best.found) best = fitMovement(windows_[i], family, best, scratch);
      out.anew.trials.push_back(best);
      out.anew.score.push_back(scoreOf(best, rest_[i]));
    }
    std::vector<double> durations;
    for (const MovementFit& f : out.anew.trials)
      if (f.found) durations.push_back(f.duration);
    if (durations.empty()) return out;
    const double centre = medianOf(durations);
    const auto at = [&](int step) -> const Fits& {
      const auto known = out.plans.find(step);
      if (known != out.plans.end()) return known->second;
      // What was fitted with the nearest plan is the best start.
      const auto after = out.plans.lower_bound(step);
      auto nearest = after;
      if (after != out.plans.begin() && (after == out.plans.end() || step - std::prev(after)->first < after->first - step))
        nearest = std::prev(after);
      const bool none = nearest == out.plans.end() || nearest->second.trials.empty();
      const std::vector<MovementFit>& starts = none ? out.anew.trials : nearest->second.trials;
      return out.plans.emplace(step, held(family, centre * std::exp(kPlanStep * step), starts, scratch)).first->second;
    };
    // The consistent plan: the one whose fitted durations have it for their median.
    int consistent = 0;
    for (int round = 0; round < 6; ++round) {
      const Fits& fits = at(consistent);
      if (fits.trials.empty()) break;
      const int next =
          std::clamp(static_cast<int>(std::lround(std::log(medianDuration(fits) / centre) / kPlanStep)), -kMaxSteps, kMaxSteps);
      if (next == consistent) break;
      consistent = next;
    }
    for (int k = 0; k <= kPlansAside; ++k)
      for (const int step : {k, -k, consistent + k, consistent - k}) at(step);
    std::erase_if(out.plans, [](const auto& entry) { return entry.second.trials.empty(); });
    if (const double plan = leastCost(out.plans, centre); plan > 0) out.between = held(family, plan, out.anew.trials, scratch);
    return out;
  }

  /// Costs are parabolas in ln P, scores are their logarithms: without scatter the score has a cusp that its own parabola misses.
  static double leastCost(const std::map<int, Fits>& plans, double centre) {
    const auto sum = [](const Fits& f) { return std::accumulate(f.score.begin(), f.score.end(), 0.0); };
    const auto best =
        std::min_element(plans.begin(), plans.end(), [&](const auto& a, const auto& b) { return sum(a.second) < sum(b.second); });
    if (best == plans.end()) return 0;
    const auto before = plans.find(best->first - 1), after = plans.find(best->first + 1);
    if (before == plans.end() || after == plans.end()) return 0;
    double a = 0, c = 0;
    for (std::size_t i = 0; i < best->second.score.size(); ++i) {
      a += std::exp(std::min(60.0, before->second.score[i] - best->second.score[i]));
      c += std::exp(std::min(60.0, after->second.score[i] - best->second.score[i]));
    }
    const double b = static_cast<double>(best->second.score.size()), curvature = a - 2 * b + c;
    if (!(curvature > 0)) return 0;
    return centre * std::exp(kPlanStep * (best->first + std::clamp(0.5 * (a - c) / curvature, -0.5, 0.5)));
  }

  static double medianDuration(const Fits& fits) {
    std::vector<double> durations;
    for (const MovementFit& f : fits.trials) durations.push_back(f.duration);
    return medianOf(std::move(durations));
  }

 private:
  Fits held(const ProfileFamily& family, double plan, const std::vector<MovementFit>& starts, Profile& profile) const {
    Fits fits;
    fits.plan = plan;
    if (!family.at(plan, profile)) return fits;
    const ProfileMoments shape = momentsOf(profile);
    const ProfilePieces pieces(profile);
    for (std::size_t i = 0; i < windows_.size(); ++i) {
      const MovementFit start = starts[i].found ? starts[i] : startFrom(moments_[i], shape);
      fits.trials.push_back(fitMovement(windows_[i], pieces, start));
      fits.score.push_back(scoreOf(fits.trials.back(), rest_[i]));
    }
    return fits;
  }

  std::span<const FitWindow> windows_;
  std::span<const double> rest_;
  std::vector<ProfileMoments> moments_;
};

/// A choice and the scores that all trials have with it.
struct Judged {
  ShapeChoice choice;
  std::vector<double> score;
  double sum = 0;  // over the trials that chose
  bool any = false;
};

double sumOver(const std::vector<double>& score, const std::vector<std::size_t>& trials) {
  double sum = 0;
  for (const std::size_t i : trials) sum += score[i];
  return sum;
}

/// The best plan of one family, refined by the parabola through its neighbours in ln P.
Judged bestPlan(const FamilyFits& fits, std::size_t family, const std::vector<std::size_t>& by) {
  Judged best;
  const auto farness = [&](const Fits& f) {
    std::vector<double> durations;
    for (const std::size_t i : by) durations.push_back(f.trials[i].duration);
    return std::abs(f.plan / medianOf(std::move(durations)) - 1);
  };
  const std::pair<const int, Fits>* place = nullptr;
  const std::pair<const int, Fits>* nearest = nullptr;
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
  best.any = true;
  best.choice = {TimeLaw::OnePlan, place->second.plan, family};
  best.score = place->second.score;
  best.sum = sumOver(best.score, by);
  if (!fits.between.trials.empty() && farness(fits.between) <= kPlanNearTime && sumOver(fits.between.score, by) < best.sum) {
    best.choice.plan = fits.between.plan;
    best.score = fits.between.score;
    best.sum = sumOver(best.score, by);
  }
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
  best.choice.plan = place->second.plan * std::exp(kPlanStep * x);
  best.sum = sumOver(best.score, by);
  return best;
}

Judged choose(const std::vector<FamilyFits>& families, const std::vector<std::size_t>& by) {
  Judged best;
  for (std::size_t f = 0; f < families.size(); ++f) {
    if (families[f].anew.score.empty()) continue;
    const double sum = sumOver(families[f].anew.score, by);
    if (!best.any || sum < best.sum) best = {{TimeLaw::Anew, 0, f}, families[f].anew.score, sum, true};
    Judged plan = bestPlan(families[f], f, by);
    if (plan.any && plan.sum < best.sum) best = std::move(plan);
  }
  return best;
}

}  // namespace

std::string_view nameOf(TimeLaw law) { return law == TimeLaw::Anew ? "anew" : "one-plan"; }

double computeFittedEpsilon(const FitWindow& window, const Profile& profile, const MovementFit& fit) {
  double sum = 0;
  for (const double r : residualsOf(window, profile, fit)) sum += r * r;
  return std::sqrt(sum / static_cast<double>(window.velocity.size()));
}

PersonFit fitPerson(std::span<FitWindow> windows, std::span<const double> durations, const CandidateSet& set, bool keepApart) {
  PersonFit out;
  out.own = makeTemplate(windows, durations, keepApart);
  const std::size_t n = windows.size();
  std::vector<double> rest;
  double wholeRest = 0;
  std::size_t samples = 0;
  for (const FitWindow& w : windows) rest.push_back(restCost(w)), wholeRest += rest.back(), samples += w.velocity.size();
  const double typical = medianOf({durations.begin(), durations.end()});
  Fitter fitter(windows, rest);
  std::vector<std::size_t> everyTrial(n);
  std::iota(everyTrial.begin(), everyTrial.end(), std::size_t{0});

  for (const Candidate& candidate : set.candidates) {
    CandidateFit fit;
    std::vector<FamilyFits> families;
    for (const auto& family : candidate.families) {
      families.push_back(fitter.fit(*family, typical));
      if (candidate.reference()) families.back().plans.clear(), families.back().between = {};  // it has no plan to choose
    }
    fit.score.resize(n);
    for (int fold = 0; fold < kFolds; ++fold) {
      std::vector<std::size_t> others;
      for (std::size_t i = 0; i < n; ++i)
        if (static_cast<int>(i % kFolds) != fold) others.push_back(i);
      const Judged judged = choose(families, others);
      fit.foldChoice.push_back(judged.choice);
      for (std::size_t i = 0; i < n; ++i)
        if (static_cast<int>(i % kFolds) == fold) fit.score[i] = judged.any ? judged.score[i] : std::log(rest[i]);
    }
    const Judged all = choose(families, everyTrial);
    fit.choice = all.choice;
    double cost = 0, squares = 0, time = 0;
    Profile profile;
    const ProfileFamily& family = *candidate.families[all.choice.family];
    const bool held = all.any && all.choice.law == TimeLaw::OnePlan && family.at(all.choice.plan, profile);
    const ProfilePieces pieces(profile);
    for (std::size_t i = 0; i < n; ++i) {
      MovementFit best;
      if (all.any) {
        const MovementFit& start = families[all.choice.family].anew.trials[i];
        best = held ? fitMovement(windows[i], pieces, start) : start;
        if (!held && best.found) family.at(best.duration, profile);
      }
      const double epsilon = best.found ? computeFittedEpsilon(windows[i], profile, best)
                                        : std::sqrt(rest[i] / static_cast<double>(windows[i].velocity.size()));
      fit.mean.resize(out.own.mean.value.size());
      const MovementFit& place = out.own.place[i];
      for (std::size_t k = 0; best.found && k < fit.mean.size(); ++k) {
        const double t = place.onset + place.duration * (out.own.mean.first + out.own.mean.step * static_cast<double>(k));
        fit.mean[k] += best.amplitude / place.amplitude * profile.at((t - best.onset) / best.duration) / static_cast<double>(n);
      }
      fit.trials.push_back(best);
      fit.epsilon.push_back(epsilon);
      cost += best.found ? best.cost : rest[i];
      squares += epsilon * epsilon * static_cast<double>(windows[i].velocity.size());
      time += best.found ? best.duration : 0;
      fit.meanScore += fit.score[i] / static_cast<double>(n);
    }
    fit.r2 = wholeRest > 0 ? 1 - cost / wholeRest : 0;
    fit.epsilonOfAll = std::sqrt(squares / static_cast<double>(samples));
    fit.duration = time / static_cast<double>(n);
    out.candidates.push_back(std::move(fit));
  }
  return out;
}

}  // namespace reachlab::analysis
