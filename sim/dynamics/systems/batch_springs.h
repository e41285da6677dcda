#pragma once
#include <array>
#include <cmath>
#include <vector>

#include "base/math/lanes.h"
#include "sim/dynamics/systems/system.h"

namespace reachlab::dynamics {

constexpr int batchesFor(int masses) noexcept { return lanesFor<kBatchLanes>(masses); }
template <int Batches>
inline constexpr int kMaxBatches = Batches > 0 ? Batches : batchesFor(experiment::kMaxMasses);

inline LaneBatch atLeast(const LaneBatch& x, double least) noexcept { return choose(x > least, x, broadcast<LaneBatch>(least)); }

struct BatchMotion {
  std::array<LaneBatch, 3> r, v;  // [m], [m/s]
  LaneBatch measure;              // see BatchSystem::rate
};

/// Springs and masses in lanes. The numbers of lanes without a mass are zero.
template <int Batches>
struct BatchSprings {
  struct Row {
    LaneBatch inverseMass{}, handStiffness{}, handDamping{};
    LaneBatch stiffness{}, damping{};  // to the next mass
    LaneBatch drag{};                  // viscosity / mass
    LaneBatch first{};                 // 1 where mass 1 is
    LaneMarks<kBatchLanes> used{};
  };
  std::vector<Row> row;
  bool parallel;  // every mass has a separate spring to the hand and no neighbours
  Vec3 gravity, extraForce;

  explicit BatchSprings(const ObjectModel& model)
      : row(static_cast<std::size_t>(batchesFor(model.count()))), parallel(model.kind == experiment::ObjectKind::Parallel),
        gravity(model.gravity) {
    row[0].first[0] = 1;
    for (int i = 0; i < model.count(); ++i) {
      Row& own = row[i / kBatchLanes];
      own.inverseMass[i % kBatchLanes] = 1 / model.mass[i];
      own.drag[i % kBatchLanes] = model.viscosity / model.mass[i];
      own.used[i % kBatchLanes] = -1;
      if (parallel || i + 1 >= model.count()) continue;
      own.stiffness[i % kBatchLanes] = model.stiffness[i];
      own.damping[i % kBatchLanes] = model.damping[i];
    }
    setCoupled(model, true);
  }
  void setCoupled(const ObjectModel& model, bool coupled) noexcept {
    for (int i = 0; i < model.count(); ++i) {
      row[i / kBatchLanes].handStiffness[i % kBatchLanes] = coupled ? model.handStiffness[i] : 0;
      row[i / kBatchLanes].handDamping[i % kBatchLanes] = coupled ? model.handDamping[i] : 0;
    }
  }
  int batches() const noexcept { return Batches > 0 ? Batches : static_cast<int>(row.size()); }

  /// Force over mass plus gravity, coordinate k of batch o [m/s^2]. `tension` [N] holds the tension of the springs from the masses of the
  /// batch before to their next masses. On return it holds the tension of the springs of this batch.
  LaneBatch acceleration(const HandSample& hand, const BatchMotion* motions, int o, int k, LaneBatch& tension) const noexcept {
    const Row& s = row[o];
    const LaneBatch x = motions[o].r[k], v = motions[o].v[k];
    LaneBatch force = s.first * component(extraForce, k);
    if (o == 0 || parallel)
      force = mulAdd(s.handStiffness, component(hand.position, k) - x, mulAdd(s.handDamping, component(hand.velocity, k) - v, force));
    if (!parallel) {
      const BatchMotion& after = motions[o + 1 < batches() ? o + 1 : o];
      const LaneBatch own = mulAdd(s.stiffness, next(x, after.r[k]) - x, s.damping * (next(v, after.v[k]) - v));
      force += own - previous(tension, own);
      tension = own;
    }
    return mulAdd(s.inverseMass, force, broadcast<LaneBatch>(component(gravity, k)));
  }

 private:
  static double component(const Vec3& v, int k) noexcept { return k == 0 ? v.x : k == 1 ? v.y : v.z; }
};

}  // namespace reachlab::dynamics
