#pragma once
#include <memory>

#include "gui/scene_plan/scene_plan.h"

class vtkRenderer;

namespace reachlab::gui::scene {

/// The plan's model as actors: fixed scenery, and the shapes of the hand and of masses. Window's thread.
class ModelActors {
 public:
  ModelActors(vtkRenderer& renderer, const ScenePlan& plan);
  ~ModelActors();
  ModelActors(const ModelActors&) = delete;
  ModelActors& operator=(const ModelActors&) = delete;

  /// Whether the model has a shape for the hand, or for that mass (from 0). The usual shape is then not drawn.
  bool hasHand() const;
  bool hasMass(std::size_t mass) const;
  void show(const SceneFrame& frame);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace reachlab::gui::scene
