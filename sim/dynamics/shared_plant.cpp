#include "sim/dynamics/shared_plant.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "sim/dynamics/systems/held_geometry.h"
#include "sim/experiment/experiment.h"

namespace reachlab::dynamics {
namespace {

struct Hand {
  HandSprings springs;
  HandSegment segment;
  HandSample end;
  double grip = 1;
  double work = 0;  // [J]
};

/// State, room for the method and what all geometries share. `Geometry` maps places and rates to the masses' r and v, and the masses' forces
/// to accelerations of the rates. A state is the places and then the rates.
template <class Geometry>
class HeldObject final : public SharedPlant {
 public:
  HeldObject(const ObjectModel& model, std::vector<HandSprings> springs, Geometry geometry)
      : model_(model), geometry_(std::move(geometry)), now_(geometry_.placeCount() + geometry_.rateCount()), extra_(geometry_.rateCount()) {
    for (HandSprings& hand : springs) hands_.push_back({std::move(hand), {}, {}, 1, 0});
    for (auto* room : {&next_, &k1_, &k2_, &k3_, &k4_}) room->resize(now_.size());
    const auto count = static_cast<std::size_t>(model_.count());
    for (auto* room : {&r_, &v_, &force_, &before_}) room->resize(count);
    points_.resize(hands_.size());
    startForce_.resize(hands_.size() * count);
  }

  int massCount() const noexcept override { return model_.count(); }
  int handCount() const noexcept override { return static_cast<int>(hands_.size()); }
  int placeCount() const noexcept override { return geometry_.placeCount(); }
  int rateCount() const noexcept override { return geometry_.rateCount(); }
  std::span<const double> places() const noexcept override { return placesOf(now_); }
  std::span<const double> rates() const noexcept override { return ratesOf(now_); }

  void place(std::span<const double> q, std::span<const double> qRate) noexcept override {
    geometry_.place(q, qRate, placesOf(now_), ratesOf(now_));
    std::fill(extra_.begin(), extra_.end(), 0.0);
    locate(now_);
    gravityZero_ = gravityEnergy();
    for (Hand& hand : hands_) {
      hand.end = {pointOf(hand), {}, true};
      hand.segment = {};
      hand.segment.position[0] = hand.end.position;
      hand.work = 0;
      hand.grip = 1;
    }
    fraction_ = 1;
  }
  void show(std::span<const double> places, std::span<const double> rates) noexcept override {
    std::ranges::copy(places.first(geometry_.placeCount()), placesOf(now_).begin());
    std::ranges::copy(rates.first(geometry_.rateCount()), ratesOf(now_).begin());
    locate(now_);
  }
  void setExtraForce(const Vec3& force) noexcept override { extraForce_ = force; }
  void setCoupled(bool coupled) noexcept override { coupled_ = coupled; }
  void restart() noexcept override {}

  void setHand(int hand, const HandSegment& segment, const HandSample& end, double grip) noexcept override {
    Hand& held = hands_[hand];
    held.segment = segment;
    held.end = end;
    held.grip = grip;
  }
  void setExtraAcceleration(std::span<const double> acceleration) noexcept override {
    std::copy(acceleration.begin(), acceleration.end(), extra_.begin());
  }

  StepStatus step(const HandSegment& segment, double dt) noexcept override {
    hands_[0].segment = segment;
    hands_[0].end = endOf(segment);
    fraction_ = 1;
    locate(now_);
    rememberForces();

    derive(0, now_, k1_);
    advance(dt / 2, k1_);
    derive(0.5, next_, k2_);
    advance(dt / 2, k2_);
    derive(0.5, next_, k3_);
    advance(dt, k3_);
    derive(1, next_, k4_);
    rhs_ += 4;
    double check = 0;
    for (std::size_t i = 0; i < now_.size(); ++i) {
      next_[i] = now_[i] + dt / 6 * (k1_[i] + 2 * (k2_[i] + k3_[i]) + k4_[i]);
      check += 0.0 * next_[i];
    }
    if (check != 0) return StepStatus::NotFinite;
    geometry_.settle(placesOf(next_));
    if (!geometry_.inside(placesOf(next_))) {
      fraction_ = 0;
      return StepStatus::AtEnd;
    }
    now_.swap(next_);
    countWork();
    return StepStatus::Ok;
  }
  double lastStepFraction() const noexcept override { return fraction_; }

  void observe(const HandSample& hand, std::span<MassState> masses) const noexcept override {
    hands_[0].end = hand;
    locate(now_);
    derive(1, now_, k4_, true);
    geometry_.observe(places(), rates(), ratesOf(k4_), masses);
    for (int i = 0; i < model_.count(); ++i) masses[i].r = r_[i], masses[i].v = v_[i];
  }
  Vec3 couplingForce(const HandSample& hand) const noexcept override {
    hands_[0].end = hand;
    return couplingForceOf(0);
  }
  Vec3 couplingForceOf(int hand) const noexcept override {
    locate(now_);
    const Hand& held = hands_[hand];
    Vec3 total;
    for (int i = 0; i < model_.count(); ++i) total += forceOn(held, i, held.end.position, held.end.velocity);
    return total;
  }
  Vec3 fixedPoint(int hand) const noexcept override {
    locate(now_);
    return pointOf(hands_[hand]);
  }
  double work(int hand) const noexcept override { return hands_[hand].work; }

  double energy(const HandSample& sample) const noexcept override {
    hands_[0].end = sample;
    double energy = objectEnergy() + gravityZero_;
    if (!coupled_) return energy;
    for (const Hand& hand : hands_)
      for (int i = 0; i < model_.count(); ++i) {
        const Vec3 stretch = hand.end.position - pointOn(hand, i);
        energy += 0.5 * hand.grip * hand.springs.stiffness[i] * dot(stretch, stretch);
      }
    return energy;
  }
  double objectEnergy() const noexcept override {
    locate(now_);
    double energy = kinetic() + gravityEnergy() - gravityZero_;
    for (std::size_t i = 0; i < model_.stiffness.size(); ++i) {
      const Vec3 stretch = r_[i + 1] - r_[i];
      energy += 0.5 * model_.stiffness[i] * dot(stretch, stretch);
    }
    return energy;
  }
  double kineticEnergy() const noexcept override {
    locate(now_);
    return kinetic();
  }
  void difference(std::span<const double> target, std::span<double> out) const noexcept override {
    geometry_.difference(places(), target, out);
  }
  double distanceBetween(std::span<const double> a, std::span<const double> b) const noexcept override {
    double squares = 0;
    for (int i = 0; i < model_.count(); ++i) {
      const Vec3 apart = geometry_.placeOf(a, i) - geometry_.placeOf(b, i);
      squares += dot(apart, apart);
    }
    return std::sqrt(squares / model_.count());
  }
  void setAngularVelocity(const Vec3& velocity) noexcept override { geometry_.setAngularVelocity(velocity, ratesOf(now_)); }
  BodyState body() const noexcept override { return geometry_.body(places(), rates()); }
  std::uint64_t rhsEvaluations() const noexcept override { return rhs_; }
  std::string stopReason() const override { return fraction_ < 1 ? "a mass reached the end of the constraint's domain" : std::string(); }

 private:
  auto placesOf(auto& state) const noexcept { return std::span(state).first(geometry_.placeCount()); }
  auto ratesOf(auto& state) const noexcept { return std::span(state).subspan(geometry_.placeCount()); }
  void locate(const std::vector<double>& state) const noexcept { geometry_.locate(placesOf(state), ratesOf(state), r_, v_); }

  /// Where the hand holds mass i, and how fast that place moves; r_, v_ hold the masses.
  Vec3 pointOn(const Hand& hand, int i) const noexcept { return r_[i] + geometry_.arm(hand.springs.fpOffset); }
  Vec3 speedOn(const Hand& hand, int i) const noexcept { return v_[i] + geometry_.armSpeed(hand.springs.fpOffset); }
  Vec3 pointOf(const Hand& hand) const noexcept {
    Vec3 sum;
    double weight = 0;
    for (int i = 0; i < model_.count(); ++i) {
      sum += hand.springs.stiffness[i] * pointOn(hand, i);
      weight += hand.springs.stiffness[i];
    }
    return weight > 0 ? sum / weight : pointOn(hand, 0);
  }
  Vec3 forceOn(const Hand& hand, int i, const Vec3& place, const Vec3& speed) const noexcept {
    const double k = hand.grip * hand.springs.stiffness[i], b = hand.grip * hand.springs.damping[i];
    if (!coupled_ || (k == 0 && b == 0)) return {};
    return k * (place - pointOn(hand, i)) + b * (speed - speedOn(hand, i));
  }

  // Rates of a state at s of the step; `now`: with the hands where they are at its end, as they were told.
  void derive(double s, const std::vector<double>& y, std::vector<double>& dy, bool now = false) const noexcept {
    locate(y);
    for (int i = 0; i < model_.count(); ++i) force_[i] = model_.mass[i] * model_.gravity - model_.viscosity * v_[i];
    force_[0] += extraForce_;
    for (std::size_t i = 0; i < model_.stiffness.size(); ++i) {
      const Vec3 pull = model_.stiffness[i] * (r_[i + 1] - r_[i]) + model_.damping[i] * (v_[i + 1] - v_[i]);
      force_[i] += pull;
      force_[i + 1] -= pull;
    }
    Vec3 moment;  // about a body's centre
    for (const Hand& hand : hands_) {
      const Vec3 place = now ? hand.end.position : valueAt(hand.segment.position, hand.segment.degree, s);
      const Vec3 speed = now ? hand.end.velocity : valueAt(hand.segment.velocity, hand.segment.degree, s);
      for (int i = 0; i < model_.count(); ++i) {
        const Vec3 force = forceOn(hand, i, place, speed);
        force_[i] += force;
        if constexpr (Geometry::kTurns) moment += cross(geometry_.arm(hand.springs.fpOffset), force);
      }
    }
    const auto dRates = ratesOf(dy);
    geometry_.accelerate(model_, ratesOf(y), force_, moment, placesOf(dy), dRates);
    for (std::size_t i = 0; i < extra_.size(); ++i) dRates[i] += extra_[i];
  }
  void advance(double dt, const std::vector<double>& dy) noexcept {
    for (std::size_t i = 0; i < now_.size(); ++i) next_[i] = now_[i] + dt * dy[i];
  }

  // r_, v_ are those before the step.
  void rememberForces() noexcept {
    const auto count = static_cast<std::size_t>(model_.count());
    before_ = r_;
    for (std::size_t h = 0; h < hands_.size(); ++h) {
      const Hand& hand = hands_[h];
      points_[h] = geometry_.arm(hand.springs.fpOffset);
      for (std::size_t i = 0; i < count; ++i)
        startForce_[h * count + i] = forceOn(hand, static_cast<int>(i), hand.segment.position[0], hand.segment.velocity[0]);
    }
  }
  void countWork() noexcept {
    const auto count = static_cast<std::size_t>(model_.count());
    locate(now_);
    for (std::size_t h = 0; h < hands_.size(); ++h) {
      Hand& hand = hands_[h];
      for (std::size_t i = 0; i < count; ++i) {
        const Vec3 moved = r_[i] - before_[i] + (geometry_.arm(hand.springs.fpOffset) - points_[h]);
        hand.work +=
            0.5 * dot(startForce_[h * count + i] + forceOn(hand, static_cast<int>(i), hand.end.position, hand.end.velocity), moved);
      }
    }
  }

  double kinetic() const noexcept {
    double energy = geometry_.turningEnergy(rates());
    for (int i = 0; i < model_.count(); ++i) energy += 0.5 * model_.mass[i] * dot(v_[i], v_[i]);
    return energy;
  }
  double gravityEnergy() const noexcept {
    double energy = 0;
    for (int i = 0; i < model_.count(); ++i) energy -= model_.mass[i] * dot(model_.gravity, r_[i]);
    return energy;
  }

  ObjectModel model_;
  mutable Geometry geometry_;
  std::vector<double> now_;
  bool coupled_ = true;
  Vec3 extraForce_;
  double gravityZero_ = 0;  // [J]
  double fraction_ = 1;
  std::uint64_t rhs_ = 0;
  mutable std::vector<Hand> hands_;  // the last sample of hand 0 is what was asked about last
  // Room, so that a step allocates nothing.
  mutable std::vector<double> next_, k1_, k2_, k3_, k4_, extra_;
  mutable std::vector<Vec3> r_, v_, force_, before_, points_, startForce_;
};

}  // namespace

std::unique_ptr<SharedPlant> makeSharedPlant(const experiment::Experiment& experiment, const constraints::Constraint& constraint) {
  const ObjectModel model = makeObjectModel(experiment);
  std::vector<HandSprings> hands = handSpringsOf(experiment);
  if (constraint.kind == constraints::ConstraintKind::Surface)
    throw RefusedError("several hands hold an object on lines, on curves and in free space, not on surfaces");
  if (constraint.kind == constraints::ConstraintKind::Curve) {
    if (constraint.domain[0].atEnd == constraints::AtEnd::Bounce && !constraint.domain[0].periodic)
      throw RefusedError("several hands need a curve without elastic ends; use one that stops there, or one hand");
    CurveMasses geometry;
    geometry.curve = constraint.curve;
    geometry.domain = constraint.domain[0];
    geometry.owner = constraint.formula;
    if (constraint.straight) geometry.straight = evaluate(constraint.curve, 0.0);
    geometry.points.resize(static_cast<std::size_t>(model.count()));
    return std::make_unique<HeldObject<CurveMasses>>(model, std::move(hands), std::move(geometry));
  }
  if (model.kind == experiment::ObjectKind::Body) {
    const BodySystem system(model, experiment.object);
    return std::make_unique<HeldObject<FreeBody>>(model, std::move(hands), FreeBody{system.inertia, system.inverseInertia, {}});
  }
  FreeMasses geometry;
  geometry.count = model.count();
  return std::make_unique<HeldObject<FreeMasses>>(model, std::move(hands), geometry);
}

}  // namespace reachlab::dynamics
