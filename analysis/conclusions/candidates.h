#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/conclusions/profile_family.h"
#include "sim/predict/predict.h"

namespace reachlab::analysis {

/// A candidate for what a person's movements follow: a criterion, or several that predict the same hand, with every hand mass tried.
struct Candidate {
  std::vector<predict::Criterion> criteria;  // named together; the first is the one that is predicted. Empty: the reference
  std::vector<double> masses;                // [kg] one a family; empty where the hand's mass changes nothing
  std::vector<std::unique_ptr<ProfileFamily>> families;
  bool reference() const { return criteria.empty(); }
};

struct CandidateOptions {
  std::vector<predict::Criterion> criteria;      // empty: all
  std::vector<double> handMasses{0, 0.5, 1, 2};  // [kg] tried where nothing gives it
  std::optional<double> handMass;                // [kg] given
  double handDamping = 0;                        // [N s/m]
  double cutoff = 10;                            // [Hz] of the recording's filter
  double rate = 100;                             // [Hz] of the recording
};

/// What can be predicted for an experiment, and the reference: a minimum jerk of the hand that ignores the object, 30 s^2 (1 - s)^2, last.
/// Candidates whose hand velocities agree within 1e-6 of the peak at every mass are one. Refusals say what cannot be predicted and why.
struct CandidateSet {
  std::vector<Candidate> candidates;
  std::vector<std::string> refusals;
  std::vector<double> masses;  // [kg] that were tried for (4) to (6); one: it was given
  bool massGiven = false;
};
CandidateSet makeCandidates(const experiment::CompiledExperiment& experiment, const CandidateOptions& options);

}  // namespace reachlab::analysis
