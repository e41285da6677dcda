#include "network/study/network_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>
#include <set>

#include "sim/experiment/experiment.h"

namespace reachlab::network {
namespace {

StudyCell cell(const StudyTables& tables, StudyObject object, Coupling coupling, double roundTrip) {
  for (const StudyCell& c : tables.cells)
    if (c.object == object && c.coupling == coupling && c.roundTrip == roundTrip) return c;
  ADD_FAILURE() << "no such cell";
  return {};
}

class Study : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    StudyPlan plan;
    plan.roundTrips = {0, 0.05, 0.1};
    plan.couplings = {Coupling::ServerForce, Coupling::CopiesGuessed, Coupling::Design};
    plan.seeds = 2;
    plan.setups = 0;
    tables_ = std::make_unique<StudyTables>(runNetworkStudy(plan));
  }
  static void TearDownTestSuite() { tables_.reset(); }
  static std::unique_ptr<StudyTables> tables_;
};
std::unique_ptr<StudyTables> Study::tables_;

// The bounds that the design asks of a line: half a millimetre at 50 ms, one and a half at 100.
TEST_F(Study, TheDesignIsStableAndItsCopiesKeepTogether) {
  for (const StudyObject object : {StudyObject::Chain, StudyObject::Parallel}) {
    for (const double roundTrip : {0.0, 0.05, 0.1}) {
      const StudyCell c = cell(*tables_, object, Coupling::Design, roundTrip);
      EXPECT_EQ(c.stable, c.runs) << nameOf(object) << roundTrip;
      EXPECT_LT(c.apart, roundTrip == 0 ? 1e-5 : roundTrip == 0.05 ? 5e-4 : 1.5e-3) << nameOf(object) << roundTrip;
      EXPECT_LT(c.forceError, 0.3 * c.force) << nameOf(object) << roundTrip;
    }
  }
}

TEST_F(Study, ClosingTheSpringOverTheLineIsNotStable) {
  EXPECT_EQ(cell(*tables_, StudyObject::Chain, Coupling::ServerForce, 0).stable, 2);
  EXPECT_EQ(cell(*tables_, StudyObject::Chain, Coupling::ServerForce, 0.1).stable, 0);
  EXPECT_EQ(cell(*tables_, StudyObject::Parallel, Coupling::ServerForce, 0.1).stable, 0);
}

TEST_F(Study, DeadReckoningAloneIsNot) { EXPECT_EQ(cell(*tables_, StudyObject::Chain, Coupling::CopiesGuessed, 0.1).stable, 0); }

// A line of 50 and of 100 ms is what the design's bounds are said for.
TEST(StudyPlan, UsuallyHasTheRoundTripsThatTheBoundsAreSaidFor) {
  const std::vector<double> usual = StudyPlan{}.roundTrips;
  for (const double roundTrip : {0.0, 0.05, 0.1}) EXPECT_NE(std::find(usual.begin(), usual.end(), roundTrip), usual.end()) << roundTrip;
}

TEST_F(Study, TheSameSeedsGiveTheSameTable) {
  StudyPlan plan;
  plan.roundTrips = {0.05};
  plan.couplings = {Coupling::Design};
  plan.seeds = 1;
  plan.setups = 2;
  EXPECT_EQ(studyCsv(runNetworkStudy(plan)), studyCsv(runNetworkStudy(plan)));
}

TEST(StudyPlan, ItsLossIsThatOfItsLines) {
  const auto apart = [](double loss) {
    StudyPlan plan;
    plan.roundTrips = {0.05};
    plan.couplings = {Coupling::Design};
    plan.seeds = 1;
    plan.setups = 0;
    plan.loss = loss;
    return cell(runNetworkStudy(plan), StudyObject::Chain, Coupling::Design, 0.05).apart;
  };
  EXPECT_GT(apart(0.5), 1.1 * apart(0));
}

// Two people move out and back and against each other: copies that hear nothing of each other come apart by three centimetres.
TEST(TwoHands, CopiesOfHalfTheMassAreJoinedByWhatTheyHear) {
  StudySetup setup;
  setup.experiment = makeStudyExperiment(StudyObject::Chain);
  setup.roundTrip = 0.01;
  const StudyReference reference = makeReference(setup);
  for (const Coupling coupling : {Coupling::HalfDelayed, Coupling::HalfProjected, Coupling::HalfWaves}) {
    const StudyOutcome outcome = runTwoHands(setup, coupling, copySettingsFor(setup.experiment), reference);
    EXPECT_TRUE(outcome.stable) << nameOf(coupling);
    EXPECT_LT(outcome.apart, 0.02) << nameOf(coupling);
  }
}

// What the study says its set-ups are drawn from, and that the whole of it is drawn from.
TEST(RandomSetups, AreDrawnFromTheirRanges) {
  double mostDamping = 0, leastStiffness = 1e9, mostStiffness = 0;
  for (int i = 0; i < 300; ++i) {
    const StudySetup chain = makeRandomSetup(StudyObject::Chain, 1, i);
    const experiment::Coupling& coupling = *chain.experiment.coupling;
    EXPECT_GE(coupling.stiffness, 200);
    EXPECT_LE(coupling.stiffness, 600);
    EXPECT_LE(coupling.damping, 5);
    if (i % 2 == 0) {
      EXPECT_EQ(coupling.damping, 0);
    }
    EXPECT_LE(makeRandomSetup(StudyObject::Parallel, 1, i).experiment.object.damping[0], 2.5);
    mostDamping = std::max(mostDamping, coupling.damping);
    leastStiffness = std::min(leastStiffness, coupling.stiffness), mostStiffness = std::max(mostStiffness, coupling.stiffness);
  }
  EXPECT_GT(mostDamping, 4.8);
  EXPECT_LT(leastStiffness, 210);
  EXPECT_GT(mostStiffness, 590);
}

// Every way of coupling has a line of its own points, and one that was not studied has none.
TEST(StudyFigure, HasALineForEachWayOfCoupling) {
  const auto coloursOf = [](const std::vector<Coupling>& couplings) {
    StudyTables tables;
    for (const Coupling coupling : couplings)
      for (const StudyObject object : {StudyObject::Chain, StudyObject::Parallel})
        for (const double roundTrip : {0.01, 0.05})
          tables.cells.push_back({.object = object,
                                  .coupling = coupling,
                                  .roundTrip = roundTrip,
                                  .stable = 1,
                                  .runs = 1,
                                  .apart = 1e-3 * roundTrip,
                                  .forceError = roundTrip});
    const std::string svg = drawStudy(tables);
    const std::regex stroke("stroke(?::|=\")rgb\\([^)]*\\)");
    std::set<std::string> colours;
    for (std::sregex_iterator it(svg.begin(), svg.end(), stroke); it != std::sregex_iterator(); ++it) colours.insert(it->str());
    return colours.size();
  };
  const std::size_t one = coloursOf({Coupling::Design});
  EXPECT_EQ(coloursOf({Coupling::Design, Coupling::ServerPlace}), one + 1);
  EXPECT_EQ(coloursOf({Coupling::Design, Coupling::ServerPlace, Coupling::HalfWaves}), one + 2);
}

// A part of the study's random set-ups; `reach bench --network` has them all.
TEST(RandomSetups, AreStableAndNoCopyHoldsMoreThanTheHandsPutIn) {
  StudyPlan plan;
  plan.setups = 6;
  for (const StudyObject object : {StudyObject::Chain, StudyObject::Parallel}) {
    const StudyShare share = runRandomSetups(plan, object, Coupling::Design, 0.1);
    EXPECT_GE(share.stable, 5) << nameOf(object);
    EXPECT_LT(share.ledgerDuration, 0.5) << nameOf(object) << " above " << kLedgerAmount << " J";
  }
}

StudyTables twoTables() {
  StudyTables tables;
  tables.cells = {{StudyObject::Chain, Coupling::Design, 0.25, 7, 8, 0.001220703125, 0.5, 4, 0.25},
                  {StudyObject::Chain, Coupling::Design, 0.125, 8, 8, 0.000244140625, 0.25, 4, 0.125},
                  {StudyObject::Chain, Coupling::ServerForce, 0.25, 0, 8, 0.0625, 9, 4, 3}};
  tables.shares = {{StudyObject::Chain, Coupling::Design, 0.25, 39, 40, 0.5, 0.75},
                   {StudyObject::Chain, Coupling::ServerForce, 0.25, 3, 40, 9, 9}};
  return tables;
}

TEST(StudyTable, HasCouplingsDownAndRoundTripsAcrossInTheirOrder) {
  const std::string text = formatStudy(twoTables());
  const auto lineOf = [&](const std::string& begin) {
    const std::size_t at = text.find("\n" + begin) + 1;
    std::string line = text.substr(at, text.find('\n', at) - at);
    line.erase(std::unique(line.begin(), line.end(), [](char a, char b) { return a == ' ' && b == ' '; }), line.end());
    return line;
  };
  EXPECT_EQ(text.substr(0, 37), "chain (4.00 N): stable, mm, N        ");
  EXPECT_LT(text.find("125 ms"), text.find("250 ms"));
  EXPECT_EQ(text.find("125 ms"), text.rfind("125 ms")) << "a column of the first table alone";
  EXPECT_EQ(lineOf("this design"), "this design 8/8 0.24 0.25 7/8 1.22 0.50");
  EXPECT_EQ(lineOf("server, force"), "server, force sent back 0/8 62.50 9.00");
  const std::size_t second = text.find("chain, random set-ups: stable, J, s above");
  ASSERT_NE(second, std::string::npos);
  EXPECT_NE(text.find("97.5 % 0.50 0.75", second), std::string::npos);
  EXPECT_NE(text.find("7.5 %\n", second), std::string::npos) << "a ledger is the copies' alone";
  EXPECT_EQ(text.find("parallel ("), std::string::npos) << "not studied";
}

TEST(StudyTable, AsCsvHasALineForEachCellAndShare) {
  EXPECT_EQ(
      studyCsv(twoTables()),
      "table,object,coupling,round_trip_s,runs,stable,apart_rms_m,force_error_rms_n,force_rms_n,given_j,ledger_excess_j,ledger_excess_s\n"
      "seeds,chain,design,0.25,8,7,0.001220703125,0.5,4,0.25,,\n"
      "seeds,chain,design,0.125,8,8,0.000244140625,0.25,4,0.125,,\n"
      "seeds,chain,server-force,0.25,8,0,0.0625,9,4,3,,\n"
      "random,chain,design,0.25,40,39,,,,,0.5,0.75\n"
      "random,chain,server-force,0.25,40,3,,,,,,\n");
}

TEST(StudyPlan, IsWhatTheManualSaysUnlessItIsAskedForMore) {
  const StudyPlan plan;
  EXPECT_EQ(plan.seeds, 8);
  EXPECT_EQ(plan.setups, 40);
  EXPECT_EQ(plan.loss, 0.05);
  EXPECT_EQ(plan.jitterShare, 0.1);
  EXPECT_EQ(plan.couplings.size(), 8u);
}

}  // namespace
}  // namespace reachlab::network
