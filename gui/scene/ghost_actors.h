#pragma once
#include <memory>
#include <vector>

#include "gui/scene_plan/scene_plan.h"

class vtkRenderer;

namespace reachlab::gui::scene {

/// Other trials at the same moment: their masses and hands as faint balls. Actors are kept for the largest number shown so far, and `show`
/// moves them. Window's thread.
class GhostActors {
 public:
  GhostActors(vtkRenderer& renderer, const ScenePlan& plan);
  ~GhostActors();  // takes the actors out again
  GhostActors(const GhostActors&) = delete;
  GhostActors& operator=(const GhostActors&) = delete;

  void show(const std::vector<SceneFrame>& ghosts);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace reachlab::gui::scene
