#include "analysis/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <set>

#include "analysis/report/alternatives.h"
#include "analysis/report/wording.h"
#include "analysis/tables.h"
#include "sim/experiment/describe.h"

namespace reachlab::analysis {
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
.answer { font-size: 1.12rem; line-height: 1.45; } .finding { background: #eef4fa; border-left: 4px solid #0072b2; padding: .6rem .9rem; } .warning { background: #fdf3e7; border-left: 4px solid #d55e00; padding: .6rem .9rem; }
@page { size: A4; margin: 16mm 14mm; }
@media print { body { max-width: none; margin: 0; padding: 0; font-size: 9.5pt; } th, td { padding: .15rem .4rem; } figure, table, p { break-inside: avoid; } h2, h3 { break-after: avoid; } .finding, .warning, tbody tr:nth-child(even) { print-color-adjust: exact; -webkit-print-color-adjust: exact; } }
)";

struct Html {
  std::string text;
  void add(const std::string& raw) { text += raw + "\n"; }
  void paragraph(const std::string& words, const std::string& kind = "") {
    add(kind.empty() ? "<p>" + escaped(words) + "</p>" : "<p class=\"" + kind + "\">" + escaped(words) + "</p>");
  }
  void heading(int level, const std::string& words) { add(fmt::format("<h{}>{}</h{}>", level, escaped(words), level)); }

  /// Begins a table. `words`: the columns that hold words, not numbers. Headings and cells are HTML.
  void table(const std::vector<std::string>& headings, const std::set<std::size_t>& words = {}) {
    words_ = words;
    add("<table><thead>");
    row(headings, "<tr>", "th");
    add("</thead><tbody>");
  }
  void row(const std::vector<std::string>& cells, const char* begin = "<tr>", const char* tag = "td") {
    text += begin;
    for (std::size_t i = 0; i < cells.size(); ++i)
      text += fmt::format("<{}{}>{}</{}>", tag, words_.contains(i) ? " class=\"text\"" : "", cells[i], tag);
    add("</tr>");
  }
  void endTable() {
    add("</tbody></table>");
    words_.clear();
  }

 private:
  std::set<std::size_t> words_;
};
constexpr const char* kFirstRow = "<tr class=\"first\">";

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

std::string real(const std::string& number) {  // a minus is no hyphen
  std::string text = number;
  for (std::size_t at; (at = text.find('-')) != std::string::npos;) text.replace(at, 1, "−");
  return text;
}

std::string signedPercent(double points) {
  const std::string text = fmt::format("{:+.0f}", points);
  return text == "+0" || text == "-0" ? "0" : real(text);
}

std::string percentInterval(double mean, const Bounds& i) {
  std::string text = real(fmt::format("{:.0f}", mean));
  // On a line of its own, so that nine columns fit a page.
  if (i.finite()) text += real(fmt::format("<br>[{:.0f}, {:.0f}]", i.low, i.high));
  return text;
}

/// Table 2: conditions in order, their days side by side, and the last day less the first, per person and over people.
void addSuccessTable(Html& html, const Analysis& analysis) {
  if (analysis.success.empty()) return;
  std::set<int> days;
  for (const SuccessCell& cell : analysis.success) days.insert(cell.day);
  const bool progress = days.size() == 2;
  html.heading(2, "Success (%), as in Table 2");
  html.add("<table><thead><tr><th rowspan=\"2\">Subject</th>");
  for (const Condition& condition : analysis.conditions)
    html.add(
        fmt::format("<th colspan=\"{}\" style=\"text-align:center\">{}</th>", days.size() + (progress ? 1 : 0), escaped(condition.name)));
  html.add("</tr><tr>");
  for (std::size_t c = 0; c < analysis.conditions.size(); ++c) {
    for (const int day : days) html.add(fmt::format("<th>D{}</th>", day));
    if (progress) html.add(fmt::format("<th>D{} − D{}</th>", *days.rbegin(), *days.begin()));
  }
  html.add("</tr></thead><tbody>");
  const auto cellOf = [&](const std::string& subject, std::size_t c, int day) {
    const auto cell = std::find_if(analysis.success.begin(), analysis.success.end(),
                                   [&](const SuccessCell& s) { return s.subject == subject && s.condition == c && s.day == day; });
    return cell == analysis.success.end() ? nullptr : &*cell;
  };
  for (const std::string& subject : analysis.subjects) {
    std::vector<std::string> cells{escaped(subject)};
    for (std::size_t c = 0; c < analysis.conditions.size(); ++c) {
      for (const int day : days) {
        const SuccessCell* cell = cellOf(subject, c, day);
        cells.push_back(!cell ? "–"
                              : fmt::format("<span title=\"{} of {}; 95 % interval {:.0f} to {:.0f} %\">{:.0f} <span "
                                            "class=\"quiet\">/{}</span></span>",
                                            cell->successes, cell->trials, 100 * cell->interval.low, 100 * cell->interval.high,
                                            100 * cell->share(), cell->trials));
      }
      if (!progress) continue;
      const SuccessCell *first = cellOf(subject, c, *days.begin()), *last = cellOf(subject, c, *days.rbegin());
      cells.push_back(first && last ? signedPercent(100 * (last->share() - first->share())) : "–");
    }
    html.row(cells);
  }
  if (analysis.subjects.size() > 1) {
    std::vector<std::string> cells{"typical"};
    for (std::size_t c = 0; c < analysis.conditions.size(); ++c) {
      for (const int day : days) {
        const auto typical = typicalShare(analysis.success, c, day);
        cells.push_back(typical ? percentInterval(100 * typical->mean, typical->interval.percent()) : "–");
      }
      if (!progress) continue;
      const auto effect =
          std::find_if(analysis.effects.begin(), analysis.effects.end(), [&](const Effect& e) { return e.ofDay && e.condition == c; });
      cells.push_back(effect == analysis.effects.end() ? "–" : percentInterval(effect->points.mean, effect->pointsInterval));
    }
    html.row(cells, kFirstRow);
  }
  html.endTable();
  html.paragraph(
      "Percent of the trials that ended as success or failure (their number behind the stroke); aborted and interrupted trials are no "
      "attempts. The last row is a typical subject's share (mean of the subjects' logits) and the subjects' mean difference, in brackets "
      "95 % intervals over subjects; each subject's own exact interval is in success_table.csv.",
      "quiet");
}

void addProgress(Html& html, const Analysis& analysis, const std::vector<NamedFigure>& figures) {
  html.heading(2, "Learning");
  addFigure(html, figures, "learning");
  html.add("<ul>");
  for (const Effect& effect : analysis.effects) html.add("<li>" + escaped(describeEffect(analysis, effect)) + "</li>");
  for (const LearningSlope& slope : analysis.slopes) html.add("<li>Slope of success: " + escaped(describeSlope(analysis, slope)) + "</li>");
  html.add("</ul>");
  html.paragraph(
      "Differences are paired over subjects; p by the logits, corrected for all days, or all pairs of conditions, by Holm's method.",
      "quiet");
}

/// Every candidate of one conclusion.
void addScores(Html& html, const Conclusion& c, const std::vector<std::vector<predict::Criterion>>& names) {
  if (!c.best) return;
  std::vector<std::string> headings{"Candidate", "score above the closest (ln S)", "p", "told from the closest"};
  const bool shares = !c.posterior.empty();
  if (shares) headings.insert(headings.begin() + 3, "most frequent with probability");
  html.table(headings, {headings.size() - 1});
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < names.size(); ++k) order.push_back(k);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return c.score[a] < c.score[b]; });
  for (const std::size_t k : order) {
    const bool best = k == *c.best;
    std::vector<std::string> cells{escaped(describeCandidate(names[k])), best ? "0" : fmt::format("{:.3f}", c.against[k].mean),
                                   best ? "" : escaped(c.against[k].p < 1e-4 ? "< 0.0001" : fmt::format("{:.2g}", c.against[k].p))};
    if (shares) cells.push_back(fmt::format("{:.3f}", c.posterior[k]));
    cells.push_back(best ? "" : c.told(k) ? "yes" : "no");
    html.row(cells, best ? kFirstRow : "<tr>");
  }
  html.endTable();
}

/// A condition's fits, averaged over its subjects, and the paper's epsilon beside them.
void addFits(Html& html, const Analysis& analysis, std::size_t condition) {
  const ConditionResult& r = analysis.results[condition];
  if (r.handEpsilon.empty()) return;
  html.table(
      {"Criterion", "paper’s ε (m/s)", "mean over subjects", "object’s ε (m/s)", "fitted ε (m/s)", "fitted T (s)", "R²", "hand mass (kg)"});
  const auto row = [&](const std::string& name, const EpsilonPlace* hand, const EpsilonPlace* object, std::optional<std::size_t> k) {
    double epsilon = 0, duration = 0, r2 = 0, people = 0;
    std::vector<double> masses;
    std::size_t atEdge = 0;
    for (const PersonResult& person : analysis.people) {
      if (person.condition != condition || !person.fitted || !k) continue;
      const CandidateFit& fit = person.fit.candidates[*k];
      epsilon += fit.epsilonOfAll, duration += fit.duration, r2 += fit.r2, people += 1;
      if (fit.mass) masses.push_back(fit.mass->mass), atEdge += fit.mass->atEdge;
    }
    const auto mean = [&](double sum, int digits) { return people > 0 ? fmt::format("{:.{}f}", sum / people, digits) : "–"; };
    html.row(
        {escaped(name), hand ? fmt::format("{:.4f}", hand->epsilon) : "–",
         hand && hand->interval ? real(fmt::format("{:.4f} [{:.4f}, {:.4f}]", hand->mean, hand->interval->low, hand->interval->high)) : "–",
         object ? fmt::format("{:.4f}", object->epsilon) : "–", mean(epsilon, 4), mean(duration, 3), mean(r2, 4),
         (masses.empty() ? "–" : shortNumber(computeMeanSd(masses).mean)) +
             (atEdge > 0 ? fmt::format(", {} at the edge of the range", plural(atEdge, "subject")) : "")});
  };
  for (const EpsilonPlace& place : r.handEpsilon) {
    const predict::Criterion criterion = r.signals[place.criterion].criterion;
    const auto object =
        std::find_if(r.objectEpsilon.begin(), r.objectEpsilon.end(), [&](const EpsilonPlace& p) { return p.criterion == place.criterion; });
    row(numberedName(criterion), &place, object == r.objectEpsilon.end() ? nullptr : &*object, placeOf(namesOf(r.candidates), criterion));
  }
  if (const std::size_t n = r.candidates.candidates.size(); n > 0) row("reference", nullptr, nullptr, n - 1);
  html.endTable();
  html.paragraph(
      "In the order of the paper's ε, over all samples of the used trials, which describes but decides nothing. Beside it: the mean of each "
      "subject's own ε with its 95 % interval over subjects. Fitted values are means over subjects with enough trials; every "
      "subject's are in fits.csv.",
      "quiet");
}

void addRecovery(Html& html, const TruthRecovery& recovery, const std::vector<NamedFigure>& figures) {
  if (recovery.counts.empty()) return;
  html.heading(3, "What this design can tell");
  addFigure(html, figures, "recovery");
  std::size_t right = 0, wrong = 0, all = 0;
  for (std::size_t t = 0; t + 1 < recovery.counts.size(); ++t)
    for (std::size_t k = 0; k < recovery.counts[t].size(); ++k) {
      all += recovery.counts[t][k];
      if (k == t) right += recovery.counts[t][k];
      else if (k + 1 < recovery.counts[t].size()) wrong += recovery.counts[t][k];
    }
  html.paragraph(
      fmt::format("Of {} studies that were simulated with a criterion for truth, {} named it, {} named another, {} stayed undecided.", all,
                  right, wrong, all - right - wrong));
  if (recovery.others.empty()) return;
  html.table({"People who move otherwise", "named right", "named wrong", "share of wrong names", "undecided"});
  for (const OtherTruth& o : recovery.others)
    html.row({std::string(o.name), std::to_string(o.right), std::to_string(o.wrong), shareText(o.wrong, o.studies()),
              std::to_string(o.undecided)});
  html.endTable();
}

void addAlternatives(Html& html, const Analysis& analysis) {
  const std::string sentence = describeAlternatives(analysis);
  if (sentence.empty()) return;
  html.heading(3, "Other choices of the analysis");
  html.paragraph(sentence);
  html.table({"Choice", "Condition", "Criterion", "Closest", "p"});
  for (const AlternativeConclusion& row : analysis.alternatives) {
    const std::string criterion = row.criterion();
    html.row({row.choice, escaped(row.condition),
              criterion.empty() ? fmt::format("undecided: {}", nameOf(row.conclusion.reason))
              : row.changed     ? "<b>" + criterion + "</b>"
                                : criterion,
              row.best(), row.p() ? shortNumber(*row.p()) : ""});
  }
  html.endTable();
}

void addMeasures(Html& html, const Analysis& analysis, std::size_t condition) {
  const auto summary = [&](const Measure& measure, bool success) -> std::string {
    std::vector<double> values;
    for (const AnalyzedTrial& t : analysis.trials)
      if (t.condition == condition && t.counted && (t.result.outcome == trial::Outcome::Success) == success)
        values.push_back(measure.scale * t.measures.*measure.value);
    const MeanSd s = computeMeanSd(values);
    if (s.count == 0) return "–";
    return real(std::isfinite(s.sd) ? fmt::format("{:.{}f} ± {:.{}f}", s.mean, measure.digits, s.sd, measure.digits)
                                    : fmt::format("{:.4g}", s.mean));
  };
  html.table({"Measure (mean ± SD over trials)", "successes", "failures"});
  for (const Measure& measure : measures()) html.row({std::string(measure.label), summary(measure, true), summary(measure, false)});
  html.endTable();
}

void addCondition(Html& html, const Analysis& analysis, std::size_t c, const std::vector<NamedFigure>& figures) {
  const ConditionResult& r = analysis.results[c];
  const std::vector<std::vector<predict::Criterion>> names = namesOf(r.candidates);
  const std::string file = fileNameOf(analysis.conditions[c].name);
  html.heading(2, analysis.conditions[c].name);
  html.paragraph("Moved: " + experiment::describe(analysis.conditions[c].experiment()) + ".");
  html.paragraph(describeCounts(r));
  if (r.onlyFailures)
    html.paragraph(
        "No trial succeeded. Profiles and errors below are of the failed trials, for description only; the paper's error is of successful "
        "ones, and nothing is concluded.",
        "warning");
  if (analysis.conditions.size() > 1) {
    html.paragraph(describeConclusion(r.conclusion, names), "finding");
    if (r.conclusion.best) {
      html.paragraph(describeEvidence(r.conclusion, names));
      addScores(html, r.conclusion, names);
    }
  }
  addFigure(html, figures, "people_" + file);
  addFigure(html, figures, "velocity_" + file);
  addFigure(html, figures, "last_five_" + file);
  addFits(html, analysis, c);
  if (!r.refusals.empty()) {
    html.add("<p class=\"quiet\">Not predicted here:</p><ul class=\"quiet\">");
    for (const std::string& refusal : r.refusals) html.add("<li>" + escaped(refusal) + "</li>");
    html.add("</ul>");
  }
  std::set<std::string> warnings;
  for (const PredictedSignal& p : r.signals)
    for (const std::string& w : p.warnings) warnings.insert(numberedName(p.criterion) + ": " + w);
  for (const std::string& w : warnings) html.paragraph(w, "warning");
  addMeasures(html, analysis, c);
}

void addProvenance(Html& html, const std::vector<AnalysedRun>& runs, const std::vector<std::string>& notes) {
  html.heading(2, "Recordings");
  html.table({"Subject", "session", "run", "condition", "trials", "device", "method", "seed", "samples (Hz)", "started (UTC)", "software"},
             {3, 5, 6, 9, 10});
  for (const AnalysedRun& run : runs) {
    const record::RunConfiguration& c = run.configuration;
    html.row({escaped(c.subject), escaped(c.session), std::to_string(c.run),
              escaped(record::conditionOf(c)) + (c.practice ? " (practice)" : ""), std::to_string(run.trials), escaped(c.device),
              escaped(c.method), std::to_string(c.sessionSeed), fmt::format("{:g}", c.samplingHz), escaped(c.startedUtc),
              escaped(c.softwareVersion)});
  }
  html.endTable();
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

std::string makeReport(const ReportHeader& header, const Analysis& analysis, const std::vector<NamedFigure>& figures,
                       const std::vector<AnalysedRun>& runs, const std::vector<std::string>& notes,
                       const std::optional<TruthRecovery>& recovery) {
  Html html;
  html.add(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width\">");
  html.add("<title>Reaching: " + escaped(header.dataset) + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>");
  html.heading(1, "Reaching movements: " + header.dataset);
  std::size_t trials = 0;
  for (const AnalysedRun& run : runs) trials += run.trials;
  html.paragraph(
      fmt::format("{}, {}, {} recorded, {}. Reachlab {}.", plural(analysis.subjects.size(), "subject"), plural(runs.size(), "run"),
                  plural(trials, "trial"), plural(analysis.conditions.size(), "condition"), header.version),
      "quiet");
  const std::string learning = describeLearning(analysis);
  if (!learning.empty()) {
    html.paragraph(learning, "answer finding");
    addFigure(html, figures, "adaptation");
    html.heading(2, "Optimality criteria");
  }
  const std::string sentence = describeConclusion(analysis.overall, analysis.common);
  html.paragraph((analysis.conditions.size() > 1 ? "Conditions together: " : "") + sentence,
                 learning.empty() ? "answer finding" : "finding");
  addFigure(html, figures, "scores");
  if (analysis.overall.best) {
    html.paragraph(describeEvidence(analysis.overall, analysis.common));
    if (const std::string over = describeTogether(analysis); !over.empty()) html.paragraph(over);
    html.paragraph(describeChoices(analysis, analysis.together, analysis.common[*analysis.overall.best]));
    addScores(html, analysis.overall, analysis.common);
    addFigure(html, figures, "posterior");
  } else if (std::any_of(analysis.results.begin(), analysis.results.end(), [](const ConditionResult& r) { return r.onlyFailures; }) &&
             std::none_of(analysis.results.begin(), analysis.results.end(),
                          [](const ConditionResult& r) { return r.used > 0 && !r.onlyFailures; })) {
    html.paragraph("No trial succeeded. What the failed ones were like is described below, condition by condition.", "warning");
  }
  addAlternatives(html, analysis);
  if (recovery) addRecovery(html, *recovery, figures);
  addSuccessTable(html, analysis);
  if (!analysis.success.empty()) addProgress(html, analysis, figures);
  for (std::size_t c = 0; c < analysis.conditions.size(); ++c) addCondition(html, analysis, c, figures);
  html.heading(2, "Methods");
  html.paragraph(describeMethods(analysis));
  html.paragraph(describeLimits(analysis));
  html.paragraph(
      "Definitions of all measures and columns: docs/analysis.md of Reachlab. Every number of a figure is in a CSV file beside this page.");
  for (const std::string& option : header.plan) html.paragraph(option);
  html.paragraph("Command: " + header.command, "quiet");
  addProvenance(html, runs, notes);
  html.add("</body>\n</html>");
  return html.text;
}

}  // namespace reachlab::analysis
