#include "network/study/network_study.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>

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
    if (i % 2 == 0) EXPECT_EQ(coupling.damping, 0);
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

}  // namespace
}  // namespace reachlab::network
