#pragma once
#include <vtkSmartPointer.h>

#include <vector>

#include "base/math/vec3.h"
#include "gui/model/model.h"
#include "gui/scene_plan/constraint_mesh.h"
#include "gui/scene_plan/force_marks.h"
#include "gui/widgets/colours.h"

class vtkActor;
class vtkPolyData;
class vtkRenderer;

/// Builders of the scene's actors. The caller adds them to a renderer and keeps or drops them. Window's thread.
namespace reachlab::gui::scene {

using Actor = vtkSmartPointer<vtkActor>;

/// Actors in a renderer, which are taken out again with this.
class ActorGroup {
 public:
  explicit ActorGroup(vtkRenderer& renderer);
  ~ActorGroup();
  ActorGroup(const ActorGroup&) = delete;
  ActorGroup& operator=(const ActorGroup&) = delete;
  Actor add(const Actor& actor);

 private:
  vtkSmartPointer<vtkRenderer> renderer_;
  std::vector<Actor> actors_;
};

/// Moves the actor, unless the position [m] is not finite.
void place(vtkActor& actor, const Vec3& at);

struct Look {
  widgets::Colour colour;
  double opacity = 1;
  double shine = 0.35;
  bool metal = false;  // darker between sharper lights
};

/// Ball of radius 1 at the origin: to be scaled and moved.
Actor makeBall(const Look& look);
/// Box of edge 1 with a marked side, so that turning is seen.
Actor makeBox(const Look& look);
/// Makes a translucent actor denser at its edges, as glass is.
void makeShell(vtkActor& actor);
/// A spring of round wire with a hook at either end. `stretch` gives it its shape.
Actor makeCoil(const Look& look, int turns);
/// A pen with its tip at the origin and its shaft up and towards the viewer. The tip's ball has radius 1.
Actor makePen(const Look& look);
/// Where the shaft of a pen of tip radius `radius` [m] ends whose tip is at `hand`. [m]
Vec3 penEnd(const Vec3& hand, double radius);
/// Tubes along the pieces. [m]
Actor makeRail(const CurveMesh& mesh, double radius, const Look& look);
/// The skin alone, lit from both sides.
Actor makeSkin(const SurfaceMesh& mesh, const Look& look);
/// The points and faces of makeSkin, without normals.
vtkSmartPointer<vtkPolyData> quadsOf(const SurfaceMesh& mesh);
/// A part of a model.
Actor makeTriangles(const model::ModelPart& part);
/// Each piece is a line of that width [pixels].
Actor makeLines(const std::vector<std::vector<Vec3>>& pieces, const Look& look, double width);
/// The points and lines of makeLines.
vtkSmartPointer<vtkPolyData> linesOf(const std::vector<std::vector<Vec3>>& pieces);

/// Small balls, all one actor. [m]
Actor makeDots(const std::vector<Vec3>& places, double radius, const Look& look);

/// Arrows from their places, all one actor. `longest` [m]: the length of the largest force.
Actor makeArrows(const std::vector<ForceArrow>& arrows, double longest, const Look& look);

/// Lays a coil between two points. The wire keeps its thickness, whatever the length of the coil. [m]
void stretch(vtkActor& coil, const Vec3& from, const Vec3& to, double radius, double wire);

}  // namespace reachlab::gui::scene
