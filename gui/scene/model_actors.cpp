#include "gui/scene/model_actors.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>

#include <algorithm>
#include <string>

namespace reachlab::gui::scene {
namespace {

constexpr double kEdge = 35;  // [degrees] between two triangles that is an edge, not a bend

// Corners beyond the points and numbers that are not finite were refused when the file was read (model::check).
Actor actorOf(const model::ModelPart& part) {
  vtkNew<vtkPoints> points;
  for (const Vec3& p : part.points) points->InsertNextPoint(p.x, p.y, p.z);
  vtkNew<vtkCellArray> triangles;
  for (const auto& triangle : part.triangles) {
    triangles->InsertNextCell(3);
    for (const std::uint32_t corner : triangle) triangles->InsertCellPoint(static_cast<vtkIdType>(corner));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(triangles);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(data);
  normals->SetFeatureAngle(kEdge);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  mapper->ScalarVisibilityOff();
  const Actor actor = Actor::New();
  actor->SetMapper(mapper);
  vtkProperty* p = actor->GetProperty();
  p->SetColor(part.colour[0], part.colour[1], part.colour[2]);
  p->SetOpacity(part.opacity);
  p->SetAmbient(0.15);
  p->SetDiffuse(0.85);
  p->SetSpecular(0.2);
  p->SetSpecularPower(20);
  return actor;
}

}  // namespace

ModelActors::ModelActors(vtkRenderer& renderer, const ScenePlan& plan)
    : actors_(renderer), shift_(plan.massShift), masses_(plan.massRadius.size()) {
  if (!plan.model) return;
  for (const model::ModelPart& part : plan.model->parts) {
    std::vector<Actor>* where = part.name == "hand" ? &hand_ : nullptr;
    for (std::size_t i = 0; i < masses_.size(); ++i)
      if (part.name == "mass" + std::to_string(i + 1)) where = &masses_[i];
    if (where == nullptr && !part.name.empty()) continue;  // a mass that there is not, or that is not shown
    const Actor actor = actors_.add(actorOf(part));
    if (where != nullptr) where->push_back(actor);
    if (where == &hand_) actor->SetVisibility(plan.handShown);
  }
}

void ModelActors::show(const SceneFrame& frame) {
  for (const Actor& actor : hand_) place(*actor, ownHand(frame));
  if (!masses_.empty())
    for (const Actor& actor : masses_.front()) actor->SetVisibility(frame.cursorShown);
  for (std::size_t i = 0; i < std::min(frame.masses.size(), masses_.size()); ++i)
    for (const Actor& actor : masses_[i]) place(*actor, frame.masses[i] + shift_[i]);
}

}  // namespace reachlab::gui::scene
