#include <fmt/format.h>

#include <algorithm>

#include "analysis/report/figures.h"

namespace reachlab::analysis {
namespace {

namespace palette = figure::palette;
using figure::LegendPlace;
using figure::Panel;
using figure::Series;

using Names = std::vector<std::vector<predict::Criterion>>;

Panel scorePanel(const Analysis& analysis, std::size_t condition, const std::vector<const PersonResult*>& people, bool legend) {
  const ConditionResult& result = analysis.results[condition];
  Panel panel{.title = shortened(analysis.conditions[condition].name),
              .x = {.label = "Criterion"},
              .y = {.label = "Score against the reference (ln S)"}};
  const Names names = namesOf(result.candidates);
  const std::size_t shown = names.size() - 1;  // the reference is the line at 0
  addCandidates(panel.x, std::span(names).first(shown));
  double ceiling = 0;
  for (std::size_t i = 0; i < people.size(); ++i) {
    const PersonFit& person = people[i]->fit;
    const CandidateFit& reference = person.candidates.back();
    // Beside one another, so that intervals do not hide one another.
    const double aside = people.size() > 1 ? 0.5 * (static_cast<double>(i) / static_cast<double>(people.size() - 1) - 0.5) : 0;
    Series s = subjectSeries(analysis, people[i]->subject);
    if (!legend) s.label.clear();
    for (std::size_t k = 0; k < shown; ++k) {
      const CandidateFit& fit = person.candidates[k];
      const double score = fit.meanScore - reference.meanScore;
      const Bounds interval = intervalOf(computeSerialTTest(subtract(fit.score, reference.score)));  // 95 %, over the person's trials
      s.x.push_back(static_cast<double>(k + 1) + aside), s.y.push_back(score);
      s.errorLow.push_back(interval.finite() ? interval.low : score), s.errorHigh.push_back(interval.finite() ? interval.high : score);
      if (fit.mass && fit.mass->atEdge) panel.words.push_back({s.x[k], s.errorHigh[k], "*", palette::kVermilion});
    }
    s.width = 0;  // criteria have no order that a line could follow
    panel.series.push_back(std::move(s));
    ceiling += (person.own.ceilingScore - reference.meanScore) / static_cast<double>(people.size());
  }
  panel.rules.push_back({0, false, "reference", palette::kBlack, figure::Dash::Dashed});
  panel.rules.push_back({ceiling, false, "own mean", palette::kGrey, figure::Dash::Dotted});
  if (const auto& follows = result.conclusion.follows)
    panel.rules.push_back({static_cast<double>(*follows + 1), true, "decided", palette::kBlue, figure::Dash::Dotted});
  panel.legend = legend && people.size() > 1 ? LegendPlace::Below : LegendPlace::None;
  return panel;
}

}  // namespace

NamedFigure scoreFigure(const Analysis& analysis) {
  NamedFigure out{.name = "scores"};
  out.caption =
      "How far each criterion is from the movements: a subject's score (mean of ln S, lower is nearer) less that of a minimum jerk that "
      "ignores the object, with its 95 % interval over the subject's trials. Dashed: that reference. Dotted: what the mean of a subject's own other trials "
      "reaches, below which nothing can be expected. An asterisk: the hand's mass that fits best is an end of its range.";
  for (std::size_t c = 0; c < analysis.results.size(); ++c) {
    std::vector<const PersonResult*> people;
    for (const PersonResult& person : analysis.people)
      if (person.condition == c && person.fitted) people.push_back(&person);
    if (!people.empty()) out.figure.panels.push_back(scorePanel(analysis, c, people, out.figure.panels.empty()));
  }
  out.figure.columns = out.figure.panels.size() > 1 ? 2 : 1;
  out.figure.panelWidth = out.figure.columns == 1 ? 100 : 62;
  out.figure.panelHeight = out.figure.columns == 1 ? 60 : 45;
  return out;
}

NamedFigure posteriorFigure(const Analysis& analysis) {
  NamedFigure out{.name = "posterior"};
  out.caption = fmt::format(
      "Probability that each candidate is the most frequent among people (protected exceedance). Broken line: the {:.2f} that a conclusion "
      "asks for, beside p.",
      kMinExceedance);
  const auto add = [&](const std::string& title, const Conclusion& conclusion, const Names& names) {
    if (conclusion.posterior.empty()) return;
    Panel panel{.title = shortened(title), .y = {.label = "Probability", .from = 0.0, .to = 1.0}, .legend = LegendPlace::None};
    addCandidates(panel.x, names);
    for (std::size_t k = 0; k < names.size(); ++k) {
      const double x = static_cast<double>(k + 1), p = conclusion.posterior[k];
      panel.bands.push_back({"", {x - 0.35, x + 0.35}, {0, 0}, {p, p}, palette::faded(lookOf(names[k]).color, 0.8)});
    }
    panel.rules.push_back({kMinExceedance, false, "", palette::kGrey, figure::Dash::Dashed});
    out.figure.panels.push_back(std::move(panel));
  };
  for (std::size_t c = 0; c < analysis.results.size(); ++c)
    add(analysis.conditions[c].name, analysis.results[c].conclusion, namesOf(analysis.results[c].candidates));
  if (analysis.results.size() > 1) add("All conditions", analysis.overall, analysis.common);
  out.figure.columns = static_cast<int>(std::clamp<std::size_t>(out.figure.panels.size(), 1, 2));
  out.figure.panelWidth = 62;
  out.figure.panelHeight = 32;
  return out;
}

NamedFigure recoveryFigure(const TruthRecovery& recovery) {
  NamedFigure out{.name = "recovery"};
  out.caption = fmt::format(
      "What this design can tell: {} studies were simulated for each truth, with these subjects' numbers of trials, durations and scatter, "
      "and judged by the same rule. Rows: the truth; columns: what was named.",
      recovery.studies);
  const std::size_t n = recovery.candidates.size();
  Panel panel{.x = {.label = "Named", .from = 0.5, .to = static_cast<double>(n) + 1.5},
              .y = {.label = "Truth", .from = 0.5, .to = static_cast<double>(n) + 0.5},
              .legend = LegendPlace::None};
  for (std::size_t t = 0; t < n; ++t) {
    const double y = static_cast<double>(n - t);
    panel.y.ticks.emplace_back(y, shortNameOf(recovery.candidates[t]));
    for (std::size_t k = 0; k <= n; ++k) {
      const double x = static_cast<double>(k + 1), share = static_cast<double>(recovery.counts[t][k]) / std::max(1, recovery.studies);
      if (t == 0) panel.x.ticks.emplace_back(x, k < n ? shortNameOf(recovery.candidates[k]) : "undecided");
      const figure::Color color = k == n ? palette::kGrey : k == t ? palette::kBlue : palette::kVermilion;
      panel.bands.push_back(
          {"", {x - 0.47, x + 0.47}, {y - 0.46, y - 0.46}, {y + 0.46, y + 0.46}, palette::faded(color, 0.08 + 0.72 * share)});
      panel.words.push_back({x, y, fmt::format("{}", recovery.counts[t][k]), share > 0.6 ? figure::Color{1, 1, 1} : palette::kBlack});
    }
  }
  out.figure.panels.push_back(std::move(panel));
  out.figure.panelWidth = 105;
  out.figure.panelHeight = 62;
  return out;
}

}  // namespace reachlab::analysis
