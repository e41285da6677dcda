#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "analysis/report/figures.h"

namespace reachlab::analysis {

namespace {

constexpr std::size_t kFewPeople = 2;  // with more, bars of each would cover one another

/// The share of a typical person in each group of trials that two or more made. A person who missed an attempt has groups of other trials
/// than the rest, so groups meet by session and place in it.
figure::Series typicalCourse(const Analysis& analysis, std::size_t condition) {
  struct Group {
    std::vector<SuccessCell> cells;
    std::vector<double> middles;
  };
  std::map<std::pair<std::string, int>, Group> groups;
  const LearningPoint* before = nullptr;
  int place = 0;
  for (const LearningPoint& p : analysis.learning) {
    if (p.condition != condition) continue;
    place = before != nullptr && before->subject == p.subject && before->session == p.session ? place + 1 : 0;
    before = &p;
    Group& group = groups[{p.session, place}];
    group.cells.push_back({p.subject, 0, condition, p.successes, p.trials, {}});
    group.middles.push_back(0.5 * (p.firstTrial + p.lastTrial));
  }
  figure::Series s{.label = "a typical subject", .width = figure::kThick, .marker = figure::MarkerShape::Circle};
  const auto add = [&](double x, double share, const Bounds& interval) {
    s.x.push_back(x), s.y.push_back(100 * share);
    s.errorLow.push_back(100 * interval.low), s.errorHigh.push_back(100 * interval.high);
  };
  std::string session;
  for (const auto& [where, group] : groups) {
    const auto typical = typicalShare(group.cells, condition);
    if (!typical) continue;
    if (where.first != std::exchange(session, where.first) && !s.x.empty()) add(kNotMeasured, kNotMeasured, {kNotMeasured, kNotMeasured});
    add(averageOf(group.middles), typical->mean, typical->interval);
  }
  return s;
}

}  // namespace

NamedFigure learningFigure(const Analysis& analysis) {
  NamedFigure out{.name = "learning"};
  const bool few = analysis.subjects.size() <= kFewPeople;
  out.caption =
      fmt::format("Success in groups of {} trials, in the order they were made{} A gap parts sessions.", analysis.options.learningBin,
                  few ? ", with exact 95 % intervals of each subject's share (Clopper and Pearson)."
                      : ": thin, each subject (its exact intervals are in learning.csv); thick, a typical subject (mean of the "
                        "subjects' logits) with its 95 % interval over subjects.");
  for (std::size_t c = 0; c < analysis.conditions.size(); ++c) {
    figure::Panel panel{.title = shortened(analysis.conditions[c].name),
                        .x = {.label = "Trial", .from = 0.0},
                        .y = {.label = "Success (%)", .from = 0.0, .to = 100.0},
                        .legend = c == 0 ? figure::LegendPlace::Below : figure::LegendPlace::None};
    std::map<std::string, figure::Series> bySubject;
    std::map<std::string, std::string> session;
    for (const LearningPoint& p : analysis.learning) {
      if (p.condition != c) continue;
      figure::Series& s = bySubject.try_emplace(p.subject, subjectSeries(analysis, p.subject)).first->second;
      const bool newSession = !s.x.empty() && session[p.subject] != p.session;
      session[p.subject] = p.session;
      if (!few) s.width = figure::kThin, s.marker = figure::MarkerShape::None;
      const auto add = [&](double x, double y, double low, double high) {
        s.x.push_back(x), s.y.push_back(y);
        if (few) s.errorLow.push_back(low), s.errorHigh.push_back(high);
      };
      if (newSession) add(kNotMeasured, kNotMeasured, kNotMeasured, kNotMeasured);
      // Subjects stand a little beside one another, so that their bars do not cover each other.
      const double beside = 0.12 * analysis.options.learningBin *
                            (subjectIndex(analysis, p.subject) - 0.5 * static_cast<double>(analysis.subjects.size() - 1));
      add(0.5 * (p.firstTrial + p.lastTrial) + (few ? beside : 0), 100.0 * static_cast<double>(p.successes) / static_cast<double>(p.trials),
          100 * p.interval.low, 100 * p.interval.high);
    }
    for (auto& [subject, series] : bySubject) panel.series.push_back(std::move(series));
    if (!few && !panel.series.empty()) panel.series.push_back(typicalCourse(analysis, c));
    if (!panel.series.empty()) out.figure.panels.push_back(std::move(panel));
  }
  out.figure.columns = static_cast<int>(std::min<std::size_t>(3, std::max<std::size_t>(1, out.figure.panels.size())));
  out.figure.panelWidth = out.figure.columns == 1 ? 90 : 52;
  out.figure.panelHeight = 40;
  return out;
}

}  // namespace reachlab::analysis
