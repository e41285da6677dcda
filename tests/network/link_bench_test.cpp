#include "network/link_check/link_bench.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace reachlab::network {
namespace {

LinkBenchPlan planOf(double roundTrip) { return {.roundTrips = {roundTrip}, .seeds = 2, .setups = 0}; }

// The bounds that the design asks of a link: half a millimetre at 50 ms, one and a half at 100. The hands are without noise.
TEST(LinkBench, TheObjectIsStableAndItsCopiesKeepTogether) {
  for (const double roundTrip : {0.0, 0.05, 0.1})
    for (const LinkBenchRow& c : runLinkBench(planOf(roundTrip)).cells) {
      EXPECT_EQ(c.stable, c.runs) << nameOf(c.object) << roundTrip;
      EXPECT_LT(c.apart, roundTrip == 0 ? 1e-5 : roundTrip == 0.05 ? 5e-4 : 1.5e-3) << nameOf(c.object) << roundTrip;
      EXPECT_LT(c.forceError, 0.3 * c.force) << nameOf(c.object) << roundTrip;
    }
}

TEST(LinkBench, TheSameSeedsGiveTheSameTable) {
  LinkBenchPlan plan = planOf(0.05);
  plan.seeds = 1;
  plan.setups = 2;
  EXPECT_EQ(linkBenchCsv(runLinkBench(plan)), linkBenchCsv(runLinkBench(plan)));
}

TEST(LinkBench, ItsLossIsThatOfItsLinks) {
  const auto apart = [](double loss) {
    LinkBenchPlan plan = planOf(0.05);
    plan.seeds = 1;
    plan.loss = loss;
    return runLinkBench(plan).cells.at(0).apart;
  };
  EXPECT_GT(apart(0.5), 1.1 * apart(0));
}

// A part of the random set-ups; `reach bench --network` has them all.
TEST(RandomSetups, AreStableAndNoCopyHoldsMoreThanTheHandsPutIn) {
  for (const SharedObject object : kSharedObjects) {
    const LinkBenchRow share = runRandomSetups({.setups = 6}, object, 0.1);
    EXPECT_GE(share.stable, 5) << nameOf(object);
    EXPECT_LT(share.ledgerDuration, 0.5) << nameOf(object) << " above " << kLedgerAmount << " J";
  }
}

LinkBenchTables twoTables() {
  LinkBenchTables tables;
  tables.cells = {{SharedObject::Chain, 0.25, 7, 8, 0.001220703125, 0.5, 4, 0.25},
                  {SharedObject::Chain, 0.125, 8, 8, 0.000244140625, 0.25, 4, 0.125}};
  tables.shares = {{.roundTrip = 0.25, .stable = 39, .runs = 40, .ledgerWorst = 0.5, .ledgerDuration = 0.75}};
  return tables;
}

TEST(LinkBenchTable, HasRoundTripsAcrossInTheirOrder) {
  std::string text = formatLinkBench(twoTables());
  text.erase(std::unique(text.begin(), text.end(), [](char a, char b) { return a == ' ' && b == ' '; }), text.end());
  EXPECT_EQ(text,
            " 125 ms 250 ms\nchain (4.00 N): stable, mm, N 8/8 0.24 0.25 7/8 1.22 0.50\n"
            " 250 ms\nchain, random set-ups: stable, J, s above 97.5 % 0.50 0.75\n");
}

TEST(LinkBenchTable, AsCsvHasALineForEachCellAndShare) {
  EXPECT_EQ(
      linkBenchCsv(twoTables()),
      "table,object,coupling,round_trip_s,runs,stable,apart_rms_m,force_error_rms_n,force_rms_n,given_j,ledger_excess_j,ledger_excess_s\n"
      "seeds,chain,design,0.25,8,7,0.001220703125,0.5,4,0.25,,\n"
      "seeds,chain,design,0.125,8,8,0.000244140625,0.25,4,0.125,,\n"
      "random,chain,design,0.25,40,39,,,,,0.5,0.75\n");
}

}  // namespace
}  // namespace reachlab::network
