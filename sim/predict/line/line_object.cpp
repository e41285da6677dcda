#include "sim/predict/line/line_object.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/fault.h"
#include "sim/experiment/experiment.h"

namespace reachlab::predict {
namespace {

constexpr double kEqualPhase = 1e-9;  // |w_i - w_j| T below which two frequencies are one

void requirePositive(const std::vector<double>& values, const char* what, const char* unit) {
  for (size_t i = 0; i < values.size(); ++i)
    if (!(values[i] > 0) || !std::isfinite(values[i]))
      throw RefusedError(fmt::format("{} {} is {} {}: the masses behind it cannot be brought to rest by the hand; give it a value above 0",
                                     what, i + 1, values[i], unit));
}

}  // namespace

bool LineObject::damped(bool withHand) const {
  const auto any = [](const std::vector<double>& values) {
    return std::any_of(values.begin(), values.end(), [](double b) { return b > 0; });
  };
  return any(viscosity) || any(dampers) || (withHand && handDamping > 0);
}

double LineObject::totalMass() const { return std::accumulate(masses.begin(), masses.end(), handMass); }

namespace {

// One hand that is given by `hands` holds by its own springs: as a chain's first spring, or as all springs of a parallel object.
void takeOneHand(const experiment::Hand& hand, LineObject& line) {
  if (line.parallel != (hand.mass == 0) || hand.mass > 1)
    throw FaultError(Fault{"hands[0].mass",
                           fmt::format("is {}, and a prediction needs a hand that holds {}", hand.mass,
                                       line.parallel ? "each mass of a parallel object" : "the first mass of a chain"),
                           line.parallel ? "no key mass" : "1"});
  std::copy(hand.stiffness.begin(), hand.stiffness.end(), line.springs.begin());
  std::copy(hand.damping.begin(), hand.damping.end(), line.dampers.begin());
}

}  // namespace

LineObject makeLineObject(const experiment::Experiment& experiment, double handMass, double handDamping) {
  const experiment::Object& object = experiment.object;
  if (object.kind == experiment::ObjectKind::Body)
    throw FaultError(Fault{"object.kind", "is body", "point, chain, parallel: the criteria are not defined for a body that turns"});
  LineObject line;
  line.handMass = handMass;
  line.handDamping = handDamping;
  if (!(handMass >= 0) || !(handDamping >= 0))
    throw FaultError(Fault{handMass >= 0 ? "hand_damping" : "hand_mass", "is negative", "0 or more"});
  if (object.kind == experiment::ObjectKind::None) return line;
  line.parallel = object.kind == experiment::ObjectKind::Parallel;
  line.masses = object.masses;
  line.viscosity.assign(object.masses.size(), object.viscosity);
  const size_t n = line.masses.size();
  if (!line.parallel) {
    if (!experiment.coupling)
      throw FaultError(Fault{"coupling", "is missing, and the prediction needs the spring between hand and object", {}});
    line.springs.push_back(experiment.coupling->stiffness);
    line.dampers.push_back(experiment.coupling->damping);
  }
  line.springs.insert(line.springs.end(), object.stiffness.begin(), object.stiffness.end());
  line.dampers.insert(line.dampers.end(), object.damping.begin(), object.damping.end());
  line.dampers.resize(n, 0.0);
  if (n == 0 || line.springs.size() != n)
    throw FaultError(Fault{"object.stiffness_n_per_m", "has not as many springs to the hand as there are masses", {}});
  if (experiment.hands.size() == 1) takeOneHand(experiment.hands.front(), line);
  requirePositive(line.masses, "mass", "kg");
  requirePositive(line.springs, line.parallel ? "spring" : "spring (the coupling is number 1)", "N/m");
  line.source.resize(n);
  std::iota(line.source.begin(), line.source.end(), 0);
  return line;
}

LineObject mergeEqualFrequencies(const LineObject& object, double duration, std::vector<std::string>& warnings) {
  if (!object.parallel) return object;
  LineObject merged = object;
  constexpr std::array kOfMass{&LineObject::masses, &LineObject::springs, &LineObject::dampers, &LineObject::viscosity};
  for (const auto numbers : kOfMass) (merged.*numbers).clear();
  const auto frequency = [](const LineObject& o, int i) { return std::sqrt(o.springs[i] / o.masses[i]); };
  const auto decay = [](const LineObject& o, int i) { return o.dampers[i] / o.masses[i]; };
  const auto drag = [](const LineObject& o, int i) { return o.viscosity[i] / o.masses[i]; };
  for (int i = 0; i < object.count(); ++i) {
    int place = 0;
    while (place < merged.count() && !(std::abs(frequency(merged, place) - frequency(object, i)) * duration < kEqualPhase &&
                                       std::abs(decay(merged, place) - decay(object, i)) * duration < kEqualPhase &&
                                       std::abs(drag(merged, place) - drag(object, i)) * duration < kEqualPhase))
      ++place;
    if (place < merged.count())
      warnings.push_back(fmt::format("masses {} and {} have equal frequencies ({:.6g} rad/s): they move as one mass",
                                     std::find(merged.source.begin(), merged.source.begin() + i, place) - merged.source.begin() + 1, i + 1,
                                     frequency(object, i)));
    for (const auto numbers : kOfMass) {
      std::vector<double>& sum = merged.*numbers;
      if (static_cast<int>(sum.size()) == place) sum.push_back(0);
      sum[place] += (object.*numbers)[i];
    }
    merged.source[i] = place;
  }
  return merged;
}

double computeTravelTime(const LineObject& object) {
  double sum = 0;
  for (int i = 0; i < object.count(); ++i) sum += std::sqrt(object.masses[i] / object.springs[i]);
  return 2 * sum;
}

}  // namespace reachlab::predict
