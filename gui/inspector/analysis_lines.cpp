#include "gui/inspector/analysis_lines.h"

#include <algorithm>
#include <cmath>

#include "analysis/tables.h"
#include "base/table_text.h"
#include "gui/plot/criterion_style.h"

namespace reachlab::gui::inspector {
namespace {

QVector<double> toVector(const std::vector<double>& values) { return QVector<double>(values.begin(), values.end()); }

std::vector<double> evenly(double end, std::size_t points) {
  std::vector<double> x(points);
  for (std::size_t i = 0; i < points; ++i) x[i] = end * static_cast<double>(i) / static_cast<double>(points - 1);
  return x;
}

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
    return {toVector(evenly(scaledTo, analysis::kProfilePoints)),
            toVector(analysis::scaleVelocity(velocity, trial.rate, move.onset, move.offset, scaledTo))};
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

MeanLine meanOf(const analysis::Analysis& analysis, std::size_t condition, Signal signal) {
  const analysis::ConditionResult& r = analysis.results[condition];
  const analysis::MeanProfile& profile = signal == Signal::Hand ? r.hand : r.object;
  if (r.used == 0) return {};
  return {toVector(evenly(r.duration.mean, analysis::kProfilePoints)), toVector(profile.mean), toVector(profile.sd)};
}

std::vector<ProfilePlot::Prediction> predictionsOf(const analysis::Analysis& analysis, std::size_t condition, Signal signal,
                                                   const std::vector<predict::Criterion>& criteria, bool fitted) {
  std::vector<ProfilePlot::Prediction> out;
  const analysis::ConditionResult& r = analysis.results[condition];
  for (const predict::Criterion criterion : criteria) {
    for (std::size_t k = 0; !fitted && k < r.signals.size(); ++k) {
      if (r.signals[k].criterion != criterion) continue;
      const analysis::PredictedCurve curve = analysis::curveOf(r, k);
      out.push_back({plot::titleOf(criterion), plot::styleOf(criterion), false, toVector(curve.time),
                     toVector(signal == Signal::Hand ? curve.hand : curve.object)});
    }
    if (!fitted || signal != Signal::Hand) continue;
    for (const analysis::PersonResult& person : analysis.people) {
      if (person.condition != condition || !person.fitted) continue;
      for (std::size_t k = 0; k < person.fit.candidates.size(); ++k) {
        const auto& named = r.candidates.candidates[k].criteria;
        if (std::find(named.begin(), named.end(), criterion) == named.end()) continue;
        const analysis::Profile& grid = person.fit.own.mean;
        ProfilePlot::Prediction line{plot::titleOf(criterion) + ProfilePlot::tr(", fitted"), plot::styleOf(criterion), true, {}, {}};
        for (std::size_t i = 0; i < person.fit.candidates[k].mean.size(); ++i) {
          line.x.push_back(person.duration * (grid.first + grid.step * static_cast<double>(i)));
          line.y.push_back(person.fit.candidates[k].mean[i]);
        }
        out.push_back(std::move(line));
      }
    }
  }
  return out;
}

figure::Figure figureOf(const Inspection& inspection, std::size_t condition, TimeAxis axis,
                        const std::vector<predict::Criterion>& criteria) {
  figure::Figure out;
  out.columns = 2;
  for (const Signal signal : {Signal::Hand, Signal::Object}) {
    figure::Panel panel;
    panel.title = signal == Signal::Hand ? "(a) Hand" : "(b) Object (last mass)";
    panel.x.label = "Time from onset (s)";
    panel.y.label = signal == Signal::Hand ? "Hand velocity (m/s)" : "Object velocity (m/s)";
    panel.legend = figure::LegendPlace::Below;
    if (axis == TimeAxis::AsMoved) panel.x.from = -kShownBeforeOnset;  // a hand may have waited for seconds
    const auto take = [](const QVector<double>& values) { return std::vector<double>(values.begin(), values.end()); };
    const std::vector<ProfilePlot::Line> lines = linesOf(inspection, signal, axis);
    for (const ProfilePlot::Line& line : lines) {
      figure::Series s;
      if (&line == &lines.front()) s.label = std::to_string(lines.size()) + (lines.size() == 1 ? " trial" : " trials");
      s.x = take(line.x);
      s.y = take(line.y);
      s.color = figure::palette::faded(figure::palette::kGrey, 0.5);
      s.width = lines.size() == 1 ? figure::kNormal : figure::kThin;
      panel.series.push_back(std::move(s));
    }
    if (inspection.analysis) {
      if (const MeanLine mean = meanOf(*inspection.analysis, condition, signal); lines.size() > 1 && !mean.x.isEmpty()) {
        figure::Band band;
        band.label = "± SD";
        figure::Series s;
        s.label = "mean";
        s.x = band.x = take(mean.x);
        s.y = take(mean.mean);
        s.width = figure::kThick;
        for (int i = 0; i < mean.x.size(); ++i)
          band.low.push_back(mean.mean[i] - mean.sd[i]), band.high.push_back(mean.mean[i] + mean.sd[i]);
        panel.bands.push_back(band);
        panel.series.push_back(std::move(s));
      }
      int colour = 0;
      for (const bool fitted : {false, true}) {
        colour = 0;
        for (const ProfilePlot::Prediction& p : predictionsOf(*inspection.analysis, condition, signal, criteria, fitted)) {
          figure::Series s;
          s.label = p.title.toStdString();
          s.x = take(p.x);
          s.y = take(p.y);
          s.color = figure::palette::series(colour++);
          s.dash = fitted ? figure::Dash::Dotted : figure::Dash::Dashed;
          s.width = 1.4;
          panel.series.push_back(std::move(s));
        }
      }
    }
    out.panels.push_back(std::move(panel));
  }
  return out;
}

std::string linesCsv(const Inspection& inspection) {
  TableText table(',', "");
  table.row({"subject", "session", "condition", "run", "trial", "time_s", "hand_velocity_m_per_s", "object_velocity_m_per_s"});
  const std::vector<ProfilePlot::Line> hand = linesOf(inspection, Signal::Hand, TimeAxis::AsMoved),
                                       object = linesOf(inspection, Signal::Object, TimeAxis::AsMoved);
  for (std::size_t i = 0; i < hand.size(); ++i) {
    const analysis::TrialKey& key = inspection.input.trials[i].key;
    for (int k = 0; k < hand[i].x.size(); ++k) {
      table.cell(key.subject).cell(key.session).cell(key.condition).whole(key.run).whole(key.trial);
      table.number(hand[i].x[k]).number(hand[i].y[k]).number(k < object[i].y.size() ? object[i].y[k] : std::nan("")).endRow();
    }
  }
  return table.text();
}

}  // namespace reachlab::gui::inspector
