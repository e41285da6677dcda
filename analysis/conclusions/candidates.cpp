#include "analysis/conclusions/candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/conclusions/near_predictions.h"
#include "base/error.h"
#include "base/math/minimum_jerk.h"
#include "sim/experiment/experiment.h"

namespace reachlab::analysis {
namespace {

constexpr double kSame = 1e-6;                       // of the peak
constexpr std::size_t kCompared = 401;               // instants
constexpr std::array kHeavier{1.5, 2.5, 5.0, 12.0};  // times the largest mass: outside the range

bool dependsOnHandMass(predict::Criterion criterion) {
  return criterion == predict::Criterion::MinHandForce || criterion == predict::Criterion::MinHandForceChange ||
         criterion == predict::Criterion::MinComAcceleration;
}

struct Shape {
  std::vector<double> phi;  // at the task's T
  double fastest = 0;       // [rad/s]
};

Shape shapeOf(const experiment::CompiledExperiment& experiment, predict::Criterion criterion, double mass, double damping) {
  predict::PredictOptions how;
  how.handMass = mass;
  how.handDamping = damping;
  const auto prediction = predict::predict(experiment, criterion, how);
  Shape shape;
  shape.phi.resize(kCompared);
  sampleProfile(*prediction, shape.phi);
  shape.fastest = (prediction->scanCount() - 48) / (1.2 * prediction->duration);
  return shape;
}

bool same(const Shape& a, const Shape& b) {
  double peak = 0, apart = 0;
  for (std::size_t i = 0; i < a.phi.size(); ++i) {
    peak = std::max(peak, std::abs(a.phi[i]));
    apart = std::max(apart, std::abs(a.phi[i] - b.phi[i]));
  }
  return apart <= kSame * peak;
}

Predictor predictorOf(const experiment::CompiledExperiment& experiment, predict::Criterion criterion, double mass, double damping) {
  return [experiment, criterion, mass, damping](double duration,
                                                std::span<const predict::Prediction* const> near) -> std::unique_ptr<predict::Prediction> {
    predict::PredictOptions how;
    how.duration = duration;
    how.handMass = mass;
    how.handDamping = damping;
    how.near = near;
    try {
      return predict::predict(experiment, criterion, how);
    } catch (const Error&) {
      return nullptr;  // too short to be carried out
    }
  };
}

ProfileFamily::Sampler samplerOf(Predictor predictor) {
  return [predictor = std::move(predictor)](double duration, std::span<double> phi) {
    const auto prediction = predictor(duration, {});
    return prediction && sampleProfile(*prediction, phi);
  };
}

/// Joint torque change takes a hundred times as long to predict as the others, so its durations lie as far apart as they may.
std::unique_ptr<ProfileFamily> costlyFamily(const Predictor& predictor, const RecordingFilter& filter, ProfileFamily::Grid grid,
                                            double duration) {
  const double finest = grid.spacing;
  const auto familyAt = [&](double factor) {
    grid.spacing = factor * finest;
    return std::make_unique<ProfileFamily>(sampleNearPredictions(predictor, duration, grid.spacing), filter, grid);
  };
  for (const double factor : {3.0, 2.5, 2.0}) {
    auto family = familyAt(factor);
    // Half-way between two of them, where the interpolation is worst, and at a shorter movement, where the profile changes fastest.
    const auto between = [&](double t) { return (std::floor(t / grid.spacing) + 0.5) * grid.spacing; };
    if (family->errorAt(between(0.7 * duration)) <= kSame / 2 && family->errorAt(between(duration)) <= kSame / 2) return family;
  }
  return familyAt(1);
}

/// The masses between which, and outside which, the mass of the hand is fitted.
void addMasses(Candidate& candidate, const std::vector<double>& masses,
               const std::function<std::shared_ptr<const ProfileFamily>(double)>& familyOf) {
  candidate.masses = masses;
  if (masses.size() < 2) return;
  candidate.familyOf = familyOf;
  const auto add = [&](std::vector<MassFamily>& to, double mass) { to.push_back({mass, familyOf(mass)}); };
  for (std::size_t i = 0; i + 1 < masses.size(); ++i) add(candidate.between, (masses[i] + masses[i + 1]) / 2);
  if (masses.front() > 0) add(candidate.beyond, 0), add(candidate.beyond, masses.front() / 2);
  for (const double factor : kHeavier) add(candidate.beyond, factor * masses.back());
}

struct Draft {
  predict::Criterion criterion{};
  std::vector<double> masses;
  std::vector<Shape> shapes;  // one a mass
};

}  // namespace

std::vector<std::vector<predict::Criterion>> namesOf(const CandidateSet& set) {
  std::vector<std::vector<predict::Criterion>> names;
  for (const Candidate& c : set.candidates) names.push_back(c.criteria);
  return names;
}

std::optional<std::size_t> placeOf(const std::vector<std::vector<predict::Criterion>>& names, predict::Criterion criterion) {
  for (std::size_t k = 0; k < names.size(); ++k)
    if (std::find(names[k].begin(), names[k].end(), criterion) != names[k].end()) return k;
  return std::nullopt;
}

CandidateSet makeCandidates(const experiment::CompiledExperiment& compiled, const CandidateOptions& options) {
  const experiment::Experiment& experiment = compiled.experiment();
  CandidateSet out;
  out.massGiven = options.handMass.has_value() || experiment.handMass > 0;
  out.masses = out.massGiven ? std::vector<double>{options.handMass.value_or(experiment.handMass)} : options.handMasses;
  std::sort(out.masses.begin(), out.masses.end());
  out.masses.erase(std::unique(out.masses.begin(), out.masses.end()), out.masses.end());
  std::vector<Draft> drafts;
  double fastest = 0;
  for (const predict::Criterion criterion : predict::orAll(options.criteria)) {
    Draft draft{criterion, {}, {}};
    std::string why;
    for (const double mass : dependsOnHandMass(criterion) ? out.masses : std::vector<double>{out.masses.front()}) {
      try {
        draft.shapes.push_back(shapeOf(compiled, criterion, mass, options.handDamping));
        draft.masses.push_back(mass);
      } catch (const Error& error) {
        why = error.what();
      }
    }
    if (draft.masses.empty())
      out.refusals.push_back(why.starts_with(nameOf(criterion)) ? why : fmt::format("{}: {}", nameOf(criterion), why));
    for (const Shape& shape : draft.shapes) fastest = std::max(fastest, shape.fastest);
    if (!draft.masses.empty()) drafts.push_back(std::move(draft));
  }

  const RecordingFilter filter(options.cutoff, options.rate);
  const double T = experiment.task ? experiment.task->duration : 1;
  ProfileFamily::Grid grid;
  grid.spacing = std::min(T / 45, fastest > 0 ? 0.4 / fastest : T);
  grid.shortest = std::max(0.35 * T, 5 * grid.spacing);
  grid.parts = static_cast<std::size_t>(std::clamp(4 * 1.3 * T * fastest, 240.0, 1600.0));
  for (const Draft& draft : drafts) {
    const auto known = std::find_if(out.candidates.begin(), out.candidates.end(), [&](const Candidate& candidate) {
      const auto other =
          std::find_if(drafts.begin(), drafts.end(), [&](const Draft& d) { return d.criterion == candidate.criteria.front(); });
      if (other->masses != draft.masses) return false;
      for (std::size_t m = 0; m < draft.shapes.size(); ++m)
        if (!same(other->shapes[m], draft.shapes[m])) return false;
      return true;
    });
    if (known != out.candidates.end()) {
      known->criteria.push_back(draft.criterion);
      continue;
    }
    Candidate candidate;
    candidate.criteria = {draft.criterion};
    const auto familyOf = [compiled, filter, grid, T, criterion = draft.criterion,
                           damping = options.handDamping](double mass) -> std::shared_ptr<const ProfileFamily> {
      const Predictor predictor = predictorOf(compiled, criterion, mass, damping);
      if (criterion == predict::Criterion::MinTorqueChange) return costlyFamily(predictor, filter, grid, T);
      return std::make_shared<ProfileFamily>(samplerOf(predictor), filter, grid);
    };
    for (const double mass : draft.masses) candidate.families.push_back(familyOf(mass));
    if (dependsOnHandMass(draft.criterion)) addMasses(candidate, draft.masses, familyOf);
    out.candidates.push_back(std::move(candidate));
  }
  Candidate reference;
  reference.families.push_back(
      std::make_shared<ProfileFamily>(ProfileFamily::sameFor([](double s) { return minimumJerkRate(s); }), filter, grid));
  out.candidates.push_back(std::move(reference));
  return out;
}

}  // namespace reachlab::analysis
