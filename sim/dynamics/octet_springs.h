#pragma once
#include <array>
#include <cmath>
#include <vector>

#include "base/lanes.h"
#include "sim/dynamics/system.h"

namespace reachlab::dynamics {

using Octet = Lanes<constraints::kOctet>;
using OctetIndex = LaneMarks<constraints::kOctet>;

constexpr int octetsFor(int masses) noexcept { return lanesFor<constraints::kOctet>(masses); }
template <int Octets>
inline constexpr int kMostOctets = Octets > 0 ? Octets : octetsFor(experiment::kMaxMasses);

inline Octet atLeast(const Octet& x, double least) noexcept { return x > least ? x : broadcast<Octet>(least); }
inline Octet squareRoot(const Octet& x) noexcept {
  Octet root;
  for (int lane = 0; lane < constraints::kOctet; ++lane) root[lane] = std::sqrt(x[lane]);
  return root;
}
/// x of the next mass in each lane; of the mass before.
inline Octet next(const Octet& x, const Octet& after) noexcept { return __builtin_shuffle(x, after, OctetIndex{1, 2, 3, 4, 5, 6, 7, 8}); }
inline Octet previous(const Octet& before, const Octet& x) noexcept {
  return __builtin_shuffle(before, x, OctetIndex{7, 8, 9, 10, 11, 12, 13, 14});
}

struct OctetMotion {
  std::array<Octet, 3> r, v;  // [m], [m/s]
  Octet measure;              // see OctetSystem::rate
};

/// Springs and masses in lanes; numbers of lanes without a mass are zero.
template <int Octets, bool Parallel>
struct OctetSprings {
  struct Row {
    Octet inverseMass{}, handStiffness{}, handDamping{};
    Octet stiffness{}, damping{};  // to the next mass
    Octet drag{};                  // viscosity / mass
    Octet first{};                 // 1 where mass 1 is
    OctetIndex used{};
  };
  std::vector<Row> row;
  Vec3 gravity, extraForce;

  explicit OctetSprings(const ObjectModel& model) : row(static_cast<std::size_t>(octetsFor(model.count()))), gravity(model.gravity) {
    row[0].first[0] = 1;
    for (int i = 0; i < model.count(); ++i) {
      Row& own = row[i / constraints::kOctet];
      own.inverseMass[i % constraints::kOctet] = 1 / model.mass[i];
      own.drag[i % constraints::kOctet] = model.viscosity / model.mass[i];
      own.used[i % constraints::kOctet] = -1;
      if (Parallel || i + 1 >= model.count()) continue;
      own.stiffness[i % constraints::kOctet] = model.stiffness[i];
      own.damping[i % constraints::kOctet] = model.damping[i];
    }
    setCoupled(model, true);
  }
  void setCoupled(const ObjectModel& model, bool coupled) noexcept {
    for (int i = 0; i < model.count(); ++i) {
      row[i / constraints::kOctet].handStiffness[i % constraints::kOctet] = coupled ? model.handStiffness[i] : 0;
      row[i / constraints::kOctet].handDamping[i % constraints::kOctet] = coupled ? model.handDamping[i] : 0;
    }
  }
  int octets() const noexcept { return Octets > 0 ? Octets : static_cast<int>(row.size()); }

  /// Force over mass plus gravity, coordinate k of octet o [m/s^2]. `tension` [N]: of the springs of the octet before to their next
  /// masses, and on return of this one's.
  Octet acceleration(const HandSample& hand, const OctetMotion* motions, int o, int k, Octet& tension) const noexcept {
    const Row& s = row[o];
    const Octet x = motions[o].r[k], v = motions[o].v[k];
    Octet force = s.first * component(extraForce, k);
    if (Parallel || o == 0)
      force = mulAdd(s.handStiffness, component(hand.position, k) - x, mulAdd(s.handDamping, component(hand.velocity, k) - v, force));
    if constexpr (!Parallel) {
      const OctetMotion& after = motions[o + 1 < octets() ? o + 1 : o];
      const Octet own = mulAdd(s.stiffness, next(x, after.r[k]) - x, s.damping * (next(v, after.v[k]) - v));
      force += own - previous(tension, own);
      tension = own;
    }
    return mulAdd(s.inverseMass, force, broadcast<Octet>(component(gravity, k)));
  }

 private:
  static double component(const Vec3& v, int k) noexcept { return k == 0 ? v.x : k == 1 ? v.y : v.z; }
};

}  // namespace reachlab::dynamics
