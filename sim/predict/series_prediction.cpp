#include "sim/predict/series_prediction.h"

#include "sim/predict/condition.h"
#include "sim/predict/least_effort.h"
#include "sim/predict/panel_effort.h"

namespace reachlab::predict {
namespace {

class SeriesPrediction final : public Prediction {
 public:
  SeriesPrediction(SeriesProfile profile, std::vector<int> source, double fastest)
      : profile_(std::move(profile)), source_(std::move(source)) {
    massCount_ = static_cast<int>(source_.size());
    fastest_ = fastest;
  }

  PredictedHand handAt(double t) const override { return profile_.evaluate(0, t); }

  void massesAt(double t, std::span<double> position, std::span<double> velocity) const override {
    for (int i = 0; i < massCount_; ++i) {
      const PredictedHand mass = profile_.evaluate(1 + source_[i], t);
      position[i] = mass.position, velocity[i] = mass.velocity;
    }
  }

  double objectVelocityAt(double t) const override { return profile_.evaluate(1 + source_.back(), t).velocity; }

  void sampleVelocities(std::span<double> hand, std::span<double> object) const override {
    profile_.sampleVelocity(0, duration, hand);
    profile_.sampleVelocity(1 + source_.back(), duration, object);
  }

 private:
  SeriesProfile profile_;
  std::vector<int> source_;
};

// By panels; an object whose rates ask for too many of them, or whose passes do not converge, by doubling and in DoubleDouble.
LeastEffort solve(const LineSystem<double>& system, const LineObject& object, Criterion criterion, double distance, double duration,
                  Precise precise) {
  const auto wanted = [&](double condition) {
    return (precise == Precise::Always || condition > kDoubleCondition) && condition <= kRefuseCondition;
  };
  std::optional<LeastEffort> effort;
  double condition = 0;
  if (const std::optional<PanelEffort> panels = PanelEffort::make(system, duration)) {
    condition = panels->condition();
    if (!wanted(condition)) return panels->solve();
    effort = panels->refine(makeLineSystem<DoubleDouble>(object, criterion, distance));
    if (effort) return *std::move(effort);
  } else {
    LineSystem<double> turned = system;
    rotateToModes(turned);
    effort = solveLeastEffort(turned, duration);
    condition = effort->condition;
    if (!wanted(condition)) return *std::move(effort);
  }
  effort = solveLeastEffort(makeLineSystem<DoubleDouble>(object, criterion, distance), duration);
  effort->condition = condition;
  return *std::move(effort);
}

}  // namespace

std::unique_ptr<Prediction> makeSeriesPrediction(const LineObject& object, Criterion criterion, double distance, double duration,
                                                 Precise precise) {
  const LineSystem<double> system = makeLineSystem<double>(object, criterion, distance);
  LeastEffort effort = solve(system, object, criterion, distance, duration, precise);
  auto prediction = std::make_unique<SeriesPrediction>(std::move(effort.profile), object.source, effort.fastest);
  prediction->cost = effort.cost;
  prediction->condition = effort.condition;
  const PredictedHand start = prediction->handAt(0);
  prediction->handJump = system.handJumps ? start.position : 0.0;
  if (!system.handJumps) prediction->handVelocityJump = system.handVelocityJumps ? start.velocity : 0.0;
  return prediction;
}

}  // namespace reachlab::predict
