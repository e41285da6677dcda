#include "analysis/conclusions/person_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "analysis/conclusions/comparison.h"

namespace reachlab::analysis {
namespace {

constexpr double kSameMass = 0.01;  // [kg], above 1 kg a share of the mass
constexpr double kSameEnd = 0.01;   // [kg] from an end of the mass's interval to a mass that was tried
constexpr int kMassRounds = 6;
constexpr double kFineMass = 0.05;  // of the mass's interval
constexpr int kFineRounds = 3;
constexpr double kNearValley = 1;  // of ln S: valleys of the cost that are searched too are not higher than the best mass by more

/// The fits with one mass of the hand, or with the only shape of a candidate that knows no mass.
struct MassFits {
  double mass = 0;
  std::shared_ptr<const ProfileFamily> family;
  FamilyFits fits;
};
using Masses = std::vector<MassFits>;

/// A choice and the scores that all trials have with it.
struct Judged {
  ShapeChoice choice;
  JudgedShape shape;
};

Judged choose(const Masses& masses, const std::vector<std::size_t>& by) {
  Judged best;
  for (std::size_t f = 0; f < masses.size(); ++f) {
    JudgedShape shape = chooseShape(masses[f].fits, by);
    if (shape.any && (!best.shape.any || shape.sum < best.shape.sum))
      best.choice = {shape.law, shape.plan, f, masses[f].mass}, best.shape = std::move(shape);
  }
  return best;
}

/// ln S of each trial, with the shape that the other four folds choose.
std::vector<double> heldOutScores(const Masses& masses, std::span<const double> rest) {
  const std::size_t n = rest.size();
  std::vector<double> score(n);
  for (int fold = 0; fold < kFolds; ++fold) {
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < n; ++i)
      if (static_cast<int>(i % kFolds) != fold) others.push_back(i);
    const Judged judged = choose(masses, others);
    for (std::size_t i = 0; i < n; ++i)
      if (static_cast<int>(i % kFolds) == fold) score[i] = judged.shape.any ? judged.shape.score[i] : std::log(rest[i]);
  }
  return score;
}

/// One mass with the scores of all trials, in the order of the masses.
struct MassScore {
  double mass = 0;
  std::vector<double> score;
  double sum = 0;
};

std::vector<MassScore> scoresByMass(const Masses& masses, const std::vector<std::size_t>& everyTrial) {
  std::vector<MassScore> out;
  for (const MassFits& m : masses)
    if (JudgedShape shape = chooseShape(m.fits, everyTrial); shape.any) out.push_back({m.mass, std::move(shape.score), shape.sum});
  std::sort(out.begin(), out.end(), [](const MassScore& a, const MassScore& b) { return a.mass < b.mass; });
  return out;
}

std::size_t bestOf(const std::vector<MassScore>& scores) {
  const auto less = [](const MassScore& a, const MassScore& b) { return a.sum < b.sum; };
  return static_cast<std::size_t>(std::min_element(scores.begin(), scores.end(), less) - scores.begin());
}

/// The gaps below and above a mass, 0 at an end.
std::pair<double, double> gapsAt(const std::vector<MassScore>& scores, std::size_t k) {
  const double here = scores[k].mass;
  return {k > 0 ? here - scores[k - 1].mass : 0, k + 1 < scores.size() ? scores[k + 1].mass - here : 0};
}

/// The least of the parabola through the costs of mass number `best` and its neighbours, between these. nullopt: there is none.
std::optional<double> leastOfParabola(const std::vector<MassScore>& scores, std::size_t best) {
  const std::size_t n = scores.size();
  if (n < 3) return std::nullopt;
  const std::size_t centre = std::clamp<std::size_t>(best, 1, n - 2);
  double mass[3], cost[3] = {};
  for (std::size_t k = 0; k < 3; ++k) {
    const MassScore& at = scores[centre + k - 1];
    mass[k] = at.mass;
    for (std::size_t i = 0; i < at.score.size(); ++i) cost[k] += std::exp(std::min(60.0, at.score[i] - scores[best].score[i]));
  }
  const double rise = (cost[2] - cost[1]) / (mass[2] - mass[1]), fall = (cost[1] - cost[0]) / (mass[1] - mass[0]);
  const double curvature = (rise - fall) / (mass[2] - mass[0]);
  if (!(curvature > 0)) return std::nullopt;
  const auto [below, above] = gapsAt(scores, best);
  return std::clamp((mass[0] + mass[1]) / 2 - fall / (2 * curvature), scores[best].mass - below, scores[best].mass + above);
}

/// The next mass to try near the best: the least of the parabola. If there is none, or a mass near it was tried, the middle of the wider gap
/// beside the best. nullopt: the gaps are narrow enough.
std::optional<double> nextMass(const std::vector<MassScore>& scores) {
  const std::size_t best = bestOf(scores);
  const double here = scores[best].mass, same = kSameMass * std::max(1.0, here);
  const auto [below, above] = gapsAt(scores, best);
  if (std::max(below, above) <= 2 * same) return std::nullopt;
  const double middle = below > above ? here - below / 2 : here + above / 2;
  const std::optional<double> least = leastOfParabola(scores, best);
  const auto near = [&](const MassScore& at) { return std::abs(at.mass - *least) <= same; };
  return least && std::none_of(scores.begin(), scores.end(), near) ? *least : middle;
}

/// The interval of the masses whose scores are not above the best by more than chance. The mean difference of the scores grows with the square
/// of the distance, and its error with the distance. So t reaches half of Student's quantile at the end of the interval.
Bounds intervalOf(const std::vector<MassScore>& scores) {
  const std::size_t best = bestOf(scores), n = scores.size();
  std::vector<double> excess(n, -1);  // t less half the quantile, in parts of it: above 0 outside the interval. At the best mass t is 0
  for (std::size_t k = 0; k < n; ++k) {
    if (k == best) continue;
    const TTest test = computeSerialTTest(subtract(scores[k].score, scores[best].score));
    excess[k] = test.error > 0 && test.freedom > 0 ? test.t / (computeTQuantile(0.95, test.freedom) / 2) - 1 : test.mean > 0 ? 1 : -1;
  }
  const auto crossing = [&](std::size_t in, std::size_t out) {
    return scores[in].mass + (scores[out].mass - scores[in].mass) * excess[in] / (excess[in] - excess[out]);
  };
  std::size_t low = 0, high = n - 1;
  while (excess[low] > 0) ++low;
  while (excess[high] > 0) --high;
  return {low > 0 ? crossing(low, low - 1) : scores[low].mass, high + 1 < n ? crossing(high, high + 1) : scores[high].mass};
}

/// Fits the mass between the masses of the candidate and adds the fits that it needs: half-way between those masses, then nearer and nearer to the
/// least cost, then at the ends of the interval.
MassFit fitMass(const Candidate& candidate, const ShapeFitter& fitter, const std::vector<std::size_t>& everyTrial, Masses& masses) {
  const auto add = [&](double mass, const std::shared_ptr<const ProfileFamily>& family) {
    const auto distance = [&](const MassFits& m) {
      return m.fits.anew.trials.empty() ? std::numeric_limits<double>::infinity() : std::abs(m.mass - mass);
    };
    const auto nearest =
        std::min_element(masses.begin(), masses.end(), [&](const MassFits& a, const MassFits& b) { return distance(a) < distance(b); });
    FamilyFits fits = fitter.fitNear(*family, nearest->fits);
    masses.push_back({mass, family, std::move(fits)});
  };
  const auto addAt = [&](double mass) { add(mass, candidate.familyOf(mass)); };
  // The costs may have several valleys, since a plan for another duration can stand for another mass.
  for (const MassFamily& m : candidate.between) add(m.mass, m.family);
  const std::vector<MassScore> coarse = scoresByMass(masses, everyTrial);
  const std::size_t best = bestOf(coarse);
  if (best > 0) addAt((coarse[best - 1].mass + coarse[best].mass) / 2);
  if (best + 1 < coarse.size()) addAt((coarse[best].mass + coarse[best + 1].mass) / 2);
  // Valleys are narrow where the hand is light.
  if (best <= 1 && coarse.size() > 1)
    for (const double part : {0.125, 0.25, 0.375}) addAt(coarse[0].mass + part * (coarse[1].mass - coarse[0].mass));
  const std::vector<MassScore> fine = scoresByMass(masses, everyTrial);
  for (std::size_t k = 1; k + 1 < fine.size(); ++k) {
    const bool valley = k != bestOf(fine) && fine[k].sum < fine[k - 1].sum && fine[k].sum < fine[k + 1].sum;
    if (!valley || fine[k].sum > fine[bestOf(fine)].sum + kNearValley * static_cast<double>(everyTrial.size())) continue;
    if (const std::optional<double> least = leastOfParabola(fine, k)) addAt(*least);
  }
  for (int round = 0; round < kMassRounds; ++round) {
    const std::optional<double> next = nextMass(scoresByMass(masses, everyTrial));
    if (!next) break;
    addAt(*next);
  }
  Bounds rough = intervalOf(scoresByMass(masses, everyTrial));
  for (int round = 0; round < kFineRounds; ++round) {  // where the scatter is small, narrow gaps are not near enough
    const std::vector<MassScore> scores = scoresByMass(masses, everyTrial);
    const std::optional<double> least = leastOfParabola(scores, bestOf(scores));
    const auto near = [&](const MassScore& at) { return std::abs(at.mass - *least) <= kFineMass * (rough.high - rough.low); };
    if (!least || std::any_of(scores.begin(), scores.end(), near)) break;
    addAt(*least);
    rough = intervalOf(scoresByMass(masses, everyTrial));
  }
  for (const double end : {rough.low, rough.high})
    if (std::none_of(masses.begin(), masses.end(), [&](const MassFits& m) { return std::abs(m.mass - end) <= kSameEnd; })) addAt(end);
  const std::vector<MassScore> scores = scoresByMass(masses, everyTrial);
  MassFit out;
  out.mass = scores[bestOf(scores)].mass;
  out.interval = intervalOf(scores);
  out.atEdge =
      out.interval.high >= candidate.masses.back() || (out.interval.low <= candidate.masses.front() && candidate.masses.front() > 0);
  return out;
}

/// Of one trial's residuals: sqrt(sum r^2 / N).   [m/s]
double computeFittedEpsilon(std::span<const double> residual) {
  double sum = 0;
  for (const double r : residual) sum += r * r;
  return std::sqrt(sum / static_cast<double>(residual.size()));
}

}  // namespace

PersonFit fitPerson(std::span<FitWindow> windows, std::span<const double> durations, const CandidateSet& set, bool keepApart) {
  PersonFit out;
  out.own = makeTemplate(windows, durations, keepApart);
  const std::size_t n = windows.size();
  std::vector<double> rest;
  double wholeRest = 0;
  std::size_t samples = 0;
  for (const FitWindow& w : windows) rest.push_back(restCost(w)), wholeRest += rest.back(), samples += w.velocity.size();
  const double typical = medianOf({durations.begin(), durations.end()});
  const ShapeFitter fitter(windows, rest);
  std::vector<std::size_t> everyTrial(n);
  std::iota(everyTrial.begin(), everyTrial.end(), std::size_t{0});

  std::vector<LaidResiduals> allLaid;
  for (const Candidate& candidate : set.candidates) {
    CandidateFit fit;
    Masses masses;
    for (std::size_t f = 0; f < candidate.families.size(); ++f)
      masses.push_back({candidate.masses.empty() ? 0 : candidate.masses[f], candidate.families[f],
                        fitter.fit(*candidate.families[f], typical, !candidate.reference())});  // the reference has no plan to choose
    if (candidate.familyOf && choose(masses, everyTrial).shape.any) {
      fit.mass = fitMass(candidate, fitter, everyTrial, masses);
      if (fit.mass->atEdge) {
        Masses beyond;
        for (const MassFamily& m : candidate.beyond) beyond.push_back({m.mass, m.family, fitter.fit(*m.family, typical)});
        fit.beyond = heldOutScores(beyond, rest);
      }
    }
    fit.score = heldOutScores(masses, rest);
    const Judged all = choose(masses, everyTrial);
    fit.choice = all.choice;
    fit.family = masses[all.choice.family].family;
    Profile profile;
    if (all.shape.any)
      fit.trials =
          all.choice.law == TimeLaw::OnePlan
              ? fitter.fitPlan(*fit.family, all.choice.plan, masses[all.choice.family].fits.anew.trials, ShapeFitter::Starts::Several)
                    .trials
              : masses[all.choice.family].fits.anew.trials;
    fit.trials.resize(n);
    if (all.choice.law == TimeLaw::OnePlan) fit.family->at(all.choice.plan, profile);
    double cost = 0, squares = 0, time = 0;
    LaidResiduals& laid = allLaid.emplace_back();
    std::vector<double> lasted;
    for (std::size_t i = 0; i < n; ++i) {
      const MovementFit& best = fit.trials[i];
      if (all.choice.law == TimeLaw::Anew && best.found) fit.family->at(best.duration, profile);
      const std::vector<double> residual = best.found ? residualsOf(windows[i], profile, best) : windows[i].velocity;
      const double epsilon = best.found ? computeFittedEpsilon(residual) : std::sqrt(rest[i] / static_cast<double>(residual.size()));
      laid.push_back(layResidual(windows[i], residual, out.own.place[i]));
      lasted.push_back(best.found ? best.duration : out.own.place[i].duration);
      fit.mean.resize(out.own.mean.value.size());
      const MovementFit& place = out.own.place[i];
      for (std::size_t k = 0; best.found && k < fit.mean.size(); ++k) {
        const double t = place.onset + place.duration * (out.own.mean.first + out.own.mean.step * static_cast<double>(k));
        fit.mean[k] += best.amplitude / place.amplitude * profile.at((t - best.onset) / best.duration) / static_cast<double>(n);
      }
      fit.epsilon.push_back(epsilon);
      cost += best.found ? best.cost : rest[i];
      squares += epsilon * epsilon * static_cast<double>(windows[i].velocity.size());
      time += best.found ? best.duration : 0;
      fit.meanScore += fit.score[i] / static_cast<double>(n);
    }
    fit.r2 = wholeRest > 0 ? 1 - cost / wholeRest : 0;
    fit.epsilonOfAll = std::sqrt(squares / static_cast<double>(samples));
    fit.duration = time / static_cast<double>(n);
    fit.systematic = computeSystematicRest(laid, std::move(lasted));
    out.candidates.push_back(std::move(fit));
  }
  for (std::size_t k = 0; k < allLaid.size(); ++k) out.candidates[k].toward = computeSharesOfOthers(allLaid, k);
  return out;
}

}  // namespace reachlab::analysis
