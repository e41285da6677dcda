#pragma once
#include <memory>
#include <span>
#include <vector>

#include "network/coupled_copy.h"
#include "network/link_check/simulated_link.h"

namespace reachlab::network {

/// The copies of one object at its stations, joined by simulated links, under a clock of the caller. The study and the check before a block
/// use it.
class CopiesOverLinks {
 public:
  /// All links are alike. The object rests at `start`, in coordinates of the constraint.
  CopiesOverLinks(const experiment::Experiment& experiment, const constraints::Constraint& constraint, std::span<const double> start,
                  const CopySettings& settings, const LinkConditions& link, double roundTrip, std::uint64_t seed);

  /// One tick that ends at `now` [s], with the motion of each hand in it and the position of each hand at its end.
  void tick(std::span<const dynamics::HandSegment> hands, std::span<const dynamics::HandSample> ends, double now);
  int count() const { return static_cast<int>(copies_.size()); }
  const CoupledCopy& copy(int station) const { return *copies_[static_cast<std::size_t>(station)]; }
  /// The samples as the other stations receive them.
  const CopySample& sample(int station) const { return samples_[static_cast<std::size_t>(station)]; }
  double speedSquares() const;  // sum over all copies' rates
  /// [J] the largest excess of a copy's energy over the energy that the hands have put in.
  double aboveLedger() const;

 private:
  SimulatedLink<CopySample>& link(std::size_t from, std::size_t to);

  double roundTrip_;
  std::vector<std::unique_ptr<CoupledCopy>> copies_;
  std::vector<SimulatedLink<CopySample>> links_;  // by receiver, then by peer of its copy
  std::vector<CopySample> samples_;
};

}  // namespace reachlab::network
