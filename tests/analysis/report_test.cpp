#include "analysis/report/report.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/analysis/made_analysis.h"
#include "tests/text_parts.h"

namespace reachlab::analysis {
namespace {

const ReportHeader kHeader{"mine & <yours>", "9.8.7", "reach analyze \"mine\""};

std::string reportOf(const Analysis& analysis, const std::vector<AnalysedRun>& runs = {}, const std::vector<std::string>& notes = {},
                     const std::optional<TruthRecovery>& recovery = {}) {
  std::string text = makeReport(kHeader, analysis, makeFigures(analysis, recovery), runs, notes, recovery);
  text.erase(std::remove(text.begin(), text.end(), '\n'), text.end());
  return text;
}

TEST(Report, EscapesWhatHtmlWouldRead) {
  EXPECT_EQ(escaped("a & b < c > \"d\""), "a &amp; b &lt; c &gt; &quot;d&quot;");
  expectIn(reportOf(madeStudy()), {"<title>Reaching: mine &amp; &lt;yours&gt;</title>", "Command: reach analyze &quot;mine&quot;"});
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

TEST(Report, ShowsEveryFigure) {
  const Analysis analysis = madeStudy();
  const std::string text = reportOf(analysis);
  std::size_t shown = 0;
  for (std::size_t at = 0; (at = text.find("<svg", at)) != std::string::npos; ++at) ++shown;
  EXPECT_EQ(shown, makeFigures(analysis, {}).size());
}

TEST(Report, OfOneConditionConcludesOnce) {
  Analysis analysis = madeStudy();
  analysis.conditions.pop_back(), analysis.results.pop_back();
  analysis.success.pop_back(), analysis.effects.clear(), analysis.slopes.erase(analysis.slopes.begin());
  const std::string text = reportOf(analysis);
  expectIn(text, {"<p class=\"answer finding\">Nothing can be concluded", ", 1 condition. Reachlab"});
  expectNotIn(text, {"<p class=\"finding\">", "most frequent with probability"});
}

}  // namespace
}  // namespace reachlab::analysis
