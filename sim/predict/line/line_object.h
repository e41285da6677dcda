#pragma once
#include <string>
#include <vector>

#include "sim/experiment/experiment_fwd.h"

namespace reachlab::predict {

/// The object on a straight line as the criteria see it (docs/theory/criteria.md, "The object on a line"). It is a spring network, and its
/// node 0 is the hand. Chain: springs[0] is the coupling, springs[i] joins masses i and i+1. Parallel: springs[i] joins mass i+1 to the
/// hand.
struct LineObject {
  bool parallel = false;
  std::vector<double> masses;     // [kg]
  std::vector<double> springs;    // [N/m], as many as masses
  std::vector<double> dampers;    // [N s/m], as many as masses
  std::vector<double> viscosity;  // [N s/m] of the surroundings, on each mass
  double handMass = 0;            // [kg]
  double handDamping = 0;         // [N s/m]
  std::vector<int> source;        // mass i of the experiment is masses[source[i]] here: equal parallel frequencies are one mass

  int count() const { return static_cast<int>(masses.size()); }
  bool damped(bool withHand = true) const;
  double totalMass() const;  // [kg] with the hand
};

/// Takes the object out of the experiment. Throws FaultError for an object that has no form on a line. Throws RefusedError for a spring of
/// zero stiffness, because a mass that hangs on it cannot be brought to rest.
LineObject makeLineObject(const experiment::Experiment& experiment, double handMass, double handDamping);

/// Parallel masses whose frequencies (and decay rates) differ by less than 1e-9/T move alike under any hand, and become one mass.
/// `warnings` names the merged masses. Otherwise frequencies are never merged: the limit is not the merged solution
/// (docs/theory/criteria.md, "Equal frequencies").
LineObject mergeEqualFrequencies(const LineObject& object, double duration, std::vector<std::string>& warnings);

/// Two-way wave travel time along a chain, 2 sum sqrt(m_i / k_[i-1]) [s]. Costs and peaks explode for shorter durations.
double computeTravelTime(const LineObject& object);

}  // namespace reachlab::predict
