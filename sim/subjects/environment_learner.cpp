#include "sim/subjects/environment_learner.h"

namespace reachlab::subjects {

void EnvironmentTrace::add(double along, double across, double speed) noexcept {
  squares_ += speed * speed;
  along_ += along * speed;
  across_ += across * speed;
}

void EnvironmentTrace::look(double degrees, double speed) noexcept {
  if (speed <= fastest_) return;
  fastest_ = speed;
  angle_ = degrees;
}

EnvironmentModel EnvironmentTrace::error() const noexcept {
  if (!(squares_ > 0)) return {0, 0, angle_};
  return {along_ / squares_, across_ / squares_, angle_};
}

void learn(const LearningRates& rates, const EnvironmentModel& error, LearntEnvironment& learnt) {
  for (double EnvironmentModel::*of : {&EnvironmentModel::along, &EnvironmentModel::across, &EnvironmentModel::angle}) {
    learnt.fast.*of = rates.keepFast * (learnt.fast.*of) + rates.learnFast * (error.*of);
    learnt.slow.*of = rates.keepSlow * (learnt.slow.*of) + rates.learnSlow * (error.*of);
  }
}

}  // namespace reachlab::subjects
