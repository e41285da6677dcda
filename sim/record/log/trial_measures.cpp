#include "sim/record/log/trial_measures.h"

#include <algorithm>
#include <cmath>

#include "base/fault.h"
#include "base/ticks.h"

namespace reachlab::record {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Nobody counted in a trial in which the log broke off, and its peaks are unknown too.
double counted(const RecordedTrial& t, std::uint64_t number) {
  return std::isnan(t.peakHandSpeed) ? kUnknown : static_cast<double>(number);
}

constexpr TickMeasure kMeasures[] = {
    {"mass", "Mass that missed the tolerance, from 1; 0: none", [](const RecordedTrial& t) { return static_cast<double>(t.result.mass); },
     true},
    {"movement_time_s", "The task's own: from its onset to the end, or to where the trial was broken off",
     [](const RecordedTrial& t) { return t.result.onsetTick > 0 ? t.result.movementTime : kUnknown; }},
    {"by", "Excess over the tolerance: m where reason is position, m/s where velocity, s where time_short",
     [](const RecordedTrial& t) { return t.result.by; }},
    {"task_reaction_time_s", "From the go signal to the task's onset, where the hand has moved by onset_m from its position at arming",
     [](const RecordedTrial& t) {
       return t.result.onsetTick > 0 && t.goTick > 0 ? secondsBetween(t.goTick, t.result.onsetTick) : kUnknown;
     }},
    {"peak_hand_speed_m_per_s", "Largest estimated speed of the hand over every tick of the movement, unfiltered",
     [](const RecordedTrial& t) { return t.peakHandSpeed; }},
    {"hand_path_m", "Length of the hand's path over every tick of the movement, unfiltered",
     [](const RecordedTrial& t) { return t.handPathLength; }},
    {"peak_force_n", "Largest coupling force over every tick of the movement", [](const RecordedTrial& t) { return t.peakForce; }},
    {"mean_force_n", "Mean coupling force over every tick of the movement", [](const RecordedTrial& t) { return t.meanForce; }},
    {"clamped_ticks",
     "Ticks of 1 ms in which the device's force was not the one asked for, because of its limit, its largest change in a tick, a ramp or its motors' heat",
     [](const RecordedTrial& t) { return counted(t, t.clampedTicks); }, true},
    {"missed_ticks", "Ticks of 1 ms that were skipped", [](const RecordedTrial& t) { return counted(t, t.missedTicks); }, true, true},
    {"dropped_samples", "Ticks that were simulated but not recorded, because the disk was too slow",
     [](const RecordedTrial& t) { return counted(t, t.droppedTicks); }, true, true},
    {"elapsed_s", "From the go signal to the end by the computer's clock; longer than the ticks say when ticks were missed",
     [](const RecordedTrial& t) { return t.elapsed; }, false, true},
};

}  // namespace

std::span<const TickMeasure> tickMeasures() { return kMeasures; }

const TickMeasure& tickMeasure(std::string_view name) {
  const auto at = std::find_if(std::begin(kMeasures), std::end(kMeasures), [&](const TickMeasure& m) { return m.name == name; });
  if (at == std::end(kMeasures)) throw FaultError(Fault{std::string(name), "is no measure of the ticks"});
  return *at;
}

TrialTimes timesOf(const RecordedTrial& trial, std::uint64_t firstSampleTick) {
  const auto since = [&](std::uint64_t tick) { return secondsBetween(firstSampleTick, tick); };
  const auto seconds = [&](std::uint64_t tick) { return tick == 0 ? kUnknown : since(tick); };
  TrialTimes t;
  t.start = since(trial.startTick);
  t.armed = seconds(trial.armedTick);
  t.go = seconds(trial.goTick);
  t.onset = seconds(trial.result.onsetTick);
  t.end = since(trial.result.endTick > 0 ? trial.result.endTick : trial.lastTick);
  return t;
}

}  // namespace reachlab::record
