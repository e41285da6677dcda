#include "sim/predict/series_prediction.h"

#include "sim/predict/condition.h"
#include "sim/predict/least_effort.h"

namespace reachlab {
namespace {

class SeriesPrediction final : public Prediction {
 public:
  SeriesPrediction(SeriesProfile profile, std::vector<int> source) : profile_(std::move(profile)), source_(std::move(source)) {
    massCount_ = static_cast<int>(source_.size());
    fastest_ = 1 / profile_.width;
  }

  PredictedHand handAt(double t) const override { return profile_.evaluate(0, t); }

  void massesAt(double t, std::span<double> position, std::span<double> velocity) const override {
    for (int i = 0; i < massCount_; ++i) {
      const PredictedHand mass = profile_.evaluate(1 + source_[i], t);
      position[i] = mass.position, velocity[i] = mass.velocity;
    }
  }

 private:
  SeriesProfile profile_;
  std::vector<int> source_;
};

}  // namespace

std::unique_ptr<Prediction> makeSeriesPrediction(const LineObject& object, Criterion criterion, double distance, double duration,
                                                 Precise precise) {
  LineSystem<double> system = makeLineSystem<double>(object, criterion, distance);
  rotateToModes(system);
  LeastEffort effort = solveLeastEffort(system, duration);
  const double condition = effort.condition;
  if ((precise == Precise::Always || condition > kDoubleCondition) && condition <= kRefuseCondition)
    effort = solveLeastEffort(makeLineSystem<DoubleDouble>(object, criterion, distance), duration);

  auto prediction = std::make_unique<SeriesPrediction>(std::move(effort.profile), object.source);
  prediction->cost = effort.cost;
  prediction->condition = condition;
  const PredictedHand start = prediction->handAt(0);
  prediction->handJump = system.handJumps ? start.position : 0.0;
  if (!system.handJumps) prediction->handVelocityJump = system.handVelocityJumps ? start.velocity : 0.0;
  return prediction;
}

}  // namespace reachlab
