#pragma once
#include <memory>

#include "gui/scene_plan/scene_plan.h"

class vtkRenderer;

namespace reachlab::gui::scene {

enum class SurfaceStyle { Glass, Wire };

/// The actors of one plan in one renderer. They are built once, and `show` only moves them. Window's thread.
class ObjectActors {
 public:
  ObjectActors(vtkRenderer& renderer, const ScenePlan& plan, SurfaceStyle style);
  ~ObjectActors();  // takes the actors out again
  ObjectActors(const ObjectActors&) = delete;
  ObjectActors& operator=(const ObjectActors&) = delete;

  void show(const SceneFrame& frame);
  /// Moves the marks of start and target.
  void movePlaces(const Vec3& start, const Vec3& target);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace reachlab::gui::scene
