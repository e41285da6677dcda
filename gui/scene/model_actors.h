#pragma once
#include <vector>

#include "gui/scene/scene_actors.h"
#include "gui/scene_plan/scene_plan.h"

namespace reachlab::gui::scene {

/// The plan's model as actors: fixed scenery, and the shapes of the hand and of masses. Window's thread.
class ModelActors {
 public:
  ModelActors(vtkRenderer& renderer, const ScenePlan& plan);

  /// Whether the model has a shape for the hand, or for that mass (from 0). The usual shape is then not drawn.
  bool hasHand() const { return !hand_.empty(); }
  bool hasMass(std::size_t mass) const { return mass < masses_.size() && !masses_[mass].empty(); }
  void show(const SceneFrame& frame);

 private:
  ActorGroup actors_;
  std::vector<Vec3> shift_;
  std::vector<Actor> hand_;
  std::vector<std::vector<Actor>> masses_;
};

}  // namespace reachlab::gui::scene
