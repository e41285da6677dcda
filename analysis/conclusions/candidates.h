#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/conclusions/profile_family.h"
#include "sim/predict/predict.h"

namespace reachlab::analysis {

/// The hand velocities for one mass of the hand [kg].
struct MassFamily {
  double mass = 0;
  std::shared_ptr<const ProfileFamily> family;
};

/// A criterion that a person's movements may follow, or several criteria that predict the same hand.
struct Candidate {
  std::vector<predict::Criterion> criteria;                    // named together, the first is predicted. Empty: the reference
  std::vector<double> masses;                                  // [kg] of `families`, increasing. Empty if the hand's mass changes nothing
  std::vector<std::shared_ptr<const ProfileFamily>> families;  // the search for a mass starts from these
  std::vector<MassFamily> between;                             // half-way between neighbours of `masses`
  std::vector<MassFamily> beyond;                              // outside the range of `masses`
  std::function<std::shared_ptr<const ProfileFamily>(double mass)> familyOf;  // empty if no mass is searched
  bool reference() const { return criteria.empty(); }
};

/// The hand's mass is searched between the first and the last of these [kg] unless it is given. 8 kg is a whole arm with the handle of a
/// heavy device.
inline constexpr std::array kHandMasses{0.0, 1.0, 2.0, 4.0, 8.0};

struct CandidateOptions {
  std::vector<predict::Criterion> criteria;                                // empty: all
  std::vector<double> handMasses{kHandMasses.begin(), kHandMasses.end()};  // [kg] where the search begins
  std::optional<double> handMass;                                          // [kg] given
  double handDamping = 0;                                                  // [N s/m]
  double cutoff = 10;                                                      // [Hz] of the recording's filter
  double rate = 100;                                                       // [Hz] of the recording
};

/// The candidates of an experiment. The last is the reference: a minimum jerk of the hand that ignores the object, 30 s^2 (1 - s)^2.
/// Criteria whose hand velocities agree within 1e-6 of the peak at every mass share a candidate. Refusals name the criteria that cannot be
/// predicted, with the reason.
struct CandidateSet {
  std::vector<Candidate> candidates;
  std::vector<std::string> refusals;
  std::vector<double> masses;  // [kg] where the search for (4) to (6) begins, increasing. One: the mass was given
  bool massGiven = false;
};
/// The criteria of each candidate, as a conclusion indexes them.
std::vector<std::vector<predict::Criterion>> namesOf(const CandidateSet& set);
/// The index of the candidate that has the criterion.
std::optional<std::size_t> placeOf(const std::vector<std::vector<predict::Criterion>>& names, predict::Criterion criterion);
CandidateSet makeCandidates(const experiment::CompiledExperiment& experiment, const CandidateOptions& options);

}  // namespace reachlab::analysis
