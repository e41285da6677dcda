#pragma once
#include <memory>

#include "gui/scene_plan/scene_plan.h"

class vtkRenderer;

namespace reachlab::gui::scene {

/// Cues of depth, path and force: grid and shadows below the scene, the hand's trace, and the arrow of the coupling's force. The plan's
/// look switches each cue. Window's thread.
class CueActors {
 public:
  static constexpr double kReachPerNewton = 0.05;  // the arrow's length, of the reach
  static constexpr int kTracePoints = 4096;        // a longer way loses its beginning

  CueActors(vtkRenderer& renderer, const ScenePlan& plan);
  ~CueActors();
  CueActors(const CueActors&) = delete;
  CueActors& operator=(const CueActors&) = delete;

  void show(const SceneFrame& frame);
  /// Points of the trace. For tests.
  int tracePointCount() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace reachlab::gui::scene
