#pragma once
#include <optional>
#include <vector>

#include "gui/scene/cue_actors.h"
#include "gui/scene/scene_actors.h"
#include "gui/scene_plan/scene_plan.h"

namespace reachlab::gui::scene {

enum class SurfaceStyle { Glass, Wire };

/// The actors of one plan in one renderer. They are built once, and `show` only moves them. Window's thread.
class ObjectActors {
 public:
  ObjectActors(vtkRenderer& renderer, const ScenePlan& plan, SurfaceStyle style);

  void show(const SceneFrame& frame);
  /// Shows other trials at the same moment: their masses and hands as faint balls, which are kept for the largest number shown so far.
  /// Returns whether there are any balls.
  bool showGhosts(const std::vector<SceneFrame>& ghosts);
  /// Moves the marks of start and target.
  void movePlaces(const Vec3& start, const Vec3& target);

 private:
  Actor addBall(const Look& look, double radius);
  void addModel();
  void addConstraint(SurfaceStyle style);
  void addPlaces();
  void addMarks();
  void addMark(bool atTarget, const Vec3& shift, double radius, double opacity);
  void addForces();
  void addObject();
  void showMasses(const SceneFrame& frame);
  void showHands(const SceneFrame& frame);
  void showSprings(const SceneFrame& frame);

  struct Mark {
    Actor actor;
    bool atTarget;
    Vec3 shift;  // [m] beside it
  };
  ScenePlan plan_;
  ActorGroup actors_;
  // Shapes of the model. Where there is one for the hand or for a mass, the usual shape is not drawn.
  std::vector<Actor> handModel_;
  std::vector<std::vector<Actor>> massModels_;
  std::optional<CueActors> cues_;
  std::vector<Actor> masses_, springs_, hands_, via_;
  std::vector<std::vector<Actor>> ghosts_;  // balls of each: its masses, its hand
  std::vector<Mark> marks_;
  bool handWasValid_ = true;
};

}  // namespace reachlab::gui::scene
