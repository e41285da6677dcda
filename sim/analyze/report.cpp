#include "sim/analyze/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "sim/analyze/tables.h"
#include "sim/analyze/wording.h"
#include "sim/experiment/describe.h"

namespace reachlab::analyze {
namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light; }
body { font: 15px/1.5 "DejaVu Sans", "Segoe UI", Helvetica, Arial, sans-serif; color: #222; max-width: 62rem; margin: 2rem auto; padding: 0 1.2rem; }
h1 { font-size: 1.55rem; margin-bottom: .2rem; } h2 { font-size: 1.15rem; margin-top: 2.2rem; border-bottom: 1px solid #ccc; padding-bottom: .2rem; }
h3 { font-size: 1rem; margin-bottom: .3rem; } p { margin: .5rem 0; } .quiet { color: #666; font-size: .85rem; }
table { border-collapse: collapse; margin: .8rem 0; font-size: .87rem; } th, td { padding: .2rem .7rem; text-align: right; } td { white-space: nowrap; }
thead tr:first-child th:first-child, td:first-child { text-align: left; } thead th { border-bottom: 1px solid #444; vertical-align: bottom; } tbody tr:nth-child(even) { background: #f5f6f8; }
tbody tr.first td { font-weight: bold; } td.text, th.text { text-align: left; } td.text { white-space: normal; overflow-wrap: anywhere; }
figure { margin: 1rem 0; } figure svg { max-width: 100%; height: auto; } figcaption { font-size: .87rem; color: #444; }
.finding { background: #eef4fa; border-left: 4px solid #0072b2; padding: .6rem .9rem; } .warning { background: #fdf3e7; border-left: 4px solid #d55e00; padding: .6rem .9rem; }
@media print { body { max-width: none; margin: 0; font-size: 10pt; } h2, figure, table { break-inside: avoid; } }
)";

struct Html {
  std::string text;
  void add(const std::string& raw) { text += raw + "\n"; }
  void paragraph(const std::string& words, const std::string& kind = "") {
    add(kind.empty() ? "<p>" + escaped(words) + "</p>" : "<p class=\"" + kind + "\">" + escaped(words) + "</p>");
  }
  void heading(int level, const std::string& words) { add(fmt::format("<h{}>{}</h{}>", level, escaped(words), level)); }
};

/// Inline: without the XML declaration, with a name for who cannot see it, ids apart from other figures'.
std::string inlineSvg(const NamedFigure& figure, std::size_t number) {
  std::string svg = figure::renderSvg(figure.figure, fmt::format("f{}-", number));
  svg.erase(0, svg.find("<svg"));
  svg.insert(4, " role=\"img\" aria-label=\"" + escaped(figure.caption) + "\"");
  return svg;
}

void addFigure(Html& html, const std::vector<NamedFigure>& figures, const std::string& name) {
  for (std::size_t i = 0; i < figures.size(); ++i) {
    if (figures[i].name != name) continue;
    html.add("<figure>" + inlineSvg(figures[i], i + 1));
    html.add("<figcaption>" + escaped(figures[i].caption) + " <span class=\"quiet\">" + escaped(name) +
             ".svg, .pdf</span></figcaption></figure>");
  }
}

void addSuccessTable(Html& html, const StudyResult& study) {
  if (study.success.empty()) return;
  std::set<int> days;
  for (const SuccessCell& cell : study.success) days.insert(cell.day);
  html.heading(2, "Success by subject, condition and day (%)");
  html.add("<table><thead><tr><th rowspan=\"2\">Subject</th>");
  for (const StudyCondition& condition : study.conditions)
    html.add(fmt::format("<th colspan=\"{}\" style=\"text-align:center\">{}</th>", days.size(), escaped(condition.name)));
  html.add("</tr><tr>");
  for (std::size_t c = 0; c < study.conditions.size(); ++c)
    for (const int day : days) html.add(fmt::format("<th>D{}</th>", day));
  html.add("</tr></thead><tbody>");
  for (const std::string& subject : study.subjects) {
    html.add("<tr><td>" + escaped(subject) + "</td>");
    for (std::size_t c = 0; c < study.conditions.size(); ++c)
      for (const int day : days) {
        const auto cell = std::find_if(study.success.begin(), study.success.end(),
                                       [&](const SuccessCell& s) { return s.subject == subject && s.condition == c && s.day == day; });
        if (cell == study.success.end()) {
          html.add("<td>–</td>");
          continue;
        }
        html.add(fmt::format("<td title=\"{} of {}; 95 % interval {:.0f} to {:.0f} %\">{:.0f} <span class=\"quiet\">/{}</span></td>",
                             cell->successes, cell->trials, 100 * cell->interval.low, 100 * cell->interval.high,
                             100.0 * static_cast<double>(cell->successes) / static_cast<double>(cell->trials), cell->trials));
      }
    html.add("</tr>");
  }
  html.add("</tbody></table>");
  html.paragraph(
      "Percent of the trials that ended as success or failure (their number behind the stroke); aborted and interrupted trials are no "
      "attempts. Intervals are in success_table.csv.",
      "quiet");
}

void addRankingTable(Html& html, const ConditionResult& result) {
  const Ranking& ranking = result.handRanking;
  if (ranking.places.empty()) return;
  html.add(
      "<table><thead><tr><th>Criterion</th><th>predicted for T (s)</th><th>ε (m/s)</th><th>95 % interval</th><th>farther than the first by "
      "(m/s)</th><th>95 % interval</th>"
      "<th class=\"text\">told apart</th></tr></thead><tbody>");
  const auto speed = [](double v) { return fmt::format("{:.5f}", v); };
  for (std::size_t i = 0; i < ranking.places.size(); ++i) {
    const RankedCriterion& p = ranking.places[i];
    const PredictedProfile& predicted = result.predictions[p.criterion];
    html.add(fmt::format("<tr{}><td>{}</td><td>{:.3f}</td><td>{}</td><td>{} … {}</td>", i == 0 ? " class=\"first\"" : "",
                         escaped(numberedName(predicted.criterion)), predicted.taskDuration, speed(p.epsilon), speed(p.interval.low),
                         speed(p.interval.high)));
    if (i == 0) html.add("<td></td><td></td><td class=\"text\"></td></tr>");
    else
      html.add(fmt::format("<td>{}</td><td>{} … {}</td><td class=\"text\">{}</td></tr>", speed(p.difference),
                           speed(p.differenceInterval.low), speed(p.differenceInterval.high), p.apartFromFirst ? "yes" : "no"));
  }
  html.add("</tbody></table>");
}

void addMeasures(Html& html, const StudyResult& study, std::size_t condition) {
  struct Line {
    const char* name;
    double TrialMeasures::*value;
    double scale;
    const char* format;
  };
  static constexpr Line kLines[] = {
      {"reaction time (s)", &TrialMeasures::reactionTime, 1, "{:.3f} ± {:.3f}"},
      {"duration, onset to offset (s)", &TrialMeasures::duration, 1, "{:.3f} ± {:.3f}"},
      {"movement time of the task (s)", &TrialMeasures::movementTime, 1, "{:.3f} ± {:.3f}"},
      {"peak speed (m/s)", &TrialMeasures::peakSpeed, 1, "{:.3f} ± {:.3f}"},
      {"time to peak (%)", &TrialMeasures::timeToPeakPercent, 1, "{:.1f} ± {:.1f}"},
      {"symmetry ratio", &TrialMeasures::symmetryRatio, 1, "{:.2f} ± {:.2f}"},
      {"path length (mm)", &TrialMeasures::pathLength, 1e3, "{:.1f} ± {:.1f}"},
      {"speed peaks", &TrialMeasures::speedPeaks, 1, "{:.2f} ± {:.2f}"},
      {"end-point error, hand (mm)", &TrialMeasures::handEndpointError, 1e3, "{:.1f} ± {:.1f}"},
      {"end-point error, object (mm)", &TrialMeasures::objectEndpointError, 1e3, "{:.1f} ± {:.1f}"},
      {"overshoot, hand (mm)", &TrialMeasures::handOvershoot, 1e3, "{:.1f} ± {:.1f}"},
      {"overshoot, object (mm)", &TrialMeasures::objectOvershoot, 1e3, "{:.1f} ± {:.1f}"},
      {"SPARC", &TrialMeasures::sparc, 1, "{:.3f} ± {:.3f}"},
      {"log dimensionless jerk", &TrialMeasures::ldlj, 1, "{:.2f} ± {:.2f}"},
      {"peak force (N)", &TrialMeasures::peakForce, 1, "{:.2f} ± {:.2f}"},
      {"mean force (N)", &TrialMeasures::meanForce, 1, "{:.2f} ± {:.2f}"},
  };
  const auto summary = [&](const Line& line, bool success) -> std::string {
    std::vector<double> values;
    for (const StudyTrial& t : study.trials)
      if (t.condition == condition && t.counted && (t.result.outcome == trial::Outcome::Success) == success)
        values.push_back(line.scale * t.measures.*line.value);
    const MeanSd s = computeMeanSd(values);
    if (s.count == 0) return "–";
    std::string text = std::isfinite(s.sd) ? fmt::format(fmt::runtime(line.format), s.mean, s.sd) : fmt::format("{:.4g}", s.mean);
    for (std::size_t at; (at = text.find('-')) != std::string::npos;) text.replace(at, 1, "−");
    return text;
  };
  html.add("<table><thead><tr><th>Measure (mean ± SD)</th><th>successes</th><th>failures</th></tr></thead><tbody>");
  for (const Line& line : kLines)
    html.add(fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>", line.name, summary(line, true), summary(line, false)));
  html.add("</tbody></table>");
}

void addCondition(Html& html, const StudyResult& study, std::size_t c, const std::vector<NamedFigure>& figures) {
  const ConditionResult& r = study.results[c];
  const std::string file = fileNameOf(study.conditions[c].name);
  html.heading(2, study.conditions[c].name);
  html.paragraph("Moved: " + experiment::describe(study.conditions[c].experiment) + ".");
  html.paragraph(describeCounts(r));
  if (r.onlyFailures)
    html.paragraph(
        "No trial succeeded. Profiles, errors and ranking below are of the failed trials, for description only; the paper's error is of "
        "successful ones.",
        "warning");
  const std::string durations = describeDurations(r);
  if (!durations.empty()) html.paragraph(durations, "warning");
  addFigure(html, figures, "velocity_" + file);
  if (r.used > 0) {
    html.paragraph("Hand velocity, over trials: " + describeRanking(r.handRanking, criteriaOf(r)), r.onlyFailures ? "" : "finding");
    if (r.handOverSubjects) html.paragraph("Over subjects: " + describeRanking(*r.handOverSubjects, criteriaOf(r)));
    addRankingTable(html, r);
    html.paragraph("Object velocity, over trials: " + describeRanking(r.objectRanking, criteriaOf(r)));
  }
  addFigure(html, figures, "predictions_" + file);
  if (!r.refusals.empty()) {
    html.add("<p class=\"quiet\">Not predicted here:</p><ul class=\"quiet\">");
    for (const std::string& refusal : r.refusals) html.add("<li>" + escaped(refusal) + "</li>");
    html.add("</ul>");
  }
  std::set<std::string> warnings;
  for (const PredictedProfile& p : r.predictions)
    for (const std::string& w : p.warnings) warnings.insert(numberedName(p.criterion) + ": " + w);
  for (const std::string& w : warnings) html.paragraph(w, "warning");
  addMeasures(html, study, c);
}

void addProvenance(Html& html, const std::vector<RunProvenance>& runs, const std::vector<std::string>& notes) {
  html.heading(2, "Recordings");
  html.add(
      "<table><thead><tr><th>Subject</th><th>session</th><th>run</th><th class=\"text\">condition</th><th>trials</th><th "
      "class=\"text\">device</th>"
      "<th class=\"text\">method</th><th>seed</th><th>samples (Hz)</th><th class=\"text\">started (UTC)</th><th "
      "class=\"text\">software</th></tr></thead><tbody>");
  for (const RunProvenance& r : runs)
    html.add(fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"text\">{}{}</td><td>{}</td><td class=\"text\">{}</td><td class=\"text\">{}</td>"
        "<td>{}</td><td>{:g}</td><td class=\"text\">{}</td><td class=\"text\">{}</td></tr>",
        escaped(r.subject), escaped(r.session), r.run, escaped(r.condition), r.practice ? " (practice)" : "", r.trials, escaped(r.device),
        escaped(r.method), r.seed, r.samplingHz, escaped(r.startedUtc), escaped(r.software)));
  html.add("</tbody></table>");
  for (const std::string& note : notes) html.paragraph(note, "warning");
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  }
  return out;
}

std::string makeReport(const ReportHeader& header, const StudyResult& study, const std::vector<NamedFigure>& figures,
                       const std::vector<RunProvenance>& runs, const std::vector<std::string>& notes) {
  Html html;
  html.add(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width\">");
  html.add("<title>Reaching: " + escaped(header.dataset) + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>");
  html.heading(1, "Reaching movements: analysis of " + header.dataset);
  std::size_t trials = 0;
  for (const RunProvenance& run : runs) trials += run.trials;
  html.paragraph(fmt::format("{} subject{}, {} run{}, {} trials recorded, {} condition{}. Reachlab {}.", study.subjects.size(),
                             study.subjects.size() == 1 ? "" : "s", runs.size(), runs.size() == 1 ? "" : "s", trials,
                             study.conditions.size(), study.conditions.size() == 1 ? "" : "s", header.version),
                 "quiet");
  if (!study.overall.places.empty()) {
    html.heading(2, "Which criterion is nearest?");
    html.paragraph(
        (study.conditions.size() > 1 ? "All conditions together, hand velocity, over trials: " : "Hand velocity, over trials: ") +
            describeRanking(study.overall, study.common),
        "finding");
    if (study.overallOverSubjects) html.paragraph("Over subjects: " + describeRanking(*study.overallOverSubjects, study.common), "finding");
    else html.paragraph("With one subject nothing can be said about other people: there is no interval over subjects.");
    addFigure(html, figures, "ranking");
  } else {
    html.heading(2, "Which criterion is nearest?");
    const bool succeeded =
        std::any_of(study.results.begin(), study.results.end(), [](const ConditionResult& r) { return r.used > 0 && !r.onlyFailures; });
    html.paragraph(succeeded
                       ? "Nothing to rank: no criterion can be predicted in every condition."
                       : "Nothing to rank: no trial succeeded. What the failed ones were like is described below, condition by condition.",
                   "warning");
  }
  addSuccessTable(html, study);
  addFigure(html, figures, "learning");
  for (std::size_t c = 0; c < study.conditions.size(); ++c) addCondition(html, study, c, figures);
  html.heading(2, "How it was computed");
  html.paragraph(describeMethods(study.options));
  html.paragraph(
      "Definitions of all measures and columns: docs/analysis.md of Reachlab. Every number of a figure is in a CSV file beside this page.");
  html.paragraph("Command: " + header.command, "quiet");
  addProvenance(html, runs, notes);
  html.add("</body>\n</html>");
  return html.text;
}

}  // namespace reachlab::analyze
