#pragma once
#include <memory>
#include <span>
#include <vector>

#include "network/coupled_copy.h"
#include "network/link_check/simulated_link.h"

namespace reachlab::network {

/// One object's copies at its stations, joined by simulated links, under a clock of the caller's: what the study and the check before a block
/// are made of.
class CopiesOverLinks {
 public:
  /// Every link like every other; at rest at `start`, in coordinates of the constraint.
  CopiesOverLinks(const experiment::Experiment& experiment, const constraints::Constraint& constraint, std::span<const double> start,
                  const CopySettings& settings, const LinkConditions& link, double roundTrip, std::uint64_t seed);

  /// One tick that ends at `now` [s]: where each hand goes in it, and where it is then.
  void tick(std::span<const dynamics::HandSegment> hands, std::span<const dynamics::HandSample> ends, double now);
  int count() const { return static_cast<int>(copies_.size()); }
  const CoupledCopy& copy(int station) const { return *copies_[static_cast<std::size_t>(station)]; }
  /// As the others get it.
  const CopySample& sample(int station) const { return samples_[static_cast<std::size_t>(station)]; }
  double speedSquares() const;  // sum over all copies' rates
  /// [J] the most that a copy holds above what the hands have put in.
  double aboveLedger() const;

 private:
  SimulatedLink<CopySample>& link(std::size_t from, std::size_t to);

  double roundTrip_;
  std::vector<std::unique_ptr<CoupledCopy>> copies_;
  std::vector<SimulatedLink<CopySample>> links_;  // by receiver, then by peer of its copy
  std::vector<CopySample> samples_;
};

}  // namespace reachlab::network
