#include "analysis/measures/deviation_and_adaptation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/experiment/experiment.h"
#include "sim/experiment/task_plane.h"

namespace reachlab::analysis {
namespace {

constexpr double kWindow = 0.2;  // [s] to each side of the largest speed

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// The rows of the movement.
struct Rows {
  std::size_t first = 0, end = 0;  // end is one behind the last
  explicit operator bool() const { return first < end; }
};

template <class Law>
bool acts(const experiment::Experiment& experiment) {
  return std::any_of(experiment.environment.begin(), experiment.environment.end(),
                     [](const experiment::HandForce& force) { return std::holds_alternative<Law>(force.law); });
}

Rows movementRows(const TrialData& trial) {
  if (!std::isfinite(trial.taskOnset) || !std::isfinite(trial.taskEnd)) return {};
  constexpr double kRounding = 1e-9;
  const auto row = [&](double time) { return std::max(0.0, (time - trial.first) * trial.rate); };
  const auto first = static_cast<std::size_t>(std::ceil(row(trial.taskOnset) - kRounding));
  const auto last = static_cast<std::size_t>(std::floor(row(trial.taskEnd) + kRounding));
  return {first, std::min(last + 1, trial.hand.size())};
}

void measureAdaptation(const TrialData& trial, const Vec3& along, const Vec3& right, std::size_t fastest, TrialMeasures& m) {
  if (!trial.scene.channel || trial.scene.otherForce || !trial.scene.trained || trial.environment.size() != trial.hand.size()) return;
  const double coefficient = dot(experiment::times(*trial.scene.trained, along), right);
  const auto reach = static_cast<std::size_t>(std::floor(kWindow * trial.rate + 1e-9));
  const std::size_t first = fastest - std::min(fastest, reach), end = std::min(fastest + reach + 1, trial.hand.size());
  double product = 0, ideal = 0, pressed = 0;
  for (std::size_t i = first; i < end; ++i) {
    const double force = dot(trial.environment[i], right), wanted = coefficient * dot(trial.velocity[i], along);
    product += force * wanted;
    ideal += wanted * wanted;
    pressed += force * force;
  }
  if (!(ideal > 0)) return;
  const double share = product / ideal;
  m.adaptation = 100 * share;
  if (pressed > 0) m.adaptationR2 = 1 - (pressed - 2 * share * product + share * share * ideal) / pressed;
}

}  // namespace

std::optional<experiment::SquareMatrix<3>> viscousFieldOf(const experiment::Experiment& experiment) {
  std::optional<experiment::SquareMatrix<3>> sum;
  for (const experiment::HandForce& force : experiment.environment)
    if (const auto* viscous = std::get_if<experiment::ViscousForce>(&force.law)) {
      if (!sum) sum.emplace();
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) (*sum)[i][j] += viscous->matrix[i][j];
    }
  return sum == experiment::SquareMatrix<3>{} ? std::nullopt : sum;
}

double strengthOf(const experiment::SquareMatrix<3>& field, const experiment::SquareMatrix<3>& trained) {
  double product = 0, square = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) product += field[i][j] * trained[i][j], square += trained[i][j] * trained[i][j];
  return product / square;
}

TrialScene sceneOf(const experiment::Experiment& experiment, const std::optional<experiment::SquareMatrix<3>>& trained) {
  TrialScene scene;
  scene.normal = experiment::normalOf(experiment.task ? experiment.task->plane : experiment::TaskPlane::Horizontal);
  const auto field = viscousFieldOf(experiment);
  scene.channel = acts<experiment::ChannelForce>(experiment);
  scene.otherForce = experiment.environment.size() > 1;
  scene.inField = field || acts<experiment::JointViscousForce>(experiment);
  if (scene.inField) scene.strength = field && trained ? strengthOf(*field, *trained) : 1;
  scene.cursor = experiment.cursor.has_value();
  if (experiment.cursor) {
    scene.clamp = experiment.cursor->clamp;
    scene.rotation = experiment.cursor->rotation;
  }
  scene.trained = trained;
  return scene;
}

void measureAcross(const TrialData& trial, TrialMeasures& m) {
  if (trial.along.size() != 1 || trial.velocity.size() != trial.hand.size()) return;
  const Vec3 along = trial.along.front(), right = experiment::rightOf(along, trial.scene.normal);
  const Rows rows = movementRows(trial);
  if (right == Vec3{} || !rows) return;
  const auto deviation = [&](std::size_t i) { return dot(trial.hand[i] - trial.start, right); };
  const auto angle = [&](std::size_t i) { return degrees(std::atan2(-deviation(i), dot(trial.hand[i] - trial.start, along))); };
  std::size_t fastest = rows.first;
  const double distance = norm(trial.target - trial.start);
  m.maxPerpendicular = 0;
  for (std::size_t i = rows.first; i < rows.end; ++i) {
    if (std::abs(deviation(i)) > std::abs(m.maxPerpendicular)) m.maxPerpendicular = deviation(i);
    if (norm(trial.velocity[i]) > norm(trial.velocity[fastest])) fastest = i;
    if (std::isnan(m.handAngleAtRadius) && norm(trial.hand[i] - trial.start) >= distance) m.handAngleAtRadius = angle(i);
  }
  m.perpendicularAtPeakSpeed = deviation(fastest);
  m.handAngle = angle(fastest);
  if (trial.scene.channel) {
    m.channelLeak = 0;
    for (const Vec3& hand : trial.hand) {
      const Vec3 off = hand - trial.start;
      m.channelLeak = std::max(m.channelLeak, norm(off - dot(off, along) * along));
    }
  }
  measureAdaptation(trial, along, right, fastest, m);
}

}  // namespace reachlab::analysis
