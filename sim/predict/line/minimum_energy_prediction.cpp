#include "sim/predict/line/line_predictions.h"

#include "sim/predict/line/minimum_energy.h"

namespace reachlab::predict {
namespace {

class SeriesPrediction final : public Prediction {
 public:
  SeriesPrediction(PiecewiseSeries profile, std::vector<int> source, double fastest)
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
  PiecewiseSeries profile_;
  std::vector<int> source_;
};

}  // namespace

std::unique_ptr<Prediction> makeMinimumEnergyPrediction(const LineObject& object, Criterion criterion, double distance, double duration) {
  const ControlProblem system = makeControlProblem(object, criterion, distance);
  MinimumEnergyMotion motion = solveMinimumEnergy(system, duration);
  auto prediction = std::make_unique<SeriesPrediction>(std::move(motion.profile), object.source, motion.fastest);
  prediction->cost = motion.cost;
  prediction->condition = motion.condition;
  const PredictedHand start = prediction->handAt(0);
  if (system.handJumps) prediction->handJump = start.position, prediction->handVelocityJump.reset();
  else if (system.handVelocityJumps) prediction->handVelocityJump = start.velocity;
  return prediction;
}

}  // namespace reachlab::predict
