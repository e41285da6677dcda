#include "analysis/report/report.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/analysis/made_analysis.h"

namespace reachlab::analysis {
namespace {

const ReportHeader kHeader{"mine & <yours>", "9.8.7", "reach analyze \"mine\""};

std::string reportOf(const Analysis& analysis, const std::vector<RunProvenance>& runs = {}, const std::vector<std::string>& notes = {},
                     const std::optional<TruthRecovery>& recovery = {}) {
  std::string text = makeReport(kHeader, analysis, makeFigures(analysis, recovery), runs, notes, recovery);
  text.erase(std::remove(text.begin(), text.end(), '\n'), text.end());
  return text;
}
void expectIn(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part;
}
void expectNotIn(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_EQ(text.find(part), std::string::npos) << part;
}
/// Two subjects, two days, two conditions; B did not do the second condition on the first day.
Analysis withDays() {
  Analysis analysis = madeStudy();
  analysis.success = {{"A", 1, 0, 3, 8, {0.085, 0.755}}, {"A", 2, 0, 1, 4, {0.006, 0.806}}, {"B", 1, 0, 2, 10, {0.025, 0.556}},
                      {"B", 2, 0, 6, 10, {0.26, 0.88}},  {"A", 1, 1, 5, 10, {0.19, 0.81}},  {"A", 2, 1, 5, 10, {0.19, 0.81}},
                      {"B", 2, 1, 1, 2, {0.01, 0.99}}};
  return analysis;
}

TEST(Report, EscapesWhatHtmlWouldRead) {
  EXPECT_EQ(escaped("a & b < c > \"d\""), "a &amp; b &lt; c &gt; &quot;d&quot;");
  expectIn(reportOf(madeStudy()), {"<title>Reaching: mine &amp; &lt;yours&gt;</title>", "Command: reach analyze &quot;mine&quot;"});
}

TEST(Report, BeginsWithWhatItIsOfAndTheAnswer) {
  const Analysis analysis = madeStudy();
  std::vector<RunProvenance> runs(2);
  runs[0].trials = 5, runs[1].trials = 7;
  const std::string text = reportOf(analysis, runs);
  expectIn(text, {"<p class=\"quiet\">2 subjects, 2 runs, 12 trials recorded, 2 conditions. Reachlab 9.8.7.</p>",
                  "<p class=\"answer finding\">All conditions together: Nothing can be concluded: ", "<h1>Reaching movements: mine"});
  runs.resize(1), runs[0].trials = 1;
  expectIn(reportOf(analysis, runs), {"2 subjects, 1 run, 1 trial recorded"});
}

// Table 2: the first condition's two days and the last less the first, then the second's.
TEST(Report, HasSuccessByDayAndWhatIsTypical) {
  const Analysis analysis = withDays();
  const std::string text = reportOf(analysis);
  expectIn(text,
           {"<th colspan=\"3\" style=\"text-align:center\">slow pace</th><th colspan=\"3\" style=\"text-align:center\">quick</th>",
            "</tr><tr><th>D1</th><th>D2</th><th>D2 − D1</th><th>D1</th><th>D2</th><th>D2 − D1</th>",
            "<tr><td>A</td><td title=\"3 of 8; 95 % interval 8 to 76 %\">38 <span class=\"quiet\">/8</span></td><td title=\"1 of 4; 95 % "
            "interval 1 to 81 %\">25 <span class=\"quiet\">/4</span></td><td>−12</td>",
            "<span class=\"quiet\">/10</span></td><td>0</td></tr><tr><td>B</td>", "<td>+40</td><td>–</td>",
            "<span class=\"quiet\">/2</span></td><td>–</td></tr>"});
  // Typical: of the first day, logits of 3 in 8 and 2 in 10; where only one subject did it there is none; effects of days from the study.
  const auto typical = typicalShare(analysis.success, 0, 1);
  expectIn(text, {fmt::format("<tr class=\"first\"><td>typical</td><td>{:.0f}<br>[{:.0f}, {:.0f}]</td>", 100 * typical->mean,
                              100 * typical->interval.low, 100 * typical->interval.high),
                  "<td>21<br>[5, 37]</td></tr>"});
}

TEST(Report, HasThePapersErrorBesideTheFitted) {
  Analysis analysis = madeStudy();
  PersonResult other = analysis.people[0];
  other.subject = "B";
  for (CandidateFit& fit : other.fit.candidates) fit.epsilonOfAll += 1, fit.duration += 1, fit.r2 += 1;
  analysis.people.push_back(other);
  expectIn(
      reportOf(analysis),
      {"<tr><td>(1) min-hand-jerk</td><td>0.0210</td><td>0.0110 … 0.0310</td><td>0.0900</td><td>-0.7000</td><td>-0.550</td><td>-0.6000</td></tr>",
       "<tr><td>(3) min-crackle</td><td>0.0410</td><td>0.0150 … 0.0550</td><td>0.0700</td><td>–</td><td>–</td><td>–</td></tr>",
       "<tr><td>reference</td><td>–</td><td>–</td><td>–</td><td>0.3000</td><td>0.450</td><td>0.4000</td></tr>"});
  analysis.results[0].handEpsilon[0].interval.reset();
  analysis.results[0].objectEpsilon.pop_back();
  expectIn(reportOf(analysis), {"<td>0.0210</td><td>–</td><td>–</td>"});
}

TEST(Report, HasMeasuresOfSuccessesAndFailuresApart) {
  Analysis analysis = madeStudy();
  analysis.trials.resize(3);
  const double reaction[] = {0.25, 0.5, 0.75}, path[] = {0.2, 0.3, 0.5};
  for (std::size_t i = 0; i < 3; ++i)
    analysis.trials[i].measures.reactionTime = reaction[i], analysis.trials[i].measures.pathLength = path[i];
  analysis.trials[0].measures.sparc = -1.5, analysis.trials[2].measures.sparc = -2.5;
  const std::string text = reportOf(analysis);
  // The first and third succeeded, the second failed.
  expectIn(text, {"<tr><td>reaction time (s)</td><td>0.500 ± 0.354</td><td>0.5</td></tr>",
                  "<tr><td>path length (mm)</td><td>350.0 ± 212.1</td><td>300</td></tr>",
                  "<tr><td>SPARC</td><td>−2.000 ± 0.707</td><td>–</td></tr>"});
  analysis.trials[2].counted = false;
  expectIn(reportOf(analysis), {"<tr><td>reaction time (s)</td><td>0.25</td><td>0.5</td></tr>"});
}

TEST(Report, SaysWhereNothingSucceededOrCouldBePredicted) {
  Analysis analysis = madeStudy();
  analysis.results[0].refusals = {"min-x: <cannot>"};
  analysis.results[0].signals[0].warnings = {"is short"};
  std::string text = reportOf(analysis);
  expectIn(text, {"<ul class=\"quiet\"><li>min-x: &lt;cannot&gt;</li></ul>", "<p class=\"warning\">(3) min-crackle: is short</p>"});
  expectNotIn(text, {"No trial succeeded"});
  analysis.results[0].onlyFailures = true;
  text = reportOf(analysis);
  expectIn(text, {"<p class=\"warning\">No trial succeeded. Profiles and errors below are of the failed trials"});
  expectNotIn(text, {"What the failed ones were like"});
  analysis.overall.best.reset();
  expectIn(reportOf(analysis), {"No trial succeeded. What the failed ones were like is described below"});
  analysis.results[0].onlyFailures = false;
  expectNotIn(reportOf(analysis), {"What the failed ones were like"});
}

TEST(Report, OfOneConditionConcludesOnce) {
  Analysis analysis = madeStudy();
  analysis.conditions.pop_back(), analysis.results.pop_back();
  analysis.success.pop_back(), analysis.effects.clear(), analysis.slopes.erase(analysis.slopes.begin());
  const std::string text = reportOf(analysis);
  expectIn(text, {"<p class=\"answer finding\">Nothing can be concluded", ", 1 condition. Reachlab"});
  expectNotIn(text, {"<p class=\"finding\">", "most frequent with probability"});
}

// Ids of one figure stand apart from another's, and each is drawn where it is named.
TEST(Report, DrawsEachFigureOnceUnderItsName) {
  const Analysis analysis = madeStudy();
  const std::string text = reportOf(analysis);
  for (const NamedFigure& figure : makeFigures(analysis, {})) {
    const std::string name = "<span class=\"quiet\">" + figure.name + ".svg, .pdf</span>";
    const std::size_t at = text.find(name);
    ASSERT_NE(at, std::string::npos) << figure.name;
    EXPECT_EQ(text.find(name, at + 1), std::string::npos) << figure.name;
  }
  expectIn(text, {"<figure><svg role=\"img\" aria-label=\"How far each criterion", " id=\"f1-", " id=\"f6-"});
  expectNotIn(text, {" id=\"f0-", "<?xml"});
  EXPECT_TRUE(text.ends_with("</table></body></html>"));
}

}  // namespace
}  // namespace reachlab::analysis
