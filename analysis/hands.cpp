#include "analysis/hands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/sheet.h"
#include "base/ticks.h"
#include "sim/experiment/experiment.h"
#include "sim/record/log/log.h"
#include "sim/record/trial_marks.h"

namespace reachlab::analysis {
namespace {

constexpr double kLongestLag = 0.5;  // [s]

std::vector<double> speedsOf(const HandSignals& hand) {
  std::vector<double> speeds;
  for (const Vec3& v : hand.velocity) speeds.push_back(norm(v));
  return speeds;
}

// Of a(t) and b(t + lag), over what both have; NaN where one does not vary.
double correlation(const std::vector<double>& a, const std::vector<double>& b, int lag) {
  const int n = static_cast<int>(a.size()), first = std::max(0, -lag), last = std::min(n, n - lag), count = last - first;
  if (count < 3) return kNotMeasured;
  double meanA = 0, meanB = 0;
  for (int i = first; i < last; ++i) meanA += a[static_cast<std::size_t>(i)], meanB += b[static_cast<std::size_t>(i + lag)];
  meanA /= count, meanB /= count;
  double aa = 0, bb = 0, ab = 0;
  for (int i = first; i < last; ++i) {
    const double x = a[static_cast<std::size_t>(i)] - meanA, y = b[static_cast<std::size_t>(i + lag)] - meanB;
    aa += x * x, bb += y * y, ab += x * y;
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : kNotMeasured;
}

struct Lag {
  double seconds = kNotMeasured, correlation = kNotMeasured;
};
// The best shift, between samples by the parabola through its neighbours.
Lag lagBehind(const std::vector<double>& first, const std::vector<double>& hand, double rate) {
  const int most = std::min(static_cast<int>(kLongestLag * rate), static_cast<int>(first.size()) / 2);
  Lag best;
  int at = 0;
  for (int lag = -most; lag <= most; ++lag)
    if (const double c = correlation(first, hand, lag); c > best.correlation || (std::isnan(best.correlation) && !std::isnan(c)))
      best.correlation = c, at = lag;
  if (std::isnan(best.correlation)) return best;
  best.seconds = at / rate;
  if (std::abs(at) == most) return best;
  const double before = correlation(first, hand, at - 1), after = correlation(first, hand, at + 1);
  const double bend = before - 2 * best.correlation + after;
  if (bend < 0) best.seconds += 0.5 * (before - after) / bend / rate;
  return best;
}

std::vector<HandSignals> signalsOf(const record::ChannelTable& table, const record::SampleRows& rows) {
  std::vector<HandSignals> hands(static_cast<std::size_t>(table.hands));
  for (int hand = 1; hand <= table.hands; ++hand) {
    const std::string name = hand == 1 ? "hand" : fmt::format("hand{}", hand);
    const std::size_t place = table.indexOf(name + "_pos_x"), velocity = table.indexOf(name + "_vel_x"),
                      force = table.indexOf(hand == 1 ? "coupling_force_x" : name + "_coupling_force_x"),
                      work = table.indexOf(name + "_work");
    HandSignals& signals = hands[static_cast<std::size_t>(hand - 1)];
    for (std::size_t row = 0; row < rows.size(); ++row) {
      signals.place.push_back(rows.vectorAt(row, place));
      signals.velocity.push_back(rows.vectorAt(row, velocity));
      signals.force.push_back(rows.vectorAt(row, force));
      signals.work.push_back(rows.at(row, work));
    }
  }
  return hands;
}

void addRun(const record::RunLog& run, Sheet& table) {
  const record::RunConfiguration& c = run.configuration();
  const record::RunMarks marks = record::readMarks(run);
  for (const record::RecordedTrial& trial : run.trials()) {
    if (trial.result.onsetTick == 0 || !trial.complete) continue;
    // At the tick that ends the trial no force acts any more.
    const record::SampleRows rows = run.rows(trial).between(trial.result.onsetTick, trial.result.endTick - 1);
    if (rows.size() < 3) continue;
    const TogetherMeasures together = measureTogether(signalsOf(c.table, rows), c.samplingHz);
    const record::TrialMark* mark = marks.find(trial.trial);
    for (std::size_t hand = 0; hand < together.hands.size(); ++hand) {
      const HandMeasures& m = together.hands[hand];
      table.row(c.subject, c.session, c.run, trial.trial, record::conditionOf(c, trial.planned), c.practice ? "practice" : "recorded",
                trial.planned.catchTrial, mark == nullptr ? "" : mark->excluded, trial::nameOf(trial.result.outcome), hand + 1,
                record::devicesOf(c).at(hand).name, m.peakSpeed, m.path, m.peakForce, m.meanForce, m.work, m.positiveWork, m.share, m.lag,
                m.lagCorrelation, together.internalForce, together.peakInternalForce);
    }
  }
}

void addRuns(const std::vector<record::RunLog>& runs, Sheet& table) {
  for (const record::RunLog& run : runs) addRun(run, table);
}

}  // namespace

TogetherMeasures measureTogether(const std::vector<HandSignals>& hands, double rate) {
  TogetherMeasures together;
  double allWork = 0;
  std::vector<double> firstSpeeds;
  for (const HandSignals& hand : hands) {
    HandMeasures m;
    const std::vector<double> speeds = speedsOf(hand);
    if (firstSpeeds.empty()) firstSpeeds = speeds;
    for (std::size_t i = 0; i < hand.place.size(); ++i) {
      m.peakSpeed = std::max(m.peakSpeed, speeds[i]);
      if (i > 0) m.path += norm(hand.place[i] - hand.place[i - 1]);
      m.peakForce = std::max(m.peakForce, norm(hand.force[i]));
      m.meanForce += norm(hand.force[i]) / static_cast<double>(hand.place.size());
    }
    m.work = hand.work.empty() ? 0 : hand.work.back();
    for (std::size_t i = 1; i < hand.work.size(); ++i) m.positiveWork += std::max(0.0, hand.work[i] - hand.work[i - 1]);
    allWork += m.positiveWork;
    const Lag lag = lagBehind(firstSpeeds, speeds, rate);
    m.lag = lag.seconds;
    m.lagCorrelation = lag.correlation;
    together.hands.push_back(m);
  }
  for (HandMeasures& m : together.hands) m.share = allWork > 0 ? m.positiveWork / allWork : kNotMeasured;
  const std::size_t count = hands.empty() ? 0 : hands.front().force.size();
  double squares = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 sum;
    double sizes = 0;
    for (const HandSignals& hand : hands) sum += hand.force[i], sizes += norm(hand.force[i]);
    const double cancelled = std::max(0.0, 0.5 * (sizes - norm(sum)));
    squares += cancelled * cancelled;
    together.peakInternalForce = std::max(together.peakInternalForce, cancelled);
  }
  together.internalForce = count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0;
  return together;
}

bool hasSeveralHands(const DatasetIndex& dataset) {
  return std::any_of(dataset.conditions.begin(), dataset.conditions.end(),
                     [](const Condition& condition) { return condition.experiment().hands.size() > 1; });
}

std::string handsTable(const DatasetIndex& dataset) {
  std::vector<record::RunLog> runs;
  if (!hasSeveralHands(dataset)) return {};
  for (const AnalysedRun& run : dataset.runs) {
    if (!run.isLog) continue;
    if (record::RunLog log = record::RunLog::open(run.file); log.configuration().table.hands > 1) runs.push_back(std::move(log));
  }
  return runs.empty() ? std::string() : sheetText("hands.csv", runs, addRuns);
}

}  // namespace reachlab::analysis
