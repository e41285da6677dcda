#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "analysis/conclusions/candidates.h"
#include "analysis/conclusions/person_template.h"
#include "analysis/conclusions/shape_fits.h"
#include "analysis/conclusions/systematic_rest.h"
#include "analysis/measures/statistics.h"

namespace reachlab::analysis {

/// The shape that a candidate is given for all of a person's trials in a condition.
struct ShapeChoice {
  TimeLaw law = TimeLaw::Anew;
  double plan = 0;         // [s] P, for OnePlan
  std::size_t family = 0;  // index into Candidate::families, or larger for a mass that is not among Candidate::masses
  double mass = 0;         // [kg] of that family, where the candidate depends on it
};

/// The mass of the hand that fits best.
struct MassFit {
  double mass = 0;      // [kg]
  Bounds interval;      // [kg] 95 %, cut at the range of masses
  bool atEdge = false;  // the interval reaches an end of the range, so that a mass outside may fit as well. 0 kg is no such end
};

/// One candidate against one person's trials in one condition.
struct CandidateFit {
  std::vector<double> score;                    // ln S of each trial, its shape chosen by the other four folds
  std::vector<double> beyond;                   // the same with hand masses outside the range. Empty unless the mass is at its edge
  ShapeChoice choice;                           // by all trials; the fits below are with it
  std::shared_ptr<const ProfileFamily> family;  // of `choice`
  std::optional<MassFit> mass;                  // by all trials, empty if no mass was searched
  std::vector<MovementFit> trials;
  std::vector<double> epsilon;  // [m/s] of each trial: sqrt(sum r^2 / N), unweighted
  double meanScore = 0;
  double epsilonOfAll = 0;  // [m/s] the same over all samples: fitted epsilon
  double r2 = 0;            // 1 - sum S / sum w^2 v^2
  double duration = 0;      // [s] mean of the fitted ones
  SystematicRest systematic;
  std::vector<std::vector<double>> toward;  // [candidate][trial] computeSharesOfOthers
  std::vector<double> mean;  // [m/s] mean of the fitted movements, laid over one another as the trials are in PersonTemplate::mean
};

/// Fewer trials than this are described, but nothing is concluded from them.
inline constexpr std::size_t kFewestTrials = 10;
inline constexpr int kFolds = 5;

/// One person's trials in one condition, fitted by every candidate of the set. `candidates` is parallel to CandidateSet::candidates.
struct PersonFit {
  PersonTemplate own;
  std::vector<CandidateFit> candidates;
};

/// `windows` are in the order of the trials. A trial's fold is its position modulo 5. `durations` [s] are by the onset rule. Weights are
/// written into the windows. At least kFewestTrials. `keepApart`: see makeTemplate.
PersonFit fitPerson(std::span<FitWindow> windows, std::span<const double> durations, const CandidateSet& set, bool keepApart = false);

}  // namespace reachlab::analysis
