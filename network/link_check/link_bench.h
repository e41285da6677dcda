#pragma once
#include <functional>
#include <string>
#include <vector>

#include "network/link_check/two_hands.h"

namespace reachlab::network {

/// The links over which the shipped coupling is tried, and the number of trials.
struct LinkBenchPlan {
  std::vector<double> roundTrips{0, 0.01, 0.05, 0.1, 0.2};  // [s]
  int seeds = 8;                                            // for losses and jitter, per cell
  int setups = 40;                                          // number of random set-ups per object; 0: none
  double loss = 0.05, jitterShare = 0.1;
  std::uint64_t seed = 5;  // of the random set-ups
};

/// One object over one link, over the seeds. Means over the stable runs, or over all runs if no run is stable.
struct LinkBenchCell {
  SharedObject object = SharedObject::Chain;
  double roundTrip = 0;  // [s]
  int stable = 0, runs = 0;
  double apart = 0, forceError = 0, force = 0;  // [m], [N], [N]
  double given = 0;                             // [J] the most
};
/// The same over random set-ups.
struct LinkBenchShare {
  SharedObject object = SharedObject::Chain;
  double roundTrip = 0;  // [s]
  int stable = 0, runs = 0;
  double ledgerWorst = 0, ledgerDuration = 0;  // [J], [s] TwoHandsOutcome
};
struct LinkBenchTables {
  std::vector<LinkBenchCell> cells;
  std::vector<LinkBenchShare> shares;
};

using LinkBenchProgress = std::function<void(const std::string& line)>;
LinkBenchTables runLinkBench(const LinkBenchPlan& plan, const LinkBenchProgress& progress = {});
/// Random set-ups of one kind over one link.
LinkBenchShare runRandomSetups(const LinkBenchPlan& plan, SharedObject object, double roundTrip);

std::string formatLinkBench(const LinkBenchTables& tables);  // for a terminal
std::string linkBenchCsv(const LinkBenchTables& tables);     // one line per cell or share
std::string drawLinkBench(const LinkBenchTables& tables);    // SVG

}  // namespace reachlab::network
