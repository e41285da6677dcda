#pragma once
#include <array>
#include <vector>

#include "gui/scene/scene_actors.h"
#include "gui/scene_plan/scene_plan.h"

namespace reachlab::gui::scene {

/// Cues of depth, path and force: grid and shadows below the scene, the hand's trace, and the arrow of the coupling's force. The plan's
/// look switches each cue. Window's thread.
class CueActors {
 public:
  static constexpr double kReachPerNewton = 0.05;  // the arrow's length, of the reach
  static constexpr int kTracePoints = 4096;        // a longer way loses its beginning

  /// `plan` outlives this.
  CueActors(vtkRenderer& renderer, const ScenePlan& plan);
  void show(const SceneFrame& frame);
  /// Points of the trace. For tests.
  int tracePointCount() const { return static_cast<int>(traced_.size()); }

 private:
  struct Ring {
    double distance, opacity;
  };
  void addGrid();
  Actor addSoft(vtkPolyData* data, const widgets::Colour& colour, const std::vector<double>& opacity);
  Actor addDisc(const widgets::Colour& colour, const std::array<Ring, 4>& rings);
  void addShadow(double size);
  void showTrace(const SceneFrame& frame);
  void showArrow(const SceneFrame& frame);

  ActorGroup actors_;
  const ScenePlan& plan_;       // without its hand's pen the cues are those of the first mass
  std::vector<Actor> shadows_;  // of the masses, and last the hand's
  Actor arrow_;
  std::vector<Vec3> traced_;
  vtkSmartPointer<vtkPolyData> trace_ = linesOf({});
  std::int32_t tracedTrial_ = 0;
};

}  // namespace reachlab::gui::scene
