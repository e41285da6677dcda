#include "analysis/report/figures.h"

#include <algorithm>

#include "analysis/tables.h"

namespace reachlab::analysis {

namespace palette = figure::palette;
using figure::Dash;
using predict::Criterion;

CriterionLook lookOf(const std::vector<Criterion>& criteria) {
  constexpr std::array<int, 3> kGreyOnDark{180, 180, 180}, kGreyOnLight{95, 95, 95};
  if (criteria.empty()) return {palette::kGrey, Dash::Dotted, kGreyOnDark, kGreyOnLight};
  switch (criteria.front()) {
    case Criterion::MinHandJerk: return {palette::kBlue, Dash::Solid, {240, 228, 66}, {140, 110, 0}};
    case Criterion::MinTorqueChange: return {palette::kSky, Dash::DashDot, {204, 121, 167}, {160, 60, 115}};
    case Criterion::MinCrackle: return {palette::kVermilion, Dash::Dashed, {0, 200, 160}, {0, 120, 105}};
    case Criterion::MinHandForce: return {palette::kPurple, Dash::Dotted, {230, 90, 90}, {190, 35, 35}};
    case Criterion::MinHandForceChange: return {palette::kGreen, Dash::DashDot, {86, 220, 110}, {55, 125, 0}};
    case Criterion::MinComAcceleration: return {palette::kOrange, Dash::Dashed, {190, 150, 255}, {110, 70, 190}};
    case Criterion::MinHandCrackle: return {palette::kOrange, Dash::DashDot, kGreyOnDark, kGreyOnLight};
    default: return {palette::kBlack, Dash::Solid, kGreyOnDark, kGreyOnLight};  // a criterion that is missing in this table
  }
}

std::string shortNameOf(const std::vector<Criterion>& criteria) {
  if (criteria.empty()) return "ref.";
  std::string text;
  for (const Criterion c : criteria) {
    const std::string name = numberedName(c);
    text += (text.empty() ? "(" : ", ") + name.substr(1, name.find(')') - 1);
  }
  return text + ")";
}

int subjectIndex(const Analysis& analysis, const std::string& subject) {
  return static_cast<int>(std::find(analysis.subjects.begin(), analysis.subjects.end(), subject) - analysis.subjects.begin());
}

figure::Panel velocityPanel(const std::string& title, bool object) {
  return {.title = title,
          .x = {.label = "Time from onset (s)"},
          .y = {.label = object ? "Object velocity (m/s)" : "Hand velocity (m/s)"},
          .legend = figure::LegendPlace::Below};
}

std::vector<double> profileTimes(double duration) {
  std::vector<double> t(kProfilePoints);
  for (std::size_t i = 0; i < kProfilePoints; ++i) t[i] = duration * static_cast<double>(i) / static_cast<double>(kProfilePoints - 1);
  return t;
}

figure::Series subjectSeries(const Analysis& analysis, const std::string& subject) {
  const int i = subjectIndex(analysis, subject);
  return {.label = "subject " + subject, .color = palette::series(i), .marker = figure::markerOf(i)};
}

void addCandidates(figure::Axis& axis, std::span<const std::vector<Criterion>> candidates) {
  axis.from = 0.4;
  axis.to = static_cast<double>(candidates.size()) + 0.6;
  for (std::size_t k = 0; k < candidates.size(); ++k) axis.ticks.emplace_back(static_cast<double>(k + 1), shortNameOf(candidates[k]));
}

std::string shortened(const std::string& text, std::size_t most) { return text.size() <= most ? text : text.substr(0, most - 1) + "…"; }

std::vector<NamedFigure> makeFigures(const Analysis& analysis, const std::optional<TruthRecovery>& recovery) {
  std::vector<NamedFigure> out;
  const auto add = [&](NamedFigure figure) {
    if (!figure.figure.panels.empty()) out.push_back(std::move(figure));
  };
  add(scoreFigure(analysis));
  add(posteriorFigure(analysis));
  if (recovery && !recovery->counts.empty()) add(recoveryFigure(*recovery));
  for (std::size_t c = 0; c < analysis.conditions.size(); ++c) {
    if (analysis.results[c].used == 0 && analysis.results[c].signals.empty()) continue;
    add(paperFigure(analysis, c));
    add(lastFiveFigure(analysis, c));
    add(peopleFigure(analysis, c));
  }
  add(learningFigure(analysis));
  add(adaptationFigure(analysis));
  return out;
}

}  // namespace reachlab::analysis
