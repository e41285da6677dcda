#pragma once
#include <string>
#include <vector>

namespace reachlab::bench {

/// What one evaluation of a constraint costs: the place and all derivatives that the dynamics need (9 numbers on a curve, 18 on a
/// surface), as compiled into the program and as the same formula typed into an experiment.
struct ConstraintCost {
  std::string constraint;
  std::string form;       // generated | typed
  double nsPerEval = 0;   // processor time, median of seven rounds
};

/// The whole catalogue with its default shapes, each evaluated at places spread over its domain.
std::vector<ConstraintCost> measureConstraintCosts();
std::string formatConstraintCosts(const std::vector<ConstraintCost>& rows);

}  // namespace reachlab::bench
