#include "analysis/report/figures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/analysis/made_analysis.h"

namespace reachlab::analysis {
namespace {

using figure::Dash;
using figure::LegendPlace;
using figure::Panel;
using figure::Series;
using predict::Criterion;

void expectNear(const std::vector<double>& given, const std::vector<double>& expected) {
  ASSERT_EQ(given.size(), expected.size());
  for (std::size_t i = 0; i < given.size(); ++i) EXPECT_NEAR(given[i], expected[i], 1e-9) << i;
}
bool same(const figure::Color& a, const figure::Color& b) {
  return a.red == b.red && a.green == b.green && a.blue == b.blue && a.alpha == b.alpha;
}

// Two conditions and an overall conclusion; only the first has fits.
TEST(ScoreFigure, ShowsScoresAgainstTheReference) {
  Analysis analysis = madeStudy();
  const NamedFigure one = scoreFigure(analysis);
  EXPECT_EQ(one.name, "scores");
  ASSERT_EQ(one.figure.panels.size(), 1u);
  const Panel& panel = one.figure.panels[0];
  EXPECT_EQ(panel.title, "slow pace");
  ASSERT_EQ(panel.series.size(), 1u);
  EXPECT_EQ(panel.series[0].label, "subject A");
  expectNear(panel.series[0].x, {1, 2});
  expectNear(panel.series[0].y, {-1, -3});
  EXPECT_EQ(panel.x.from, 0.4);
  EXPECT_NEAR(*panel.x.to, 2.6, 1e-12);
  ASSERT_EQ(panel.x.ticks.size(), 2u) << "the reference is the line at 0";
  EXPECT_EQ(panel.x.ticks[1], (std::pair<double, std::string>{2, "(4, 6)"}));
  ASSERT_EQ(panel.rules.size(), 3u);
  EXPECT_TRUE(panel.rules[0].at == 0 && !panel.rules[0].vertical);
  EXPECT_NEAR(panel.rules[1].at, -3.5 + 0.3, 1e-12) << "own mean";
  EXPECT_FALSE(panel.rules[1].vertical);
  EXPECT_TRUE(panel.rules[2].at == 1 && panel.rules[2].vertical) << "decided";

  PersonResult other = analysis.people[0];
  other.subject = "B";
  other.fit.own.ceilingScore = -2.5;
  analysis.people.push_back(other);
  other.condition = 1;
  analysis.people.push_back(other);
  analysis.results[1].candidates.candidates.resize(3);
  for (std::size_t k = 0; k < 3; ++k)
    analysis.results[1].candidates.candidates[k].criteria = analysis.results[0].candidates.candidates[k].criteria;
  const NamedFigure two = scoreFigure(analysis);
  ASSERT_EQ(two.figure.panels.size(), 2u);
  EXPECT_EQ(two.figure.panels[0].series.size(), 2u);
  EXPECT_NEAR(two.figure.panels[0].rules[1].at, -2.7, 1e-12) << "the mean of two people";
  EXPECT_EQ(two.figure.panels[1].series[0].label, "");
  EXPECT_EQ(two.figure.panels[1].rules.size(), 2u) << "nothing was decided there";
}

TEST(PosteriorFigure, HasABarForEachCandidateAndTheBoundBesideThem) {
  Analysis analysis = madeStudy();
  const NamedFigure one = posteriorFigure(analysis);
  ASSERT_EQ(one.figure.panels.size(), 1u) << "one person's conclusion has no probability";
  const Panel& panel = one.figure.panels[0];
  EXPECT_EQ(panel.y.from, 0.0);
  EXPECT_EQ(panel.y.to, 1.0);
  ASSERT_EQ(panel.bands.size(), 3u);
  expectNear(panel.bands[1].x, {1.65, 2.35});
  expectNear(panel.bands[1].low, {0, 0});
  expectNear(panel.bands[1].high, {0.06, 0.06});
  ASSERT_EQ(panel.rules.size(), 1u);
  EXPECT_TRUE(panel.rules[0].at == 0.85 && !panel.rules[0].vertical);
  EXPECT_NE(one.caption.find("the 0.85 that a conclusion asks for"), std::string::npos);
  analysis.overall.posterior = {0.6, 0.4};
  EXPECT_EQ(posteriorFigure(analysis).figure.panels.size(), 2u);
  EXPECT_EQ(posteriorFigure(analysis).figure.panels[1].title, "All conditions");
  analysis.results.pop_back(), analysis.conditions.pop_back();
  EXPECT_EQ(posteriorFigure(analysis).figure.panels.size(), 1u) << "over one condition is that condition";
  analysis.results[0].conclusion.posterior.clear();
  EXPECT_TRUE(posteriorFigure(analysis).figure.panels.empty());
}

TEST(RecoveryFigure, HasTheTruthsDownwardsAndWhatWasNamedAcross) {
  TruthRecovery recovery;
  recovery.studies = 20;
  recovery.candidates = {{Criterion::MinHandJerk}, {Criterion::MinCrackle}, {}};
  recovery.counts = {{13, 3, 1, 3}, {12, 5, 2, 1}, {0, 0, 17, 3}};
  const NamedFigure out = recoveryFigure(recovery);
  EXPECT_NE(out.caption.find("20 studies were simulated"), std::string::npos);
  const Panel& panel = out.figure.panels.at(0);
  ASSERT_EQ(panel.bands.size(), 12u);
  ASSERT_EQ(panel.words.size(), 12u);
  const auto& cell = panel.bands[5];  // the second truth, named rightly
  expectNear(cell.x, {1.53, 2.47});
  expectNear(cell.low, {1.54, 1.54});
  expectNear(cell.high, {2.46, 2.46});
  EXPECT_NEAR(cell.color.alpha, 0.08 + 0.72 * 0.25, 1e-12);
  EXPECT_TRUE(same(figure::palette::faded(panel.bands[7].color, 1), figure::palette::kGrey)) << "undecided";
  EXPECT_EQ(panel.words[5].text, "5");
  EXPECT_TRUE(panel.words[5].x == 2 && panel.words[5].y == 2);
  EXPECT_TRUE(same(panel.words[0].color, {1, 1, 1})) << "white on a dark cell";
  EXPECT_TRUE(same(panel.words[4].color, figure::palette::kBlack)) << "12 of 20 are not yet dark";
  EXPECT_TRUE(*panel.x.from == 0.5 && *panel.x.to == 4.5 && *panel.y.from == 0.5 && *panel.y.to == 3.5);
  ASSERT_EQ(panel.x.ticks.size(), 4u);
  EXPECT_EQ(panel.x.ticks[3], (std::pair<double, std::string>{4, "undecided"}));
  ASSERT_EQ(panel.y.ticks.size(), 3u);
  EXPECT_EQ(panel.y.ticks[0], (std::pair<double, std::string>{3, "(1)"}));
  EXPECT_EQ(panel.y.ticks[2], (std::pair<double, std::string>{1, "ref."}));
  recovery.studies = 0;
  EXPECT_NEAR(recoveryFigure(recovery).figure.panels.at(0).bands[1].color.alpha, 0.08 + 0.72 * 3, 1e-12) << "no division by nothing";
}

TEST(PaperFigure, HasTrialsScaledToTheirAverageAndPredictionsAsTheyAre) {
  const Analysis analysis = madeStudy();
  const NamedFigure out = paperFigure(analysis, 0);
  EXPECT_EQ(out.name, "velocity_slow-pace");
  ASSERT_EQ(out.figure.panels.size(), 2u);
  for (const bool object : {false, true}) {
    const Panel& panel = out.figure.panels[object ? 1 : 0];
    ASSERT_EQ(panel.series.size(), 5u) << "three trials, (1) and (3)";
    const Series& third = panel.series[1];
    EXPECT_EQ(panel.series[0].label, "3 trials");
    EXPECT_EQ(third.label, "");
    ASSERT_EQ(third.x.size(), 101u);
    EXPECT_NEAR(third.x[25], 0.4, 1e-12);
    EXPECT_NEAR(third.x[100], 1.6, 1e-12);
    EXPECT_NEAR(third.y[25], 1.5 * (55 + (object ? 101 : 0)), 1e-9);
    const Series &jerk = panel.series[3], &crackle = panel.series[4];
    EXPECT_EQ(jerk.label, "(1) min-hand-jerk, T = 2.5 s");
    EXPECT_NEAR(jerk.x[50], 0.5 - 0.12, 1e-12);
    EXPECT_NEAR(jerk.y[50], object ? 0.25 : 0.125, 1e-12);
    EXPECT_TRUE(jerk.dash == Dash::Solid && jerk.width == figure::kThick && same(jerk.color, figure::palette::kBlack));
    EXPECT_TRUE(crackle.dash == Dash::Dashed && crackle.width == figure::kThick && same(crackle.color, figure::palette::kVermilion));
  }
  EXPECT_NE(out.caption.find("Thin: 3 trials, time-scaled to their average of 1.600 s"), std::string::npos) << out.caption;
  EXPECT_NE(paperFigure(analysis, 1).caption.find("quick: no movement to show; predictions only."), std::string::npos);
}

TEST(LastFiveFigure, IsOfTheFirstSubjectsLastTrials) {
  Analysis analysis = madeStudy();
  const NamedFigure out = lastFiveFigure(analysis, 0);
  EXPECT_EQ(out.name, "last_five_slow-pace");
  ASSERT_EQ(out.figure.panels.size(), 2u);
  const Panel& hand = out.figure.panels[0];
  ASSERT_EQ(hand.series.size(), 4u) << "A's two trials, (1), and their average";
  EXPECT_EQ(hand.series[0].label, "last 2 successful");
  EXPECT_NEAR(hand.series[0].x[100], 1.6, 1e-12) << "the mean of 0.8 and 2.4 s";
  EXPECT_EQ(hand.series[3].label, "average of 2");
  EXPECT_NEAR(hand.series[3].y[25], (0.5 * 35 + 1.5 * 55) / 2, 1e-9);
  EXPECT_NEAR(out.figure.panels[1].series[3].y[25], (0.5 * 136 + 1.5 * 156) / 2, 1e-9);
  EXPECT_NE(out.caption.find("slow pace, subject A"), std::string::npos);
  EXPECT_NE(out.caption.find("average of all 2 successful"), std::string::npos) << out.caption;
  const AnalyzedTrial first = analysis.trials[0];
  analysis.trials.assign(7, first);
  EXPECT_EQ(lastFiveFigure(analysis, 0).figure.panels[0].series[0].label, "last 5 successful");
  EXPECT_EQ(lastFiveFigure(analysis, 0).figure.panels[0].series.size(), 7u);
  analysis.results[0].onlyFailures = true;
  EXPECT_TRUE(lastFiveFigure(analysis, 0).figure.panels.empty());
  EXPECT_TRUE(lastFiveFigure(analysis, 1).figure.panels.empty());
}

TEST(PeopleFigure, HasTheTwoClosestAndTheReferenceWithWhatTheyLeave) {
  Analysis analysis = madeStudy();
  analysis.results[0].candidates.candidates.insert(analysis.results[0].candidates.candidates.begin() + 1,
                                                   Candidate{{Criterion::MinCrackle}, {}, {}});
  analysis.people[0].fit.candidates.insert(analysis.people[0].fit.candidates.begin() + 1, madeFit(0, 2, 441));
  const NamedFigure out = peopleFigure(analysis, 0);
  ASSERT_EQ(out.figure.panels.size(), 2u);
  const Panel &fits = out.figure.panels[0], &rest = out.figure.panels[1];
  EXPECT_EQ(fits.title, "Subject A, 2 trials");
  ASSERT_EQ(fits.series.size(), 4u) << "mean, (4, 6), (1), reference: the third closest is left out";
  EXPECT_EQ(fits.series[0].label, "mean");
  EXPECT_EQ(fits.series[1].label, "(4, 6)");
  EXPECT_EQ(fits.series[2].label, "(1)");
  EXPECT_EQ(fits.series[3].label, "reference");
  EXPECT_EQ(fits.series[1].dash, Dash::Dotted);
  // Every third point of s from -0.15 to 1.15: the first is the 90th of the grid from -0.6 on, the last the 348th.
  const std::vector<double>& s = fits.series[0].x;
  EXPECT_NEAR(s.front(), -0.15, 1e-9);
  EXPECT_NEAR(s[1] - s[0], 0.015, 1e-12);
  EXPECT_NEAR(s.back(), 1.14, 1e-9);
  EXPECT_NEAR(fits.series[0].y[1], 0.593, 1e-12);
  EXPECT_NEAR(fits.bands.at(0).low[1], 0.593 - 0.0293, 1e-12);
  EXPECT_NEAR(fits.bands.at(0).high[1], 0.593 + 0.0293, 1e-12);
  EXPECT_EQ(fits.bands[0].label, "± SD");
  EXPECT_NEAR(rest.bands.at(0).low[1], -0.0293, 1e-12);
  EXPECT_NEAR(rest.bands[0].high[1], 0.0293, 1e-12);
  EXPECT_EQ(rest.bands[0].label, "");
  EXPECT_NEAR(fits.series[2].y[1], -2 + 0.93, 1e-12);
  ASSERT_EQ(rest.series.size(), 3u);
  EXPECT_NEAR(rest.series[1].y[1], 0.593 - (-2 + 0.93), 1e-12);
  EXPECT_TRUE(peopleFigure(analysis, 1).figure.panels.empty());
}

TEST(LearningFigure, OfTwoSubjectsSetsThemBesideOneAnotherWithTheirIntervals) {
  const Analysis analysis = madeStudy();
  const NamedFigure out = learningFigure(analysis);
  ASSERT_EQ(out.figure.panels.size(), 1u) << "nobody learnt in the other condition";
  const Panel& panel = out.figure.panels[0];
  EXPECT_EQ(panel.title, "slow pace");
  EXPECT_TRUE(*panel.y.from == 0 && *panel.y.to == 100 && *panel.x.from == 0);
  ASSERT_EQ(panel.series.size(), 2u);
  const Series &a = panel.series[0], &b = panel.series[1];
  ASSERT_EQ(a.x.size(), 3u) << "a gap parts sessions";
  EXPECT_NEAR(a.x[0], 5.5 - 0.6, 1e-12);
  EXPECT_TRUE(std::isnan(a.x[1]) && std::isnan(a.y[1]) && std::isnan(a.errorLow[1]) && std::isnan(a.errorHigh[1]));
  EXPECT_NEAR(a.x[2], 12.5 - 0.6, 1e-12);
  EXPECT_NEAR(b.x[0], 5.5 + 0.6, 1e-12);
  expectNear({a.y[0], a.y[2], b.y[0]}, {37.5, 75, 50});
  expectNear({a.errorLow[0], a.errorLow[2], a.errorHigh[0], a.errorHigh[2]}, {10, 20, 70, 99});
  EXPECT_NE(out.caption.find("groups of 10 trials"), std::string::npos);
  EXPECT_NE(out.caption.find("Clopper and Pearson"), std::string::npos);
}

TEST(LearningFigure, OfMoreDrawsWhatIsTypical) {
  Analysis analysis = madeStudy();
  analysis.subjects = {"A", "B", "C"};
  analysis.learning.push_back({"C", "01", 1, 1, 10, 2, 10, {0.1, 0.6}});
  const NamedFigure out = learningFigure(analysis);
  ASSERT_EQ(out.figure.panels.size(), 2u);
  const Panel& panel = out.figure.panels[0];
  ASSERT_EQ(panel.series.size(), 3u);
  EXPECT_TRUE(panel.series[0].width == figure::kThin && panel.series[0].marker == figure::MarkerShape::None &&
              panel.series[0].errorLow.empty());
  EXPECT_EQ(panel.series[0].x[0], 5.5) << "they need not stand beside one another";
  const Series& typical = panel.series[2];
  EXPECT_EQ(typical.label, "a typical subject");
  EXPECT_TRUE(typical.width == figure::kThick && typical.marker == figure::MarkerShape::Circle);
  expectNear(typical.x, {5.5});
  const std::vector<SuccessCell> cells{{"A", 0, 0, 3, 8, {}}, {"B", 0, 0, 5, 10, {}}};
  const auto share = typicalShare(cells, 0);
  expectNear(typical.y, {100 * share->mean});
  expectNear(typical.errorLow, {100 * share->interval.low});
  expectNear(typical.errorHigh, {100 * share->interval.high});
}

TEST(Shortened, KeepsWhatFitsAndSaysThatItIsCut) {
  const std::string text(34, 'x');
  EXPECT_EQ(shortened(text), text);
  EXPECT_EQ(shortened(text + "y"), std::string(33, 'x') + "…");
  EXPECT_EQ(shortened("abcdef", 4), "abc…");
}

TEST(Figures, AreThoseThatHaveSomethingToShow) {
  const auto namesOf = [](const Analysis& analysis, const std::optional<TruthRecovery>& recovery) {
    std::vector<std::string> names;
    for (const NamedFigure& figure : makeFigures(analysis, recovery)) names.push_back(figure.name);
    return names;
  };
  Analysis analysis = madeStudy();
  EXPECT_EQ(namesOf(analysis, {}),
            (std::vector<std::string>{"scores", "posterior", "velocity_slow-pace", "last_five_slow-pace", "people_slow-pace", "learning"}));
  TruthRecovery recovery;
  EXPECT_EQ(namesOf(analysis, recovery).size(), 6u) << "nothing was simulated";
  recovery.candidates = analysis.common;
  recovery.counts = {{1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(namesOf(analysis, recovery).at(2), "recovery");
  analysis.results[1].used = 1;
  EXPECT_EQ(namesOf(analysis, {}).size(), 7u);
}

}  // namespace
}  // namespace reachlab::analysis
