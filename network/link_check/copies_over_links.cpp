#include "network/link_check/copies_over_links.h"

#include <algorithm>
#include <limits>

#include "base/ticks.h"
#include "sim/experiment/experiment.h"

namespace reachlab::network {

CopiesOverLinks::CopiesOverLinks(const experiment::Experiment& experiment, const constraints::Constraint& constraint,
                                 std::span<const double> start, const CopySettings& settings, const LinkConditions& link, double roundTrip,
                                 std::uint64_t seed)
    : roundTrip_(roundTrip), samples_(experiment.hands.size()) {
  const std::size_t stations = experiment.hands.size();
  for (std::size_t i = 0; i < stations; ++i) {
    copies_.push_back(std::make_unique<CoupledCopy>(experiment, constraint, static_cast<int>(i), settings));
    copies_.back()->placeAtRest(start);
    copies_.back()->fill(samples_[i], {});
    for (std::size_t peer = 0; peer + 1 < stations; ++peer) links_.emplace_back(link, seed * stations * (stations - 1) + links_.size());
  }
}

SimulatedLink<CopySample>& CopiesOverLinks::link(std::size_t from, std::size_t to) {
  return links_[to * (copies_.size() - 1) + (from < to ? from : from - 1)];
}

void CopiesOverLinks::tick(std::span<const dynamics::HandSegment> hands, std::span<const dynamics::HandSample> ends, double now) {
  const std::size_t stations = copies_.size();
  for (std::size_t i = 0; i < stations; ++i) {
    CoupledCopy& copy = *copies_[i];
    copy.beginTick(now);
    for (std::size_t peer = 0; peer + 1 < stations; ++peer)
      links_[i * (stations - 1) + peer].receive(now,
                                                [&](const CopySample& sample) { copy.take(static_cast<int>(peer), sample, roundTrip_); });
    (void)copy.step(hands[i], kTickSeconds);
  }
  for (std::size_t i = 0; i < stations; ++i) {
    CopySample& sample = samples_[i];
    ++sample.sequence;
    sample.time = now;
    copies_[i]->fill(sample, ends[i]);
    for (std::size_t to = 0; to < stations; ++to)
      if (to != i) link(i, to).send(sample, now);
  }
}

double CopiesOverLinks::speedSquares() const {
  double sum = 0;
  for (std::size_t i = 0; i < copies_.size(); ++i)
    for (int k = 0; k < copies_[i]->rateCount(); ++k)
      sum += samples_[i].rates[static_cast<std::size_t>(k)] * samples_[i].rates[static_cast<std::size_t>(k)];
  return sum;
}

double CopiesOverLinks::aboveLedger() const {
  double put = 0, most = -std::numeric_limits<double>::infinity();
  for (const auto& copy : copies_) put += copy->ownWork(), most = std::max(most, copy->objectEnergy());
  return most - put;
}

}  // namespace reachlab::network
