#pragma once
#include <memory>

#include "gui/scene_plan/scene_plan.h"

class vtkRenderer;

namespace reachlab::gui::scene {

/// The plan's model as actors: scenery that stays, and what stands for the hand and for masses. Window's thread.
class ModelActors {
 public:
  ModelActors(vtkRenderer& renderer, const ScenePlan& plan);
  ~ModelActors();
  ModelActors(const ModelActors&) = delete;
  ModelActors& operator=(const ModelActors&) = delete;

  /// The model has a shape of its own for the hand, or for that mass (from 0): the usual one is not drawn.
  bool hasHand() const;
  bool hasMass(std::size_t mass) const;
  void show(const SceneFrame& frame);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace reachlab::gui::scene
