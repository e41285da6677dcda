#include "cli/output/predict_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "sim/experiment/unit_ending.h"

namespace reachlab::cli {
namespace {

std::string digits(double value) { return fmt::format("{:.17g}", value); }
std::string digitsOrEmpty(const std::optional<double>& value) { return value ? digits(*value) : ""; }
std::string digitsOrNull(const std::optional<double>& value) { return value ? digits(*value) : "null"; }
std::string asJsonText(std::string_view text) { return nlohmann::json(text).dump(); }

double sampleTime(const predict::Prediction& prediction, int i, int samples) {
  return i == samples - 1 ? prediction.duration : prediction.duration * i / (samples - 1);
}

// "Movement time (s)" of duration_s.
std::string labelOf(const std::string& key) {
  std::string label = key;
  for (const predict::SweepKey& known : predict::sweepKeys())
    if (known.name == key) label = known.meaning;
  label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
  const std::string unit(experiment::splitUnit(key).unit);
  return unit.empty() ? label : label + " (" + unit + ")";
}

// Where the number of peaks changes along the sweep, and where the hand begins or ceases to move backwards: half way between two values.
std::vector<figure::Rule> findTurns(const std::vector<predict::SweepRow>& rows) {
  std::vector<figure::Rule> turns;
  for (size_t i = 1; i < rows.size(); ++i) {
    if (!rows[i - 1].prediction || !rows[i].prediction) continue;
    const predict::ProfileShape &before = rows[i - 1].shape, &after = rows[i].shape;
    const bool reverses = before.reverses != after.reverses;
    if (before.velocityPeaks == after.velocityPeaks && !reverses) continue;
    turns.push_back(
        {.at = (rows[i - 1].value + rows[i].value) / 2, .color = reverses ? figure::palette::kVermilion : figure::palette::kGrey});
  }
  return turns;
}

}  // namespace

std::string writePredictionCsv(const predict::Prediction& prediction, int samples) {
  std::string out = "time_s,hand_m,hand_m_per_s,hand_m_per_s2";
  const auto n = static_cast<size_t>(prediction.massCount());
  for (size_t i = 1; i <= n; ++i) out += fmt::format(",mass{0}_m,mass{0}_m_per_s", i);
  out += '\n';
  std::vector<double> x(n), v(n);
  for (int i = 0; i < samples; ++i) {
    const double t = sampleTime(prediction, i, samples);
    const predict::PredictedHand hand = prediction.handAt(t);
    prediction.massesAt(t, x, v);
    out += digits(t) + ',' + digits(hand.position) + ',' + digits(hand.velocity) + ',' + digits(hand.acceleration);
    for (size_t m = 0; m < n; ++m) out += ',' + digits(x[m]) + ',' + digits(v[m]);
    out += '\n';
  }
  return out;
}

std::string writePredictionJson(const predict::Prediction& p) {
  std::string warnings;
  for (const std::string& w : p.warnings) warnings += (warnings.empty() ? "" : ", ") + asJsonText(w);
  std::string out = "{\n";
  const auto line = [&](std::string_view key, const std::string& value) { out += fmt::format("  \"{}\": {},\n", key, value); };
  line("criterion", asJsonText(predict::nameOf(p.criterion)));
  line("duration_s", digits(p.duration));
  line("distance_m", digits(p.distance));
  line("cost", digits(p.cost));
  line("hand_peak_m_per_s", digits(p.handPeak));
  line("hand_peak_s", digits(p.handPeakTime));
  line("object_peak_m_per_s", digits(p.objectPeak));
  line("hand_jump_m", digitsOrNull(p.handJump));
  line("hand_jump_m_per_s", digitsOrNull(p.handVelocityJump));
  line("condition", digits(p.condition));
  line("profile_error", digitsOrNull(p.profileError));
  line("point", p.point ? asJsonText(nameOf(*p.point)) : "null");
  line("travel_time_s", digitsOrNull(p.travelTime));
  out += fmt::format("  \"warnings\": [{}]\n}}\n", warnings);
  return out;
}

std::string writeSweepCsv(const predict::Sweep& sweep, const std::vector<predict::SweepRow>& rows) {
  std::string out = sweep.key +
                    ",cost,hand_peak_m_per_s,hand_peak_s,object_peak_m_per_s,hand_jump_m,hand_jump_m_per_s,condition,travel_time_s,"
                    "hand_velocity_peaks,hand_reverses,refused\n";
  for (const predict::SweepRow& row : rows) {
    out += digits(row.value);
    if (row.prediction) {
      const predict::Prediction& p = *row.prediction;
      for (const double value : {p.cost, p.handPeak, p.handPeakTime, p.objectPeak}) out += ',' + digits(value);
      out += ',' + digitsOrEmpty(p.handJump) + ',' + digitsOrEmpty(p.handVelocityJump) + ',' + digits(p.condition) + ',' +
             digitsOrEmpty(p.travelTime);
      out += fmt::format(",{},{},0\n", row.shape.velocityPeaks, row.shape.reverses ? 1 : 0);
    } else {
      out += ",,,,,,,,,,,1\n";
    }
  }
  return out;
}

figure::Figure drawPrediction(const predict::Prediction& prediction, int samples) {
  figure::Series hand{.label = "hand", .width = figure::kThick},
      object{.label = "object", .color = figure::palette::kBlue, .width = figure::kThick, .dash = figure::Dash::Dashed};
  for (int i = 0; i < samples; ++i) {
    const double t = sampleTime(prediction, i, samples);
    hand.x.push_back(t), hand.y.push_back(prediction.handAt(t).velocity);
    object.x.push_back(t), object.y.push_back(prediction.objectVelocityAt(t));
  }
  return {.panels = {{.title = std::string(predict::nameOf(prediction.criterion)),
                      .x = {.label = "Time (s)"},
                      .y = {.label = "Velocity (m/s)"},
                      .series = {hand, object}}}};
}

figure::Figure drawSweep(const predict::Sweep& sweep, const std::vector<predict::SweepRow>& rows, predict::Criterion criterion) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  figure::Series hand{.label = "hand"}, object{.label = "object", .color = figure::palette::kBlue, .dash = figure::Dash::Dashed}, cost;
  figure::Series count{.label = "peaks of the hand"},
      reversal{.label = "hand reverses", .color = figure::palette::kVermilion, .width = 0, .marker = figure::MarkerShape::Cross};
  for (const predict::SweepRow& row : rows) {
    const predict::Prediction* p = row.prediction.get();
    for (figure::Series* s : {&hand, &object, &cost, &count, &reversal}) s->x.push_back(row.value);
    hand.y.push_back(p ? std::abs(p->handPeak) : none);
    object.y.push_back(p ? std::abs(p->objectPeak) : none);
    cost.y.push_back(p ? p->cost : none);
    count.y.push_back(p ? row.shape.velocityPeaks : none);
    reversal.y.push_back(p && row.shape.reverses ? row.shape.velocityPeaks : none);
  }
  const std::string along = labelOf(sweep.key);
  const auto panel = [&](const std::string& y, figure::Scale scale, std::vector<figure::Series> series) {
    return figure::Panel{.x = {.label = along}, .y = {.label = y, .scale = scale}, .series = std::move(series), .rules = findTurns(rows)};
  };
  // What the lines across say, for the legend alone.
  const figure::Series change{
      .label = "their number changes", .color = figure::palette::kGrey, .width = figure::kThin, .dash = figure::Dash::Dotted};
  const figure::Series turn{
      .label = "begins or ceases to reverse", .color = figure::palette::kVermilion, .width = figure::kThin, .dash = figure::Dash::Dotted};
  figure::Panel peaks = panel("Peaks of the hand's velocity", figure::Scale::Linear, {count, reversal, change, turn});
  peaks.legend = figure::LegendPlace::Below;
  int most = 1;
  for (const predict::SweepRow& row : rows) most = std::max(most, row.shape.velocityPeaks);
  peaks.y.from = 0;
  peaks.y.to = most + 0.5;
  for (int i = 0; i <= most; ++i) peaks.y.ticks.emplace_back(i, std::to_string(i));
  return {.title = std::string(predict::nameOf(criterion)),
          .panels = {panel("Peak velocity (m/s)", figure::Scale::Linear, {hand, object}), panel("Cost", figure::Scale::Log, {cost}), peaks},
          .columns = 3};
}

}  // namespace reachlab::cli
