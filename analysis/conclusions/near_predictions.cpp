#include "analysis/conclusions/near_predictions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <vector>

namespace reachlab::analysis {
namespace {

constexpr int kTogether = 6;

/// Profiles at kTogether neighbouring durations; empty where nothing can be predicted.
struct Neighbours {
  std::once_flag made;
  std::vector<std::vector<double>> phi;
};

struct NearPredictions {
  Predictor predictor;
  double typical = 0, spacing = 0;
  std::once_flag begun;
  std::unique_ptr<predict::Prediction> first;  // for `typical`
  std::mutex mutex;
  std::map<int, Neighbours> places;  // guarded by mutex; what it holds by Neighbours::made

  Neighbours& at(int place) {
    const std::lock_guard lock(mutex);
    return places[place];
  }

  void make(int place, std::size_t instants, Neighbours& out) {
    std::call_once(begun, [&] { first = predictor(typical, {}); });
    std::vector<std::unique_ptr<predict::Prediction>> predictions;
    std::vector<const predict::Prediction*> near;
    if (first) near.push_back(first.get());
    for (int i = 0; i < kTogether; ++i) {
      const int index = place * kTogether + i;
      std::vector<double> phi(instants);
      auto prediction = index > 0 ? predictor(index * spacing, near) : nullptr;
      if (!prediction || !sampleProfile(*prediction, phi)) phi.clear();
      out.phi.push_back(std::move(phi));
      if (!prediction) continue;
      if (predictions.empty()) near.clear();  // a neighbour is a better start
      near.push_back(prediction.get());
      predictions.push_back(std::move(prediction));
    }
  }
};

}  // namespace

bool sampleProfile(const predict::Prediction& prediction, std::span<double> phi) {
  std::vector<double> object(phi.size());
  prediction.sampleVelocities(phi, object);
  for (double& v : phi) v *= prediction.duration / prediction.distance;
  return std::all_of(phi.begin(), phi.end(), [](double v) { return std::isfinite(v); });
}

ProfileFamily::Sampler sampleNearPredictions(Predictor predictor, double typical, double spacing) {
  const auto all = std::make_shared<NearPredictions>();
  all->predictor = std::move(predictor);
  all->typical = typical;
  all->spacing = spacing;
  return [all](double duration, std::span<double> phi) {
    const auto index = static_cast<int>(std::lround(duration / all->spacing));
    if (index * all->spacing != duration) {
      const auto prediction = all->predictor(duration, {});
      return prediction && sampleProfile(*prediction, phi);
    }
    Neighbours& neighbours = all->at(index / kTogether);
    std::call_once(neighbours.made, [&] { all->make(index / kTogether, phi.size(), neighbours); });
    const std::vector<double>& known = neighbours.phi[static_cast<std::size_t>(index % kTogether)];
    std::copy(known.begin(), known.end(), phi.begin());
    return !known.empty();
  };
}

}  // namespace reachlab::analysis
