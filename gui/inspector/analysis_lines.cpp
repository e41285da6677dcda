#include "gui/inspector/analysis_lines.h"

#include <cmath>

#include "analysis/report/figures.h"
#include "analysis/report/wording.h"
#include "analysis/tables.h"
#include "base/table_text.h"
#include "gui/plot/criterion_style.h"

namespace reachlab::gui::inspector {
namespace {

double meanDuration(const Inspection& inspection) {
  double sum = 0;
  int count = 0;
  for (const analysis::TrialSignals& s : inspection.signals)
    if (s.movement.found) sum += s.movement.duration(), ++count;
  return count > 0 ? sum / count : 1;
}

constexpr double kShownBeforeOnset = 0.5;  // [s]

/// The whole record about the onset, or its movement laid over the mean duration.
ProfilePlot::Line lineOf(const analysis::TrialData& trial, const analysis::TrialSignals& signals, Signal which, double scaledTo) {
  const std::vector<double>& velocity = which == Signal::Hand ? signals.handVelocity : signals.objectVelocity;
  const analysis::Movement& move = signals.movement;
  if (scaledTo > 0 && move.found)
    return {analysis::profileTimes(scaledTo), analysis::scaleVelocity(velocity, trial.rate, move.onset, move.offset, scaledTo)};
  ProfilePlot::Line line;
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    line.x.push_back(static_cast<double>(i) / trial.rate - (move.found ? move.onset : 0));
    line.y.push_back(velocity[i]);
  }
  return line;
}

}  // namespace

std::vector<ProfilePlot::Line> linesOf(const Inspection& inspection, Signal signal, TimeAxis axis) {
  std::vector<ProfilePlot::Line> lines;
  const double duration = axis == TimeAxis::Scaled ? meanDuration(inspection) : 0;
  for (std::size_t i = 0; i < inspection.signals.size(); ++i)
    lines.push_back(lineOf(inspection.input.trials[i], inspection.signals[i], signal, duration));
  return lines;
}

double zeroOf(const Inspection& inspection, std::size_t trial) {
  const analysis::Movement& move = inspection.signals[trial].movement;
  return inspection.input.trials[trial].first + (move.found ? move.onset : 0);
}

ProfilePlot::Mean meanOf(const analysis::Analysis& analysis, std::size_t condition, Signal signal) {
  const analysis::ConditionResult& r = analysis.results[condition];
  const analysis::MeanProfile& profile = signal == Signal::Hand ? r.hand : r.object;
  if (r.used == 0) return {};
  return {analysis::profileTimes(r.duration.mean), profile.mean, profile.sd};
}

std::vector<plot::PredictedLine> predictionsOf(const analysis::Analysis& analysis, std::size_t condition, Signal signal,
                                               const ShownPredictions& shown) {
  std::vector<plot::PredictedLine> out;
  const analysis::ConditionResult& r = analysis.results[condition];
  for (const predict::Criterion criterion : shown.criteria) {
    plot::PredictedLine line{plot::titleOf(criterion), plot::styleOf(criterion)};
    for (const analysis::PredictedSignal& predicted : r.signals) {
      if (!shown.predicted || predicted.criterion != criterion) continue;
      const analysis::PredictedCurve curve = analysis::curveOf(predicted);
      line.x = curve.time;
      line.y = signal == Signal::Hand ? curve.hand : curve.object;
      out.push_back(line);
    }
    const auto k = analysis::placeOf(namesOf(r.candidates), criterion);
    if (!shown.fitted || !k || signal != Signal::Hand) continue;
    line.title += ProfilePlot::tr(", fitted");
    line.fitted = true;
    for (const analysis::PersonResult& person : analysis.people) {
      if (person.condition != condition || !person.fitted) continue;
      const analysis::Profile& grid = person.fit.own.mean;
      line.x.clear();
      line.y = person.fit.candidates[*k].mean;
      for (std::size_t i = 0; i < line.y.size(); ++i) line.x.push_back(person.duration * (grid.first + grid.step * static_cast<double>(i)));
      out.push_back(line);
    }
  }
  return out;
}

figure::Figure figureOf(const Inspection& inspection, std::size_t condition, TimeAxis axis, const ShownPredictions& shown) {
  figure::Figure out{.columns = 2};
  for (const Signal signal : {Signal::Hand, Signal::Object}) {
    const bool object = signal == Signal::Object;
    figure::Panel panel = analysis::velocityPanel(object ? "(b) Object (last mass)" : "(a) Hand", object);
    if (axis == TimeAxis::AsMoved) panel.x.from = -kShownBeforeOnset;  // a hand may have waited for seconds
    const std::vector<ProfilePlot::Line> lines = linesOf(inspection, signal, axis);
    for (const ProfilePlot::Line& line : lines)
      panel.series.push_back({.label = panel.series.empty() ? analysis::plural(lines.size(), "trial") : "",
                              .x = line.x,
                              .y = line.y,
                              .color = figure::palette::faded(figure::palette::kGrey, 0.5),
                              .width = lines.size() == 1 ? figure::kNormal : figure::kThin});
    if (inspection.analysis) {
      if (const ProfilePlot::Mean mean = meanOf(*inspection.analysis, condition, signal); lines.size() > 1 && !mean.x.empty()) {
        figure::Band band{.label = "± SD", .x = mean.x};
        for (std::size_t i = 0; i < mean.x.size(); ++i)
          band.low.push_back(mean.mean[i] - mean.sd[i]), band.high.push_back(mean.mean[i] + mean.sd[i]);
        panel.bands.push_back(std::move(band));
        panel.series.push_back({.label = "mean", .x = mean.x, .y = mean.mean, .width = figure::kThick});
      }
      int colours[2] = {0, 0};
      for (const plot::PredictedLine& line : predictionsOf(*inspection.analysis, condition, signal, shown))
        panel.series.push_back({.label = line.title.toStdString(),
                                .x = line.x,
                                .y = line.y,
                                .color = figure::palette::series(colours[line.fitted]++),
                                .width = 1.4,
                                .dash = line.fitted ? figure::Dash::Dotted : figure::Dash::Dashed});
    }
    out.panels.push_back(std::move(panel));
  }
  return out;
}

std::string linesCsv(const Inspection& inspection, TimeAxis axis) {
  TableText table(',', "");
  table.row({"subject", "session", "condition", "run", "trial", "time_s", "hand_velocity_m_per_s", "object_velocity_m_per_s"});
  const std::vector<ProfilePlot::Line> hand = linesOf(inspection, Signal::Hand, axis), object = linesOf(inspection, Signal::Object, axis);
  for (std::size_t i = 0; i < hand.size(); ++i) {
    const analysis::TrialKey& key = inspection.input.trials[i].key;
    for (std::size_t k = 0; k < hand[i].x.size(); ++k) {
      table.cell(key.subject).cell(key.session).cell(key.condition).whole(key.run).whole(key.trial);
      table.number(hand[i].x[k]).number(hand[i].y[k]).number(k < object[i].y.size() ? object[i].y[k] : std::nan("")).endRow();
    }
  }
  return table.text();
}

}  // namespace reachlab::gui::inspector
