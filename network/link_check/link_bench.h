#pragma once
#include <functional>
#include <limits>
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

/// One object over one link: over the seeds, or over random set-ups. NaN: not a number of that table.
struct LinkBenchRow {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  SharedObject object = SharedObject::Chain;
  double roundTrip = 0;  // [s]
  int stable = 0, runs = 0;
  // Over the seeds: means over the stable runs, or over all runs if no run is stable.
  double apart = kNone, forceError = kNone, force = kNone;  // [m], [N], [N]
  double given = kNone;                                     // [J] the most
  // Over random set-ups.
  double ledgerWorst = kNone, ledgerDuration = kNone;  // [J], [s] TwoHandsOutcome
};
struct LinkBenchTables {
  std::vector<LinkBenchRow> cells, shares;  // over the seeds, over random set-ups
};

using LinkBenchProgress = std::function<void(const std::string& line)>;
LinkBenchTables runLinkBench(const LinkBenchPlan& plan, const LinkBenchProgress& progress = {});
/// Random set-ups of one kind over one link.
LinkBenchRow runRandomSetups(const LinkBenchPlan& plan, SharedObject object, double roundTrip);

std::string formatLinkBench(const LinkBenchTables& tables);  // for a terminal
std::string linkBenchCsv(const LinkBenchTables& tables);     // one line per cell or share
std::string drawLinkBench(const LinkBenchTables& tables);    // SVG

}  // namespace reachlab::network
