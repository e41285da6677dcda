#include "constraints/regularity/surface_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "constraints/constraint.h"
#include "constraints/formula/formula.h"
#include "constraints/regularity/narrow.h"

namespace reachlab::constraints {
namespace {

constexpr double kAside = 0.25;   // of its way, by which a mass may leave it
constexpr double kFaster = 0.05;  // [m/s] that a mass may become within a step
constexpr int kHalvings = 20;     // of a step, until nothing is said

}  // namespace

std::shared_ptr<SurfaceWatch> SurfaceWatch::make(const Constraint& surface) {
  if (surface.surface.function != evaluateSurfaceProgram) return nullptr;
  return std::make_shared<SurfaceWatch>(surface);
}

SurfaceWatch::SurfaceWatch(const Constraint& surface) : series_(surface.formula->graph, surface.formula->place(), surface.shape()) {}

double SurfaceWatch::reach(const Motion& motion, double most) noexcept {
  double h = most, least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kHalvings; ++round) {
    std::array<Interval, 2> box, rate;
    for (std::size_t k = 0; k < 2; ++k) {
      const double gain = std::abs(motion.acceleration[k]) * h, aside = kAside * std::abs(motion.rate[k]) + gain;
      rate[k] = {motion.rate[k] - aside, motion.rate[k] + aside};
      const double q = motion.q[k], way = motion.rate[k] * h, round_off = 1e-15 * std::abs(q);
      box[k] = {q + std::min(way, 0.0) - aside * h - round_off, q + std::max(way, 0.0) + aside * h + round_off};
    }
    const double last = series_.bound(box, rate), reach = narrow::reachOf(last, std::max(motion.speed, kFaster));
    if (reach >= h) return h;
    if (std::isfinite(last)) least = std::min(least, h);
    h = std::isfinite(last) ? std::clamp(reach, h / 16, h / 2) : h / 2;
  }
  return std::isfinite(least) ? h : most;
}

bool SurfaceWatch::allows(const Motion& motion, double dt) noexcept {
  if (knows(motion.q, motion.rate, dt)) return true;
  for (const double ticks : {32.0, 8.0, 2.0}) {
    std::array<Interval, 2> box, rate;
    std::array<double, 2> fastest;
    for (std::size_t k = 0; k < 2; ++k) {
      fastest[k] = (1 + kAside) * std::abs(motion.rate[k]) + std::max(0.1 * motion.speed, kFaster) / motion.length[k];
      rate[k] = {-fastest[k], fastest[k]};
      box[k] = {motion.q[k] - ticks * dt * fastest[k], motion.q[k] + ticks * dt * fastest[k]};
    }
    const double reach = narrow::reachOf(series_.bound(box, rate), std::max(motion.speed, kFaster));
    if (!(reach >= dt)) continue;
    known_ = box;
    fastest_ = fastest;
    within_ = dt;
    return true;
  }
  return reach(motion, dt) >= dt;
}

}  // namespace reachlab::constraints
