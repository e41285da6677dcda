#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/conclusions/profile_family.h"
#include "sim/predict/predict.h"

namespace reachlab::analysis {

/// A criterion that a person's movements may follow, or several criteria that predict the same hand, with every hand mass tried.
struct Candidate {
  std::vector<predict::Criterion> criteria;  // named together; the first is the one that is predicted. Empty: the reference
  std::vector<double> masses;                // [kg] one a family; empty where the hand's mass changes nothing
  std::vector<std::unique_ptr<ProfileFamily>> families;
  bool reference() const { return criteria.empty(); }
};

/// Hand masses [kg] that are tried where nothing gives the mass: up to a whole arm with the handle of a heavy device. With 2 kg as the
/// largest, a hand of 3 or 4 kg that follows criterion (4) was taken for one that follows (5).
inline constexpr std::array kHandMasses{0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0};

struct CandidateOptions {
  std::vector<predict::Criterion> criteria;                                // empty: all
  std::vector<double> handMasses{kHandMasses.begin(), kHandMasses.end()};  // [kg] tried where nothing gives it
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
  std::vector<double> masses;  // [kg] that were tried for (4) to (6); one: it was given
  bool massGiven = false;
};
CandidateSet makeCandidates(const experiment::CompiledExperiment& experiment, const CandidateOptions& options);

}  // namespace reachlab::analysis
