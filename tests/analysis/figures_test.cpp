#include "analysis/report/figures.h"

#include <gtest/gtest.h>

#include "tests/analysis/made_analysis.h"

namespace reachlab::analysis {
namespace {

using figure::Panel;
using predict::Criterion;

void expectNear(const std::vector<double>& given, const std::vector<double>& expected) {
  ASSERT_EQ(given.size(), expected.size());
  for (std::size_t i = 0; i < given.size(); ++i) EXPECT_NEAR(given[i], expected[i], 1e-9) << i;
}
bool same(const figure::Color& a, const figure::Color& b) {
  return a.red == b.red && a.green == b.green && a.blue == b.blue && a.alpha == b.alpha;
}

// The made scores of a trial differ by the same number in every trial, so the interval is the score itself.
TEST(ScoreFigure, HasIntervalsWithoutLinesAndMarksAMassAtTheEdge) {
  const NamedFigure out = scoreFigure(madeStudy());
  ASSERT_EQ(out.figure.panels.size(), 1u);
  const Panel& panel = out.figure.panels[0];
  ASSERT_EQ(panel.series.size(), 1u);
  EXPECT_EQ(panel.series[0].width, 0) << "criteria have no order";
  ASSERT_EQ(panel.series[0].errorLow.size(), 2u);
  EXPECT_NEAR(panel.series[0].y[1], -3, 1e-12);
  EXPECT_NEAR(panel.series[0].errorLow[1], -3, 1e-12);
  ASSERT_EQ(panel.words.size(), 1u);
  EXPECT_EQ(panel.words[0].text, "*");
  EXPECT_EQ(panel.words[0].x, 2);
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

TEST(Shortened, KeepsWhatFitsAndSaysThatItIsCut) {
  const std::string text(34, 'x');
  EXPECT_EQ(shortened(text), text);
  EXPECT_EQ(shortened(text + "y"), std::string(33, 'x').append("…"));
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

TEST(LearningFigure, TypicalSubjectGoesOnBehindAMissingAttempt) {
  Analysis analysis = madeStudy();
  analysis.subjects = {"A", "B", "C"};
  analysis.learning = {{"A", "01", 0, 1, 10, 3, 10, {}}, {"A", "01", 0, 11, 19, 5, 9, {}},  {"A", "02", 0, 20, 29, 6, 10, {}},
                       {"B", "01", 0, 1, 10, 4, 10, {}}, {"B", "01", 0, 11, 20, 6, 10, {}}, {"B", "02", 0, 21, 30, 8, 10, {}},
                       {"C", "01", 0, 1, 10, 5, 10, {}}, {"C", "01", 0, 11, 20, 6, 10, {}}, {"C", "02", 0, 21, 30, 9, 10, {}}};
  const figure::Series typical = learningFigure(analysis).figure.panels.at(0).series.back();
  ASSERT_EQ(typical.x.size(), 4u);
  EXPECT_DOUBLE_EQ(typical.x[1], (15 + 15.5 + 15.5) / 3);
  EXPECT_TRUE(std::isnan(typical.x[2])) << "a gap parts the sessions";
  EXPECT_DOUBLE_EQ(typical.x[3], (24.5 + 25.5 + 25.5) / 3);
  EXPECT_GT(typical.y[3], 60);
}

TEST(PaperFigure, CaptionNamesOnlyWhatIsDrawn) {
  Analysis analysis = madeStudy();
  analysis.results[0].signals.resize(1);  // criterion (3) alone
  const std::string caption = paperFigure(analysis, 0).caption;
  EXPECT_NE(caption.find("Thick: criterion (3) dashed, for"), std::string::npos) << caption;
  EXPECT_EQ(caption.find("(1)"), std::string::npos) << caption;
}

}  // namespace
}  // namespace reachlab::analysis
