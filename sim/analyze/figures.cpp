#include "sim/analyze/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/analyze/tables.h"

namespace reachlab::analyze {
namespace {

constexpr std::size_t kMostTrials = 60;  // more thin lines than this are a blot, not data

std::vector<double> timeAxis(double duration) {
  std::vector<double> t(kProfilePoints);
  for (std::size_t i = 0; i < kProfilePoints; ++i) t[i] = duration * static_cast<double>(i) / static_cast<double>(kProfilePoints - 1);
  return t;
}

struct CriterionLook {
  figure::Color color;
  figure::Dash dash;
};
CriterionLook lookOf(predict::Criterion criterion) {
  switch (criterion) {
    case predict::Criterion::MinHandJerk: return {figure::palette::kBlue, figure::Dash::Solid};
    case predict::Criterion::MinTorqueChange: return {figure::palette::kSky, figure::Dash::DashDot};
    case predict::Criterion::MinCrackle: return {figure::palette::kVermilion, figure::Dash::Dashed};
    case predict::Criterion::MinHandForce: return {figure::palette::kPurple, figure::Dash::Dotted};
    case predict::Criterion::MinHandForceChange: return {figure::palette::kGreen, figure::Dash::DashDot};
    case predict::Criterion::MinComAcceleration: return {figure::palette::kOrange, figure::Dash::Dashed};
    case predict::Criterion::MinHandCrackle: return {figure::palette::kGrey, figure::Dash::Dashed};
  }
  return {figure::palette::kBlack, figure::Dash::Solid};
}

figure::Series predictionSeries(const PredictedProfile& p, double duration, bool object) {
  const CriterionLook look = lookOf(p.criterion);
  figure::Series s;
  s.label = numberedName(p.criterion);
  s.x = timeAxis(duration);
  s.y = object ? p.object : p.hand;
  s.color = look.color;
  s.dash = look.dash;
  s.width = 1.3;
  return s;
}

void addTrials(figure::Panel& panel, const StudyResult& study, std::size_t condition, bool object) {
  const ConditionResult& r = study.results[condition];
  std::vector<const StudyTrial*> used;
  for (const StudyTrial& t : study.trials)
    if (t.condition == condition && t.used()) used.push_back(&t);
  const std::size_t shown = std::min(used.size(), kMostTrials);
  for (std::size_t i = 0; i < shown; ++i) {
    const StudyTrial& trial = *used[i * used.size() / shown];
    figure::Series s;
    if (i == 0) {
      const std::string what = fmt::format("{}trial{}", r.onlyFailures ? "failed " : "", used.size() == 1 ? "" : "s");
      s.label = shown == used.size() ? fmt::format("{} {}", shown, what) : fmt::format("{} of {} {}", shown, used.size(), what);
    }
    s.x = timeAxis(r.duration.mean);
    for (const double v : object ? trial.object : trial.hand) s.y.push_back(v * trial.measures.duration / r.duration.mean);
    s.color = figure::palette::faded(figure::palette::kGrey, 0.45);
    s.width = figure::kThin;
    panel.series.push_back(std::move(s));
  }
}

void addMean(figure::Panel& panel, const MeanProfile& profile, double duration) {
  figure::Series mean;
  mean.label = "mean";
  mean.x = timeAxis(duration);
  mean.y = profile.mean;
  mean.width = 2.8;  // so that a prediction drawn over it leaves both to be seen
  figure::Band band;
  band.label = "± SD";
  band.x = mean.x;
  for (std::size_t i = 0; i < profile.mean.size(); ++i) {
    band.low.push_back(profile.mean[i] - profile.sd[i]);
    band.high.push_back(profile.mean[i] + profile.sd[i]);
  }
  if (!profile.sd.empty() && std::isfinite(profile.sd.front())) panel.bands.push_back(band);
  panel.series.push_back(mean);
}

figure::Panel velocityPanel(const char* title, const char* label) {
  figure::Panel panel;
  panel.title = title;
  panel.x.label = "Time from onset (s)";
  panel.y.label = label;
  panel.legend = figure::LegendPlace::Below;
  return panel;
}

double shownDuration(const ConditionResult& r, const PredictedProfile& p) { return r.used > 0 ? r.duration.mean : p.duration; }

/// A title that a panel of a grid can bear.
std::string shortened(const std::string& text, std::size_t most = 34) {
  return text.size() <= most ? text : text.substr(0, most - 1) + "…";
}

figure::Panel rankingPanel(const std::string& title, const Ranking& ranking, const std::vector<predict::Criterion>& criteria) {
  figure::Panel panel;
  panel.title = shortened(title);
  panel.x.label = "RMS error ε of hand velocity (m/s)";
  panel.x.from = 0.0;
  panel.legend = figure::LegendPlace::None;
  const double n = static_cast<double>(ranking.places.size());
  panel.y.from = 0.4;
  panel.y.to = n + 0.6;
  for (std::size_t i = 0; i < ranking.places.size(); ++i) {
    const RankedCriterion& p = ranking.places[i];
    const double y = n - static_cast<double>(i);
    panel.y.ticks.emplace_back(y, numberedName(criteria[p.criterion]));
    figure::Series s;
    s.x = {p.epsilon};
    s.y = {y};
    s.errorLeft = {p.interval.low};
    s.errorRight = {p.interval.high};
    s.width = 0;
    s.marker = figure::Marker::Circle;
    // Filled dark: the first, and whatever cannot be told from it.
    s.color = i == 0 || !p.apartFromFirst ? figure::palette::kBlue : figure::palette::kGrey;
    panel.series.push_back(s);
  }
  return panel;
}

}  // namespace

NamedFigure velocityFigure(const StudyResult& study, std::size_t condition) {
  const ConditionResult& r = study.results[condition];
  NamedFigure out;
  out.name = "velocity_" + fileNameOf(study.conditions[condition].name);
  figure::Panel hand = velocityPanel("(a) Hand", "Hand velocity (m/s)"),
                object = velocityPanel("(b) Object (last mass)", "Object velocity (m/s)");
  std::optional<predict::Criterion> best;
  if (!r.handRanking.places.empty()) best = r.predictions[r.handRanking.places.front().criterion].criterion;
  for (figure::Panel* panel : {&hand, &object}) {
    const bool isObject = panel == &object;
    addTrials(*panel, study, condition, isObject);
    if (r.used > 0) addMean(*panel, isObject ? r.object : r.hand, r.duration.mean);
    for (const PredictedProfile& p : r.predictions)
      if (p.criterion == predict::Criterion::MinHandJerk || p.criterion == predict::Criterion::MinCrackle || p.criterion == best)
        panel->series.push_back(predictionSeries(p, shownDuration(r, p), isObject));
  }
  out.figure.columns = 2;
  out.figure.panels = {hand, object};
  out.caption = r.used > 0 ? fmt::format("{}: velocity of hand and object, {} {} trial{} time-scaled to their mean duration of {:.3f} s.",
                                         study.conditions[condition].name, r.used, r.onlyFailures ? "failed" : "successful",
                                         r.used == 1 ? "" : "s", r.duration.mean)
                           : fmt::format("{}: no movement to show; predictions only.", study.conditions[condition].name);
  return out;
}

NamedFigure predictionFigure(const StudyResult& study, std::size_t condition) {
  const ConditionResult& r = study.results[condition];
  NamedFigure out;
  out.name = "predictions_" + fileNameOf(study.conditions[condition].name);
  figure::Panel hand = velocityPanel("(a) Hand", "Hand velocity (m/s)"),
                object = velocityPanel("(b) Object (last mass)", "Object velocity (m/s)");
  for (figure::Panel* panel : {&hand, &object}) {
    const bool isObject = panel == &object;
    if (r.used > 0) addMean(*panel, isObject ? r.object : r.hand, r.duration.mean);
    for (const PredictedProfile& p : r.predictions) panel->series.push_back(predictionSeries(p, shownDuration(r, p), isObject));
  }
  out.figure.columns = 2;
  out.figure.panels = {hand, object};
  out.caption =
      fmt::format("{}: {}every criterion's prediction.", study.conditions[condition].name, r.used > 0 ? "the mean profile and " : "");
  return out;
}

NamedFigure rankingFigure(const StudyResult& study) {
  NamedFigure out;
  out.name = "ranking";
  out.caption =
      "RMS error of each criterion with its 95 % bootstrap interval over trials. Blue: the nearest criterion and those that cannot be told "
      "from it.";
  std::size_t shown = 0;
  for (std::size_t c = 0; c < study.results.size(); ++c) {
    const ConditionResult& r = study.results[c];
    if (r.handRanking.places.empty()) continue;
    std::vector<predict::Criterion> criteria;
    for (const PredictedProfile& p : r.predictions) criteria.push_back(p.criterion);
    out.figure.panels.push_back(rankingPanel(study.conditions[c].name, r.handRanking, criteria));
    ++shown;
  }
  if (shown > 1 && !study.overall.places.empty()) out.figure.panels.push_back(rankingPanel("All conditions", study.overall, study.common));
  out.figure.columns = out.figure.panels.size() > 1 ? 2 : 1;
  out.figure.panelWidth = 62;
  out.figure.panelHeight = 38;
  return out;
}

NamedFigure learningFigure(const StudyResult& study) {
  NamedFigure out;
  out.name = "learning";
  out.caption =
      fmt::format("Success in groups of {} trials, in the order they were made, with Wilson's 95 % interval. A broken line parts sessions.",
                  study.options.learningBin);
  for (std::size_t c = 0; c < study.conditions.size(); ++c) {
    figure::Panel panel;
    panel.title = shortened(study.conditions[c].name);
    panel.x.label = "Trial";
    panel.y.label = "Success (%)";
    panel.y.from = 0.0;
    panel.y.to = 100.0;
    panel.x.from = 0.0;
    std::map<std::string, figure::Series> bySubject;
    std::map<std::string, std::string> session;
    for (const LearningPoint& p : study.learning) {
      if (p.condition != c) continue;
      figure::Series& s = bySubject[p.subject];
      const bool newSession = !s.x.empty() && session[p.subject] != p.session;
      session[p.subject] = p.session;
      const int i = static_cast<int>(std::find(study.subjects.begin(), study.subjects.end(), p.subject) - study.subjects.begin());
      s.label = "subject " + p.subject;
      s.color = figure::palette::series(i);
      s.marker = figure::markerOf(i);
      const auto add = [&](double x, double y, double low, double high) {
        s.x.push_back(x), s.y.push_back(y), s.errorLow.push_back(low), s.errorHigh.push_back(high);
      };
      if (newSession) add(kNotMeasured, kNotMeasured, kNotMeasured, kNotMeasured);
      // Subjects stand a little beside one another, so that their bars do not cover each other.
      const double beside = 0.12 * study.options.learningBin * (i - 0.5 * static_cast<double>(study.subjects.size() - 1));
      add(0.5 * (p.firstTrial + p.lastTrial) + (study.subjects.size() > 6 ? 0 : beside),
          100.0 * static_cast<double>(p.successes) / static_cast<double>(p.trials), 100 * p.interval.low, 100 * p.interval.high);
    }
    for (auto& [subject, series] : bySubject) panel.series.push_back(std::move(series));
    panel.legend = c == 0 ? figure::LegendPlace::Below : figure::LegendPlace::None;
    if (!panel.series.empty()) out.figure.panels.push_back(std::move(panel));
  }
  out.figure.columns = static_cast<int>(std::min<std::size_t>(3, std::max<std::size_t>(1, out.figure.panels.size())));
  out.figure.panelWidth = out.figure.columns == 1 ? 90 : 52;
  out.figure.panelHeight = 40;
  return out;
}

std::vector<NamedFigure> makeFigures(const StudyResult& study) {
  std::vector<NamedFigure> out;
  for (std::size_t c = 0; c < study.conditions.size(); ++c) {
    if (study.results[c].used == 0 && study.results[c].predictions.empty()) continue;
    out.push_back(velocityFigure(study, c));
    if (!study.results[c].predictions.empty()) out.push_back(predictionFigure(study, c));
  }
  for (NamedFigure figure : {rankingFigure(study), learningFigure(study)})
    if (!figure.figure.panels.empty()) out.push_back(std::move(figure));
  return out;
}

}  // namespace reachlab::analyze
