#include "sim/predict/sweep/parameter_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numeric>
#include <optional>
#include <thread>

#include "base/as_number.h"
#include "base/fault.h"
#include "base/number_range.h"
#include "base/system/worker_threads.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/tested_ranges.h"

namespace reachlab::predict {
namespace {

using experiment::Experiment;

constexpr double kRipple = 1e-9;  // of the peak
constexpr int kMaxValues = 100000;
constexpr const char* kForm = "KEY=FROM:TO:STEP";

double parseNumber(std::string_view text, const std::string& whole) {
  const auto value = asNumber<double>(text);
  if (!value || !std::isfinite(*value)) throw FaultError(Fault{"sweep", fmt::format("is {}, where '{}' is no number", whole, text), kForm});
  return *value;
}

bool has(const Experiment& e, std::string_view needed) {
  if (needed == "springs") return !e.object.stiffness.empty() || e.coupling;
  if (needed == "springs of its own") return !e.object.stiffness.empty();
  if (needed == "coupling") return e.coupling.has_value();
  return needed.empty() || !e.object.masses.empty();
}

void resizeObject(experiment::Experiment& experiment, double value, bool keepTotal) {
  experiment::Object& object = experiment.object;
  if (value != std::floor(value) || value < 1 || value > experiment::kMaxMasses)
    throw FaultError(
        Fault{"sweep", fmt::format("is n = {}", value), fmt::format("whole numbers of masses from 1 to {}", experiment::kMaxMasses)});
  const auto n = static_cast<size_t>(value);
  const double total = std::accumulate(object.masses.begin(), object.masses.end(), 0.0);
  const bool parallel = object.kind == experiment::ObjectKind::Parallel;
  const double spring = !object.stiffness.empty() ? object.stiffness[0] : experiment.coupling ? experiment.coupling->stiffness : 0;
  const double damper = object.damping.empty() ? 0 : object.damping[0];
  object.masses.assign(n, keepTotal ? total / value : object.masses.at(0));
  object.stiffness.assign(parallel ? n : n - 1, spring);
  object.damping.assign(object.stiffness.size(), damper);
  if (!parallel) object.kind = n == 1 ? experiment::ObjectKind::Point : experiment::ObjectKind::Chain;
}

// What an experiment's file may have. The numbers of masses have another bound.
std::optional<NumberRange> rangeOf(const std::string& key) {
  if (key == "duration_s") return experiment::durationRange();
  if (key.ends_with("stiffness_n_per_m")) return experiment::stiffnessRange();
  if (key.ends_with("_n_s_per_m")) return experiment::dampingRange();
  if (key.ends_with("mass_kg")) return key.starts_with("hand_") ? experiment::handMassRange() : experiment::massRange();
  return std::nullopt;
}

constexpr std::array<SweepKey, 12> kKeys{{
    {"duration_s", "movement time", "", [](double v, Experiment&, PredictOptions& o) { o.duration = v; }},
    {"stiffness_n_per_m", "every spring, the coupling too", "springs",
     [](double v, Experiment& e, PredictOptions&) {
       std::ranges::fill(e.object.stiffness, v);
       if (e.coupling) e.coupling->stiffness = v;
     }},
    {"object.stiffness_n_per_m", "every spring of the object", "springs of its own",
     [](double v, Experiment& e, PredictOptions&) { std::ranges::fill(e.object.stiffness, v); }},
    {"coupling.stiffness_n_per_m", "the coupling", "coupling", [](double v, Experiment& e, PredictOptions&) { e.coupling->stiffness = v; }},
    {"damping_n_s_per_m", "every damper, the coupling's too", "springs",
     [](double v, Experiment& e, PredictOptions&) {
       e.object.damping.assign(e.object.stiffness.size(), v);
       if (e.coupling) e.coupling->damping = v;
     }},
    {"viscosity_n_s_per_m", "viscosity of the surroundings", "masses",
     [](double v, Experiment& e, PredictOptions&) { e.object.viscosity = v; }},
    {"mass_kg", "every mass", "masses", [](double v, Experiment& e, PredictOptions&) { std::ranges::fill(e.object.masses, v); }},
    {"total_mass_kg", "the object's mass, shared as it is", "masses",
     [](double v, Experiment& e, PredictOptions&) {
       const double total = std::accumulate(e.object.masses.begin(), e.object.masses.end(), 0.0);
       for (double& m : e.object.masses) m *= v / total;
     }},
    {"n", "number of masses, the total mass kept, springs like the first", "masses",
     [](double v, Experiment& e, PredictOptions&) { resizeObject(e, v, true); }},
    {"n_each", "number of masses, each like the first, springs like the first", "masses",
     [](double v, Experiment& e, PredictOptions&) { resizeObject(e, v, false); }},
    {"hand_mass_kg", "mass of the hand", "", [](double v, Experiment&, PredictOptions& o) { o.handMass = v; }},
    {"hand_damping_n_s_per_m", "damping of the hand itself", "", [](double v, Experiment&, PredictOptions& o) { o.handDamping = v; }},
}};

}  // namespace

ProfileShape computeShape(const Prediction& prediction) {
  const int count = 4 * prediction.scanCount();
  const double ripple = kRipple * std::abs(prediction.handPeak);
  ProfileShape shape;
  // A maximum counts once the velocity has fallen from it by more than a ripple, after having risen to it by as much.
  double low = prediction.handAt(0).velocity, high = low;
  bool rising = false;
  for (int i = 1; i <= count; ++i) {
    const double v = prediction.handAt(prediction.duration * i / count).velocity;
    if (v < -ripple) shape.reverses = true;
    if (rising) {
      high = std::max(high, v);
      if (v < high - ripple) ++shape.velocityPeaks, rising = false, low = v;
    } else {
      low = std::min(low, v);
      if (v > low + ripple) rising = true, high = v;
    }
  }
  if (prediction.handAt(0).velocity < -ripple) shape.reverses = true;
  return shape;
}

std::span<const SweepKey> sweepKeys() { return kKeys; }

std::vector<double> Sweep::values() const {
  constexpr double kWhole = 1e-6;  // of a step, by which TO may be missed
  std::vector<double> all;
  const auto count = static_cast<long>(std::floor((to - from) / step + kWhole));
  for (long i = 0; i <= count; ++i) all.push_back(from + static_cast<double>(i) * step);
  return all;
}

Sweep parseSweep(const std::string& text) {
  const std::string_view all = text;
  const size_t equal = all.find('='), first = all.find(':', equal), second = first == all.npos ? all.npos : all.find(':', first + 1);
  if (equal == all.npos || second == all.npos) throw FaultError(Fault{"sweep", "is " + text, kForm});
  Sweep sweep;
  sweep.key = all.substr(0, equal);
  if (std::none_of(kKeys.begin(), kKeys.end(), [&](const SweepKey& k) { return k.name == sweep.key; })) {
    std::string names;
    for (const SweepKey& k : kKeys) names += (names.empty() ? "" : ", ") + std::string(k.name);
    throw FaultError(Fault{"sweep", fmt::format("has '{}', which is no key", sweep.key), names});
  }
  sweep.from = parseNumber(all.substr(equal + 1, first - equal - 1), text);
  sweep.to = parseNumber(all.substr(first + 1, second - first - 1), text);
  sweep.step = parseNumber(all.substr(second + 1), text);
  if (!(sweep.step > 0) || sweep.to < sweep.from || (sweep.to - sweep.from) / sweep.step > kMaxValues)
    throw FaultError(Fault{"sweep", "is " + text, fmt::format("FROM <= TO, STEP > 0, at most {} values", kMaxValues)});
  return sweep;
}

void applySweepValue(const std::string& key, double value, Experiment& experiment, PredictOptions& options) {
  const bool zeroAllowed = key == "damping_n_s_per_m" || key == "viscosity_n_s_per_m" || key.starts_with("hand_");
  if (!(value > 0) && !(zeroAllowed && value == 0)) throw FaultError(Fault{"sweep", fmt::format("is {} = {}", key, value), "above 0"});
  if (const auto range = rangeOf(key); range && !isWithin(*range, value))
    throw FaultError(Fault{"sweep", fmt::format("is {} = {}", key, value), range->allowed});
  const auto found = std::find_if(kKeys.begin(), kKeys.end(), [&](const SweepKey& k) { return k.name == key; });
  if (found == kKeys.end()) throw FaultError(Fault{"sweep", fmt::format("has '{}', which is no key", key), "a key that is listed"});
  const bool ofSprings = key == "n" || key == "n_each" || key.ends_with("stiffness_n_per_m") || key == "damping_n_s_per_m";
  if (ofSprings && !experiment.hands.empty())
    throw FaultError(Fault{"sweep", fmt::format("is of {}, and this experiment's hands have springs of their own", key), "another key"});
  if (!has(experiment, found->needs))
    throw FaultError(Fault{"sweep", fmt::format("would change nothing: this object has no {}", found->needs), "another key"});
  found->set(value, experiment, options);
}

std::vector<SweepRow> computeSweep(const experiment::CompiledExperiment& compiled, Criterion criterion, const PredictOptions& options,
                                   const Sweep& sweep, const std::function<void(int, int)>& progress) {
  const std::vector<double> values = sweep.values();
  const int total = static_cast<int>(values.size());
  std::vector<SweepRow> rows(values.size());
  std::atomic<int> next{0};
  std::mutex reporting;
  int done = 0;
  runOnThreads(std::min(std::thread::hardware_concurrency(), static_cast<unsigned>(total)), [&](const std::atomic<bool>& ended) {
    for (int i = next++; i < total && !ended; i = next++) {
      SweepRow& row = rows[i];
      row.value = values[i];
      try {
        experiment::Experiment changed = compiled.experiment();
        PredictOptions changedOptions = options;
        applySweepValue(sweep.key, row.value, changed, changedOptions);
        row.prediction = predict(changed, compiled.constraint(), criterion, changedOptions);
        row.shape = computeShape(*row.prediction);
      } catch (const RefusedError& refused) {
        row.refusal = refused.what();
      }
      const std::lock_guard lock(reporting);
      ++done;
      if (progress) progress(done, total);
    }
  });
  return rows;
}

}  // namespace reachlab::predict
