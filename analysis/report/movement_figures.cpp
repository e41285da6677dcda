#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/report/figures.h"
#include "analysis/report/wording.h"
#include "analysis/tables.h"
#include "sim/experiment/experiment.h"

namespace reachlab::analysis {
namespace {

namespace palette = figure::palette;
using figure::Band;
using figure::Dash;
using figure::LegendPlace;
using figure::Panel;
using figure::Series;
using predict::Criterion;

constexpr std::size_t kMaxTrialsDrawn = 60;  // more thin lines than this are a blot, not data

void addThin(Panel& panel, const Analysis& analysis, const std::vector<const AnalyzedTrial*>& trials, double duration, bool object,
             const std::string& label) {
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const TrialProfile profile = analysis.profileOf(*trials[i]);
    Series s{
        .label = i == 0 ? label : "", .x = profileTimes(duration), .color = palette::faded(palette::kGrey, 0.5), .width = figure::kThin};
    for (const double v : object ? profile.object : profile.hand) s.y.push_back(v * profile.duration / duration);
    panel.series.push_back(std::move(s));
  }
}

/// What a prediction's time is counted from.
enum class Zero { Onset, Start };

void addPrediction(Panel& panel, const PredictedSignal& signal, bool object, const figure::Color& color, Dash dash, double width,
                   Zero zero) {
  PredictedCurve curve = curveOf(signal);
  if (zero == Zero::Start)
    for (double& t : curve.time) t += signal.onset - signal.begin;
  panel.series.push_back({.label = fmt::format("{}, T = {} s", numberedName(signal.criterion), shortNumber(signal.plannedDuration)),
                          .x = std::move(curve.time),
                          .y = object ? std::move(curve.object) : std::move(curve.hand),
                          .color = color,
                          .width = width,
                          .dash = dash});
}

void addPrediction(Panel& panel, const ConditionResult& r, Criterion criterion, bool object, const figure::Color& color, Dash dash,
                   double width, Zero zero = Zero::Onset) {
  for (const PredictedSignal& signal : r.signals)
    if (signal.criterion == criterion) addPrediction(panel, signal, object, color, dash, width, zero);
}

/// What the thick lines of the paper's figure are, of the predictions that the condition has.
std::string describeThick(const ConditionResult& r, bool moved) {
  std::string which;
  if (r.predicts(Criterion::MinHandJerk)) which = "criterion (1) solid";
  if (r.predicts(Criterion::MinCrackle)) which += which.empty() ? "criterion (3) dashed" : ", (3) dashed";
  if (which.empty()) return "Neither criterion (1) nor (3) is shown.";
  return fmt::format("Thick: {}, {}.", which,
                     moved
                         ? "for the T whose movement lasts as long; above aligned at the onset, below with their t = 0 on the trials' onset"
                         : "for the task's T, neither cut nor stretched; above they begin before the onset by as much as the onset rule "
                           "would leave out of them, below their t = 0 is put on the trials' onset");
}

std::vector<const AnalyzedTrial*> usedTrials(const Analysis& analysis, std::size_t condition) {
  std::vector<const AnalyzedTrial*> used;
  for (const AnalyzedTrial& t : analysis.trials)
    if (t.condition == condition && t.used() && t.profile.size > 0) used.push_back(&t);
  return used;
}

/// One scale of y for all panels, so that people can be compared.
void shareScale(std::vector<Panel>& panels) {
  double low = 0, high = 0;
  const auto take = [&](const std::vector<double>& values) {
    for (const double v : values)
      if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  };
  for (const Panel& panel : panels) {
    for (const Series& s : panel.series) take(s.y);
    for (const Band& b : panel.bands) take(b.low), take(b.high);
  }
  if (!(high > low)) return;
  for (Panel& panel : panels) panel.y.from = low - 0.05 * (high - low), panel.y.to = high + 0.05 * (high - low);
}

bool isHandAlone(const Analysis& analysis, std::size_t condition) {
  return analysis.conditions[condition].experiment().object.kind == experiment::ObjectKind::None;
}

/// Puts a row of panels into the figure: the hand's velocity and, where there is one, the object's. `fill` draws into each.
template <typename Fill>
void addVelocities(NamedFigure& out, bool handAlone, const std::string& hand, const std::string& object, Fill fill) {
  out.figure.columns = handAlone ? 1 : 2;
  for (int column = 0; column < out.figure.columns; ++column) {
    const bool isObject = column == 1;
    const char letter = static_cast<char>('a' + out.figure.panels.size());
    fill(out.figure.panels.emplace_back(velocityPanel(fmt::format("({}) {}", letter, isObject ? object : hand), isObject)), isObject);
  }
}

}  // namespace

NamedFigure paperFigure(const Analysis& analysis, std::size_t condition) {
  const ConditionResult& r = analysis.results[condition];
  NamedFigure out{.name = "velocity_" + fileNameOf(analysis.conditions[condition].name)};
  const std::vector<const AnalyzedTrial*> used = usedTrials(analysis, condition);
  const std::size_t shown = std::min(used.size(), kMaxTrialsDrawn);
  std::vector<const AnalyzedTrial*> some;
  for (std::size_t i = 0; i < shown; ++i) some.push_back(used[i * used.size() / shown]);
  const std::string what = fmt::format("{}trial{}", r.onlyFailures ? "failed " : "", used.size() == 1 ? "" : "s");
  const std::string label = shown == used.size() ? fmt::format("{} {}", shown, what) : fmt::format("{} of {} {}", shown, used.size(), what);
  const bool handAlone = isHandAlone(analysis, condition);
  for (const Zero zero : {Zero::Onset, Zero::Start}) {
    const std::string from = zero == Zero::Start ? ", predictions from t = 0" : "";
    const auto fill = [&](Panel& panel, bool object) {
      addThin(panel, analysis, some, r.duration.mean, object, label);
      addPrediction(panel, r, Criterion::MinHandJerk, object, palette::kBlack, Dash::Solid, figure::kThick, zero);
      addPrediction(panel, r, Criterion::MinCrackle, object, palette::kVermilion, Dash::Dashed, figure::kThick, zero);
    };
    addVelocities(out, handAlone, "Hand" + from, zero == Zero::Start ? "Object" + from : "Object (last mass)", fill);
  }
  const std::string shownVelocity = handAlone ? "velocity of the hand" : "velocity of hand and object";
  const bool moved = analysis.options.predictFor == PredictionDuration::Moved;
  out.caption = r.used > 0
                    ? fmt::format("{}{}: {}. Thin: {}, time-scaled to the average of {:.3f} s. {}", analysis.conditions[condition].name,
                                  moved ? "" : ", as in Figs. 5 and 6", shownVelocity, label, r.duration.mean, describeThick(r, moved))
                    : fmt::format("{}: no movement to show; predictions only.", analysis.conditions[condition].name);
  return out;
}

NamedFigure lastFiveFigure(const Analysis& analysis, std::size_t condition) {
  constexpr std::size_t kLast = 5;
  const ConditionResult& r = analysis.results[condition];
  NamedFigure out{.name = "last_five_" + fileNameOf(analysis.conditions[condition].name)};
  std::vector<const AnalyzedTrial*> used = usedTrials(analysis, condition);
  if (used.empty() || r.onlyFailures || analysis.conditions[condition].pooled) return out;  // five of eight targets are no series
  const std::string subject = used.front()->key.subject;
  std::erase_if(used, [&](const AnalyzedTrial* t) { return t->key.subject != subject; });
  double duration = 0;
  for (const AnalyzedTrial* t : used) duration += t->measures.duration / static_cast<double>(used.size());
  const std::vector<const AnalyzedTrial*> last(used.end() - static_cast<std::ptrdiff_t>(std::min(kLast, used.size())), used.end());
  addVelocities(out, isHandAlone(analysis, condition), "Hand", "Object (last mass)", [&](Panel& panel, bool object) {
    addThin(panel, analysis, last, duration, object, fmt::format("last {} successful", last.size()));
    for (Series& s : panel.series) s.color = palette::kGrey, s.width = 0.7;
    addPrediction(panel, r, Criterion::MinHandJerk, object, {0.62, 0.62, 0.62}, Dash::Solid, 2.8);
    if (r.moved) addPrediction(panel, *r.moved, object, palette::kBlue, Dash::Dashed, 1.4, Zero::Onset);
    Series mean{.label = fmt::format("average of {}", used.size()), .x = profileTimes(duration), .width = 1.8};
    mean.y.assign(kProfilePoints, 0.0);
    for (const AnalyzedTrial* t : used) {
      const TrialProfile profile = analysis.profileOf(*t);
      for (std::size_t i = 0; i < kProfilePoints; ++i)
        mean.y[i] += (object ? profile.object : profile.hand)[i] * profile.duration / duration / static_cast<double>(used.size());
    }
    panel.series.push_back(std::move(mean));
  });
  const char* const moved = "the T whose movement lasts as long as all subjects' trials do on average";
  const std::string grey = analysis.options.predictFor == PredictionDuration::Moved ? moved : "the task's T";
  out.caption = fmt::format(
      "{}, subject {}, as in Figs. 9 and 10: the last {} successful trials (thin),{}{} and the average of all {} successful trials (thick "
      "black), time-scaled to their average.",
      analysis.conditions[condition].name, subject, last.size(),
      r.predicts(Criterion::MinHandJerk) ? fmt::format(" criterion (1) for {} (thick grey)", grey) : "",
      r.moved ? fmt::format(" and for {} (dashed blue)", moved) : "", used.size());
  return out;
}

namespace {

/// A person's mean with the fits of the closest candidates and of the reference, and what they leave.
std::pair<Panel, Panel> panelsOf(const PersonResult& person, const ConditionResult& r) {
  const PersonTemplate& own = person.fit.own;
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k + 1 < person.fit.candidates.size(); ++k) order.push_back(k);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return person.fit.candidates[a].meanScore < person.fit.candidates[b].meanScore; });
  order.resize(std::min<std::size_t>(2, order.size()));
  order.push_back(person.fit.candidates.size() - 1);
  Panel panel{.title = fmt::format("Subject {}, {} trials", person.subject, person.trials),
              .y = {.label = "Hand velocity (m/s)"},
              .legend = LegendPlace::Below};
  Panel rest{.x = {.label = "Part of the movement"}, .y = {.label = "Residual (m/s)"}, .legend = LegendPlace::None};
  Band band{.label = "± SD"}, zero;
  Series mean{.label = "mean", .width = 2.6};
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < own.mean.value.size(); i += 3) {
    const double s = own.mean.first + own.mean.step * static_cast<double>(i);
    if (s >= -0.15 && s <= 1.15) shown.push_back(i), mean.x.push_back(s);
  }
  for (const std::size_t i : shown) {
    mean.y.push_back(own.mean.value[i]);
    band.low.push_back(own.mean.value[i] - own.scatter[i]);
    band.high.push_back(own.mean.value[i] + own.scatter[i]);
    zero.low.push_back(-own.scatter[i]);
    zero.high.push_back(own.scatter[i]);
  }
  band.x = zero.x = mean.x;
  panel.bands.push_back(band);
  rest.bands.push_back(zero);
  panel.series.push_back(mean);
  for (const std::size_t k : order) {
    const auto& criteria = r.candidates.candidates[k].criteria;
    Series s{.label = criteria.empty() ? "reference" : shortNameOf(criteria),
             .x = mean.x,
             .color = lookOf(criteria).color,
             .width = 1.2,
             .dash = lookOf(criteria).dash};
    for (const std::size_t i : shown) s.y.push_back(person.fit.candidates[k].mean[i]);
    Series apart = s;
    apart.y = subtract(mean.y, s.y);
    panel.series.push_back(std::move(s));
    rest.series.push_back(std::move(apart));
  }
  return {std::move(panel), std::move(rest)};
}

}  // namespace

NamedFigure peopleFigure(const Analysis& analysis, std::size_t condition) {
  NamedFigure out{.name = "people_" + fileNameOf(analysis.conditions[condition].name)};
  const ConditionResult& r = analysis.results[condition];
  std::vector<Panel> fits, residuals;
  for (const PersonResult& person : analysis.people) {
    if (person.condition != condition || !person.fitted) continue;
    auto [panel, rest] = panelsOf(person, r);
    fits.push_back(std::move(panel));
    residuals.push_back(std::move(rest));
  }
  if (fits.empty()) return out;
  shareScale(fits), shareScale(residuals);
  const std::size_t columns = std::min<std::size_t>(3, fits.size());
  // A row of fits, then the row of their residuals.
  for (std::size_t first = 0; first < fits.size(); first += columns) {
    const std::size_t end = std::min(first + columns, fits.size());
    for (std::size_t i = first; i < end; ++i) out.figure.panels.push_back(fits[i]);
    for (std::size_t i = end - first; i < columns; ++i) out.figure.panels.push_back({});  // of the last row
    for (std::size_t i = first; i < end; ++i) out.figure.panels.push_back(residuals[i]);
  }
  out.figure.columns = static_cast<int>(columns);
  out.figure.panelWidth = columns == 1 ? 90 : columns == 2 ? 62 : 42;
  out.figure.panelHeight = columns == 1 ? 45 : 30;
  out.caption = fmt::format(
      "{}: each subject's mean hand velocity (trials laid over one another by onset, duration and amplitude) ± SD, with the fitted "
      "mean of the two closest criteria and of the reference; below, what they leave. All subjects have one scale.",
      analysis.conditions[condition].name);
  return out;
}

}  // namespace reachlab::analysis
