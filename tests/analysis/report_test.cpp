#include "analysis/report/report.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/analysis/made_study.h"

namespace reachlab::analysis {
namespace {

const ReportHeader kHeader{"mine & <yours>", "9.8.7", "reach analyze \"mine\""};

std::string reportOf(const StudyResult& study, const std::vector<RunProvenance>& runs = {}, const std::vector<std::string>& notes = {},
                     const std::optional<Recovery>& recovery = {}) {
  std::string text = makeReport(kHeader, study, makeFigures(study, recovery), runs, notes, recovery);
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
StudyResult withDays() {
  StudyResult study = madeStudy();
  study.success = {{"A", 1, 0, 3, 8, {0.085, 0.755}}, {"A", 2, 0, 1, 4, {0.006, 0.806}}, {"B", 1, 0, 2, 10, {0.025, 0.556}},
                   {"B", 2, 0, 6, 10, {0.26, 0.88}},  {"A", 1, 1, 5, 10, {0.19, 0.81}},  {"A", 2, 1, 5, 10, {0.19, 0.81}},
                   {"B", 2, 1, 1, 2, {0.01, 0.99}}};
  return study;
}

TEST(Report, EscapesWhatHtmlWouldRead) {
  EXPECT_EQ(escaped("a & b < c > \"d\""), "a &amp; b &lt; c &gt; &quot;d&quot;");
  expectIn(reportOf(madeStudy()), {"<title>Reaching: mine &amp; &lt;yours&gt;</title>", "Command: reach analyze &quot;mine&quot;"});
}

TEST(Report, BeginsWithWhatItIsOfAndTheAnswer) {
  const StudyResult study = madeStudy();
  std::vector<RunProvenance> runs(2);
  runs[0].trials = 5, runs[1].trials = 7;
  const std::string text = reportOf(study, runs);
  expectIn(text, {"<p class=\"quiet\">2 subjects, 2 runs, 12 trials recorded, 2 conditions. Reachlab 9.8.7.</p>",
                  "<p class=\"answer finding\">All conditions together: Nothing can be concluded: ", "<h1>Reaching movements: mine"});
  runs.resize(1), runs[0].trials = 1;
  expectIn(reportOf(study, runs), {"2 subjects, 1 run, 1 trial recorded"});
}

// Table 2: the first condition's two days and the last less the first, then the second's.
TEST(Report, HasSuccessByDayAndWhatIsTypical) {
  const StudyResult study = withDays();
  const std::string text = reportOf(study);
  expectIn(text,
           {"<th colspan=\"3\" style=\"text-align:center\">slow pace</th><th colspan=\"3\" style=\"text-align:center\">quick</th>",
            "</tr><tr><th>D1</th><th>D2</th><th>D2 − D1</th><th>D1</th><th>D2</th><th>D2 − D1</th>",
            "<tr><td>A</td><td title=\"3 of 8; 95 % interval 8 to 76 %\">38 <span class=\"quiet\">/8</span></td><td title=\"1 of 4; 95 % "
            "interval 1 to 81 %\">25 <span class=\"quiet\">/4</span></td><td>−12</td>",
            "<span class=\"quiet\">/10</span></td><td>0</td></tr><tr><td>B</td>", "<td>+40</td><td>–</td>",
            "<span class=\"quiet\">/2</span></td><td>–</td></tr>"});
  // Typical: of the first day, logits of 3 in 8 and 2 in 10; where only one subject did it there is none; effects of days from the study.
  const auto typical = typicalShare(study.success, 0, 1);
  expectIn(text, {fmt::format("<tr class=\"first\"><td>typical</td><td>{:.0f}<br>[{:.0f}, {:.0f}]</td>", 100 * typical->mean,
                              100 * typical->interval.low, 100 * typical->interval.high),
                  "<td>21<br>[5, 37]</td></tr>"});
}

TEST(Report, OfOneDayHasNoProgressAndOfOneSubjectNothingTypical) {
  StudyResult study = madeStudy();
  study.success = {{"A", 1, 0, 3, 8, {0.085, 0.755}}};
  std::string text = reportOf(study);
  expectIn(text, {"<th colspan=\"1\" style", "<td>typical</td><td>–</td><td>–</td></tr>"});
  expectNotIn(text, {"D1 − D1"});
  study.subjects = {"A"};
  expectNotIn(reportOf(study), {"<td>typical</td>"});
  study.success.clear();
  text = reportOf(study);
  expectNotIn(text, {"as in Table 2", "<h2>Learning</h2>"});
}

TEST(Report, ListsEffectsAndSlopes) {
  expectIn(reportOf(madeStudy()),
           {"<h2>Learning</h2>", "<li>quick, D2 − D1: +21 percentage points [5, 37]", "<li>quick − slow pace: −12.5 percentage points",
            "<li>Slope of success: quick: +7.5 percentage points"});
}

TEST(Report, OrdersCandidatesByTheirScores) {
  StudyResult study = madeStudy();
  const std::string text = reportOf(study);
  // Overall the reference is best: first, without a p; the other is 1 farther, p 0.04, below the level of 0.05.
  expectIn(
      text,
      {"<tr class=\"first\"><td>a minimum jerk that ignores the object</td><td>0</td><td></td><td class=\"text\"></td></tr><tr><td>(1) "
       "min-hand-jerk</td><td>1.000</td><td>0.04</td><td class=\"text\">yes</td></tr>"});
  // In the condition, with probabilities.
  expectIn(text,
           {"<th>most frequent with probability</th>", "<tr class=\"first\"><td>(1) min-hand-jerk</td><td>0</td><td></td><td>0.910</td>",
            "<td>1.250</td><td>0.03</td><td>0.060</td><td class=\"text\">yes</td>"});
  study.overall.against[0].p = 0.99e-4;
  study.overall.against[0].mean = 0.099;
  expectIn(reportOf(study), {"<td>0.099</td><td>&lt; 0.0001</td><td class=\"text\">no</td>"});
}

TEST(Report, HasThePapersErrorBesideTheFitted) {
  StudyResult study = madeStudy();
  PersonResult other = study.people[0];
  other.subject = "B";
  for (CandidateFit& fit : other.fit.candidates) fit.epsilonOfAll += 1, fit.duration += 1, fit.r2 += 1;
  study.people.push_back(other);
  expectIn(
      reportOf(study),
      {"<tr><td>(1) min-hand-jerk</td><td>0.0210</td><td>0.0110 … 0.0310</td><td>0.0900</td><td>-0.7000</td><td>-0.550</td><td>-0.6000</td></tr>",
       "<tr><td>(3) min-crackle</td><td>0.0410</td><td>0.0150 … 0.0550</td><td>0.0700</td><td>–</td><td>–</td><td>–</td></tr>",
       "<tr><td>reference</td><td>–</td><td>–</td><td>–</td><td>0.3000</td><td>0.450</td><td>0.4000</td></tr>"});
  study.results[0].handEpsilon[0].interval.reset();
  study.results[0].objectEpsilon.pop_back();
  expectIn(reportOf(study), {"<td>0.0210</td><td>–</td><td>–</td>"});
}

TEST(Report, OfARecoveryCountsWhatWasNamedRightly) {
  Recovery recovery;
  recovery.studies = 10;
  recovery.candidates = {{predict::Criterion::MinHandJerk}, {predict::Criterion::MinCrackle}, {}};
  recovery.counts = {{6, 1, 1, 2}, {2, 5, 0, 3}, {4, 4, 1, 1}};
  expectIn(reportOf(madeStudy(), {}, {}, recovery),
           {"Of 20 studies that were simulated with a criterion for truth, 11 named it, 4 named another, 5 stayed undecided."});
  expectNotIn(reportOf(madeStudy(), {}, {}, Recovery{}), {"What this design can tell"});
}

TEST(Report, HasMeasuresOfSuccessesAndFailuresApart) {
  StudyResult study = madeStudy();
  study.trials.resize(3);
  const double reaction[] = {0.25, 0.5, 0.75}, path[] = {0.2, 0.3, 0.5};
  for (std::size_t i = 0; i < 3; ++i) study.trials[i].measures.reactionTime = reaction[i], study.trials[i].measures.pathLength = path[i];
  study.trials[0].measures.sparc = -1.5, study.trials[2].measures.sparc = -2.5;
  const std::string text = reportOf(study);
  // The first and third succeeded, the second failed.
  expectIn(text, {"<tr><td>reaction time (s)</td><td>0.500 ± 0.354</td><td>0.5</td></tr>",
                  "<tr><td>path length (mm)</td><td>350.0 ± 212.1</td><td>300</td></tr>",
                  "<tr><td>SPARC</td><td>−2.000 ± 0.707</td><td>–</td></tr>"});
  study.trials[2].counted = false;
  expectIn(reportOf(study), {"<tr><td>reaction time (s)</td><td>0.25</td><td>0.5</td></tr>"});
}

TEST(Report, SaysWhereNothingSucceededOrCouldBePredicted) {
  StudyResult study = madeStudy();
  study.results[0].refusals = {"min-x: <cannot>"};
  study.results[0].signals[0].warnings = {"is short"};
  std::string text = reportOf(study);
  expectIn(text, {"<ul class=\"quiet\"><li>min-x: &lt;cannot&gt;</li></ul>", "<p class=\"warning\">(3) min-crackle: is short</p>"});
  expectNotIn(text, {"No trial succeeded"});
  study.results[0].onlyFailures = true;
  text = reportOf(study);
  expectIn(text, {"<p class=\"warning\">No trial succeeded. Profiles and errors below are of the failed trials"});
  expectNotIn(text, {"What the failed ones were like"});
  study.overall.best.reset();
  expectIn(reportOf(study), {"No trial succeeded. What the failed ones were like is described below"});
  study.results[0].onlyFailures = false;
  expectNotIn(reportOf(study), {"What the failed ones were like"});
}

TEST(Report, OfOneConditionConcludesOnce) {
  StudyResult study = madeStudy();
  study.conditions.pop_back(), study.results.pop_back();
  study.success.pop_back(), study.effects.clear(), study.slopes.erase(study.slopes.begin());
  const std::string text = reportOf(study);
  expectIn(text, {"<p class=\"answer finding\">Nothing can be concluded", ", 1 condition. Reachlab"});
  expectNotIn(text, {"<p class=\"finding\">", "most frequent with probability"});
}

TEST(Report, ListsRecordingsAndNotes) {
  RunProvenance run;
  run.subject = "07", run.session = "02", run.run = 3, run.condition = "slow <1>", run.trials = 21, run.device = "dev", run.method = "rk4";
  run.seed = 99, run.samplingHz = 62.5, run.startedUtc = "2026-01-02T03:04:05Z", run.software = "0.5";
  RunProvenance practice = run;
  practice.practice = true;
  const std::string text = reportOf(madeStudy(), {run, practice}, {"something <was> left out"});
  const std::string rest =
      "</td><td>21</td><td class=\"text\">dev</td><td class=\"text\">rk4</td><td>99</td><td>62.5</td><td "
      "class=\"text\">2026-01-02T03:04:05Z</td><td class=\"text\">0.5</td></tr>";
  expectIn(text, {"<tr><td>07</td><td>02</td><td>3</td><td class=\"text\">slow &lt;1&gt;" + rest, "slow &lt;1&gt; (practice)" + rest,
                  "<p class=\"warning\">something &lt;was&gt; left out</p>"});
  const RunProvenance fresh;
  EXPECT_TRUE(fresh.run == 0 && fresh.block == 0 && fresh.day == 0 && !fresh.practice && fresh.seed == 0 && fresh.samplingHz == 0 &&
              fresh.trials == 0 && fresh.healthy);
}

// Ids of one figure stand apart from another's, and each is drawn where it is named.
TEST(Report, DrawsEachFigureOnceUnderItsName) {
  const StudyResult study = madeStudy();
  const std::string text = reportOf(study);
  for (const NamedFigure& figure : makeFigures(study, {})) {
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
