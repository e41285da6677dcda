#pragma once
#include <array>
#include <vector>

#include "constraints/curve_batch.h"
#include "sim/dynamics/systems/batch_springs.h"
#include "sim/dynamics/systems/curve_places.h"

namespace reachlab::dynamics {

/// The equations of CurveSystem for two and more masses, eight at a time in the lanes of vector registers. `Batches` is the number of
/// registers for the masses, or 0 for as many as they need. Lanes without a mass rest at the start of the first mass.
template <int Batches, bool Tangential>
struct BatchSystem : CurvePlaces<0, Batches * kBatchLanes, Tangential>, SpaceSystem<BatchSprings<Batches>> {
  using Places = CurvePlaces<0, Batches * kBatchLanes, Tangential>;
  using Space = SpaceSystem<BatchSprings<Batches>>;
  using Places::curve, Places::rates, Space::springs, typename Space::Hand;
  static constexpr int kStates = 2 * Batches * kBatchLanes;
  using State = Numbers<kStates>;

  BatchSystem(const ObjectModel& model, const constraints::Constraint& constraint, double typicalSpeed)
      : Places(model, constraint, typicalSpeed, batchesFor(model.count()) * kBatchLanes), Space(model) {}

  void rate(const Hand& hand, const State& y, State& dy) const noexcept {
    constraints::Unfilled<std::array<constraints::CurveBatch, kMaxBatches<Batches>>> points;
    constraints::Unfilled<std::array<BatchMotion, kMaxBatches<Batches>>> motions;
    for (int o = 0; o < springs.batches(); ++o) {
      constraints::CurveBatch& p = points.value[o];
      curve.batch(curve.program, curve.shape.data(), &y[o * kBatchLanes], p);
      BatchMotion& m = motions.value[o];
      const LaneBatch tx = load(p.rPhi[0]), ty = load(p.rPhi[1]), tz = load(p.rPhi[2]), square = mulAdd(tx, tx, mulAdd(ty, ty, tz * tz));
      if constexpr (Tangential) m.measure = 1.0 / atLeast(squareRoot(square), 1e-290);  // on a cusp T is undefined and unused
      else m.measure = 1.0 / square;
      const LaneBatch w = load(&y[rates() + o * kBatchLanes]), speed = Tangential ? w * m.measure : w;
      m.r[0] = load(p.r[0]), m.r[1] = load(p.r[1]), m.r[2] = load(p.r[2]);
      m.v[0] = speed * tx, m.v[1] = speed * ty, m.v[2] = speed * tz;
    }
    std::array<LaneBatch, 3> tension{};
    for (int o = 0; o < springs.batches(); ++o) {
      const constraints::CurveBatch& p = points.value[o];
      const BatchMotion& m = motions.value[o];
      const LaneBatch w = load(&y[rates() + o * kBatchLanes]);
      LaneBatch drive{}, bend{};
      for (int k = 0; k < 3; ++k) {
        const LaneBatch t = load(p.rPhi[k]);
        drive = mulAdd(t, springs.acceleration(hand, motions.value.data(), o, k, tension[k]), drive);
        if constexpr (!Tangential) bend = mulAdd(t, load(p.rPhiPhi[k]), bend);
      }
      const LaneBatch drag = springs.row[o].drag * w;
      LaneBatch slope;
      if constexpr (Tangential) {
        store(w * m.measure, dy, o * kBatchLanes);
        slope = mulAdd(m.measure, drive, -drag);
      } else {
        store(w, dy, o * kBatchLanes);
        slope = mulAdd(m.measure, mulAdd(-bend, w * w, drive), -drag);
      }
      store(choose(springs.row[o].used, slope, LaneBatch{}), dy, rates() + o * kBatchLanes);
    }
  }

 private:
  static LaneBatch load(const double* from) noexcept { return loadLanes<LaneBatch>(from); }
  static void store(const LaneBatch& x, State& to, int first) noexcept { storeLanes(x, &to[first]); }
};

}  // namespace reachlab::dynamics
