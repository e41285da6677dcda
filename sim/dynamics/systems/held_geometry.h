#pragma once
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "constraints/constraint.h"
#include "sim/dynamics/systems/body_system.h"

/// The geometry of an object that several hands hold (shared_plant.h). It maps coordinates and their rates to r and v of each mass, and the
/// forces on the masses to accelerations of the rates.
namespace reachlab::dynamics {

/// The common part of all objects that do not turn.
struct Unturned {
  static constexpr bool kTurns = false;
  static Vec3 arm(const Vec3&) noexcept { return {}; }
  static Vec3 armSpeed(const Vec3&) noexcept { return {}; }
  static double turningEnergy(std::span<const double>) noexcept { return 0; }
  static void setAngularVelocity(const Vec3&, std::span<double>) noexcept {}
  static BodyState body(std::span<const double>, std::span<const double>) noexcept { return {}; }
  static void settle(std::span<double>) noexcept {}
  static void difference(std::span<const double> from, std::span<const double> to, std::span<double> out) noexcept {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = to[i] - from[i];
  }
};

struct FreeMasses : Unturned {
  int count;
  int placeCount() const { return 3 * count; }
  int rateCount() const { return 3 * count; }
  void place(std::span<const double> q, std::span<const double> qRate, std::span<double> places, std::span<double> rates) noexcept {
    for (int i = 0; i < count; ++i) put3(places, i, {q[0], q[1], q[2]}), put3(rates, i, {qRate[0], qRate[1], qRate[2]});
  }
  void locate(std::span<const double> places, std::span<const double> rates, std::vector<Vec3>& r, std::vector<Vec3>& v) noexcept {
    for (int i = 0; i < count; ++i) r[i] = at3(places, i), v[i] = at3(rates, i);
  }
  void accelerate(const ObjectModel& model, std::span<const double> rates, const std::vector<Vec3>& force, const Vec3&,
                  std::span<double> dPlaces, std::span<double> dRates) noexcept {
    for (int i = 0; i < count; ++i) put3(dPlaces, i, at3(rates, i)), put3(dRates, i, force[i] / model.mass[i]);
  }
  void observe(std::span<const double>, std::span<const double>, std::span<const double> dRates, std::span<MassState> masses) noexcept {
    for (int i = 0; i < count; ++i) masses[i].a = at3(dRates, i);
  }
  static bool inside(std::span<const double>) noexcept { return true; }
  static Vec3 placeOf(std::span<const double> places, int i) noexcept { return at3(places, i); }
};

/// Masses on a curve: m |r_phi|^2 phi'' + m (r_phi . r_phiphi) phi'^2 = r_phi . F.
struct CurveMasses : Unturned {
  constraints::Curve curve;
  constraints::Domain domain;
  std::shared_ptr<const void> owner;
  std::optional<constraints::CurvePoint> straight;  // at phi = 0, where r_phi is the same everywhere
  std::vector<constraints::CurvePoint> points;

  constraints::CurvePoint pointAt(double phi) const noexcept {
    return straight ? constraints::CurvePoint{straight->r + phi * straight->rPhi, straight->rPhi, {}} : evaluate(curve, phi);
  }
  int placeCount() const { return static_cast<int>(points.size()); }
  int rateCount() const { return placeCount(); }
  void place(std::span<const double> q, std::span<const double> qRate, std::span<double> places, std::span<double> rates) noexcept {
    std::fill(places.begin(), places.end(), q[0]);
    std::fill(rates.begin(), rates.end(), qRate[0]);
  }
  void locate(std::span<const double> places, std::span<const double> rates, std::vector<Vec3>& r, std::vector<Vec3>& v) noexcept {
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] = pointAt(places[i]);
      r[i] = points[i].r;
      v[i] = rates[i] * points[i].rPhi;
    }
  }
  void accelerate(const ObjectModel& model, std::span<const double> rates, const std::vector<Vec3>& force, const Vec3&,
                  std::span<double> dPlaces, std::span<double> dRates) noexcept {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const constraints::CurvePoint& p = points[i];
      dPlaces[i] = rates[i];
      dRates[i] = (dot(p.rPhi, force[i]) / model.mass[i] - dot(p.rPhi, p.rPhiPhi) * rates[i] * rates[i]) / dot(p.rPhi, p.rPhi);
    }
  }
  void observe(std::span<const double> places, std::span<const double> rates, std::span<const double> dRates,
               std::span<MassState> masses) noexcept {
    for (std::size_t i = 0; i < points.size(); ++i) {
      masses[i].q = {places[i], 0};
      masses[i].qRate = {rates[i], 0};
      masses[i].a = dRates[i] * points[i].rPhi + (rates[i] * rates[i]) * points[i].rPhiPhi;
    }
  }
  Vec3 placeOf(std::span<const double> places, int i) const noexcept { return pointAt(places[i]).r; }
  bool inside(std::span<const double> places) const noexcept {
    if (domain.periodic) return true;
    return std::all_of(places.begin(), places.end(), [&](double phi) { return phi >= domain.lo && phi <= domain.hi; });
  }
};

/// A rigid body with the equations of BodySystem and several hands. The places are r and the quaternion. The rates are v and the angular
/// velocity in body axes.
struct FreeBody {
  static constexpr bool kTurns = true;
  experiment::SquareMatrix<3> inertia{}, inverseInertia{};
  BodySystem::Pose pose{};  // of the latest `locate`

  static BodySystem::Pose poseOf(std::span<const double> s, std::span<const double> rates) noexcept {
    return {at3(s, 0), at3(rates, 0), at3(rates, 1), s[3], s[4], s[5], s[6]};
  }

  static int placeCount() { return 7; }
  static int rateCount() { return 6; }
  void place(std::span<const double> q, std::span<const double> qRate, std::span<double> places, std::span<double> rates) noexcept {
    std::ranges::copy(std::array{q[0], q[1], q[2], 1.0, 0.0, 0.0, 0.0}, places.begin());
    std::ranges::copy(std::array{qRate[0], qRate[1], qRate[2], 0.0, 0.0, 0.0}, rates.begin());
  }
  void locate(std::span<const double> s, std::span<const double> rates, std::vector<Vec3>& r, std::vector<Vec3>& v) noexcept {
    pose = poseOf(s, rates);
    r[0] = pose.r;
    v[0] = pose.v;
  }
  Vec3 arm(const Vec3& offset) const noexcept { return pose.toWorld(offset); }
  Vec3 armSpeed(const Vec3& offset) const noexcept { return cross(pose.toWorld(pose.turn), pose.toWorld(offset)); }
  void accelerate(const ObjectModel& model, std::span<const double>, const std::vector<Vec3>& force, const Vec3& moment,
                  std::span<double> dPlaces, std::span<double> dRates) noexcept {
    const Vec3& o = pose.turn;
    const Vec3 spin = experiment::times(inverseInertia, pose.toBody(moment) - cross(o, experiment::times(inertia, o)));
    put3(dPlaces, 0, pose.v);
    std::ranges::copy(pose.turning(), dPlaces.begin() + 3);
    put3(dRates, 0, force[0] / model.mass[0]);
    put3(dRates, 1, spin);
  }
  void observe(std::span<const double>, std::span<const double>, std::span<const double> dRates, std::span<MassState> masses) noexcept {
    masses[0].a = at3(dRates, 0);
  }
  static bool inside(std::span<const double>) noexcept { return true; }
  static Vec3 placeOf(std::span<const double> places, int) noexcept { return at3(places, 0); }
  double turningEnergy(std::span<const double> rates) const noexcept {
    const Vec3 turn = at3(rates, 1);
    return 0.5 * dot(turn, experiment::times(inertia, turn));
  }
  void setAngularVelocity(const Vec3& velocity, std::span<double> rates) const noexcept { put3(rates, 1, pose.toBody(velocity)); }
  static BodyState body(std::span<const double> s, std::span<const double> rates) noexcept { return poseOf(s, rates).state(); }
  static void settle(std::span<double> s) noexcept { BodySystem::normalise(s, 3); }
  // The rotation between two near orientations: twice the vector part of q* q', in the axes of q.
  static void difference(std::span<const double> a, std::span<const double> b, std::span<double> out) noexcept {
    for (std::size_t i = 0; i < 3; ++i) out[i] = b[i] - a[i];
    const double w = a[3], x = -a[4], y = -a[5], z = -a[6];
    const double turned = w * b[3] - x * b[4] - y * b[5] - z * b[6];
    const double sign = turned < 0 ? -2.0 : 2.0;
    out[3] = sign * (w * b[4] + x * b[3] + y * b[6] - z * b[5]);
    out[4] = sign * (w * b[5] - x * b[6] + y * b[3] + z * b[4]);
    out[5] = sign * (w * b[6] + x * b[5] - y * b[4] + z * b[3]);
  }
};

}  // namespace reachlab::dynamics
