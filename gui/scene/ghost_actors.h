#pragma once
#include <vector>

#include "gui/scene/scene_actors.h"
#include "gui/scene_plan/scene_plan.h"

namespace reachlab::gui::scene {

/// Other trials at the same moment: their masses and hands as faint balls. Actors are kept for the largest number shown so far, and `show`
/// moves them. Window's thread.
class GhostActors {
 public:
  GhostActors(vtkRenderer& renderer, const ScenePlan& plan);
  void show(const std::vector<SceneFrame>& ghosts);

 private:
  void addGhost();
  ActorGroup actors_;
  std::vector<double> radius_;  // of each mass, then of the hand
  std::vector<Vec3> shift_;
  PartColours colours_;
  std::vector<std::vector<Actor>> ghosts_;  // balls of each: its masses, its hand
};

}  // namespace reachlab::gui::scene
