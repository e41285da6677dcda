#pragma once
#include <functional>
#include <string>
#include <vector>

#include "network/study/two_hands.h"

namespace reachlab::network {

/// What a study is made of.
struct StudyPlan {
  std::vector<double> roundTrips{0, 0.01, 0.05, 0.1, 0.2};  // [s]
  std::vector<Coupling> couplings{kCouplings.begin(), kCouplings.end()};
  int seeds = 8;    // of losses and jitter, a cell
  int setups = 40;  // random ones, an object; 0: none
  double loss = 0.05, jitterShare = 0.1;
  std::uint64_t seed = 5;  // of the random set-ups
};

/// One way of coupling one object over one line, over the seeds: means of the stable runs (of all, where none is).
struct StudyCell {
  StudyObject object = StudyObject::Chain;
  Coupling coupling = Coupling::Design;
  double roundTrip = 0;  // [s]
  int stable = 0, runs = 0;
  double apart = 0, forceError = 0, force = 0;  // [m], [N], [N]
  double given = 0;                             // [J] the most
};
/// The same over random set-ups.
struct StudyShare {
  StudyObject object = StudyObject::Chain;
  Coupling coupling = Coupling::Design;
  double roundTrip = 0;  // [s]
  int stable = 0, runs = 0;
  double ledgerWorst = 0, ledgerDuration = 0;  // [J], [s] StudyOutcome
};
struct StudyTables {
  std::vector<StudyCell> cells;
  std::vector<StudyShare> shares;
};

using StudyProgress = std::function<void(const std::string& line)>;
StudyTables runNetworkStudy(const StudyPlan& plan, const StudyProgress& progress = {});
/// Random set-ups of one kind over one line.
StudyShare runRandomSetups(const StudyPlan& plan, StudyObject object, Coupling coupling, double roundTrip);

std::string_view nameOf(StudyObject object);
std::string formatStudy(const StudyTables& tables);  // for a terminal
std::string studyCsv(const StudyTables& tables);     // one line a cell or share
std::string drawStudy(const StudyTables& tables);    // SVG

}  // namespace reachlab::network
