#include "gui/scene/model_actors.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <cmath>

#include "gui/scene/scene_actors.h"

namespace reachlab::gui::scene {
namespace {

using Actor = vtkSmartPointer<vtkActor>;

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
  actor->PickableOff();
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

struct ModelActors::Impl {
  vtkRenderer& renderer;
  std::vector<Vec3> shift;
  bool handShown;
  std::vector<Actor> all, hand;
  std::vector<std::vector<Actor>> masses;
};

ModelActors::ModelActors(vtkRenderer& renderer, const ScenePlan& plan)
    : impl_(new Impl{renderer, plan.massShift, plan.handShown, {}, {}, {}}) {
  Impl& d = *impl_;
  d.masses.resize(plan.massRadius.size());
  if (!plan.model) return;
  for (const model::ModelPart& part : plan.model->parts) {
    std::vector<Actor>* where = nullptr;
    if (part.name == "hand") where = &d.hand;
    for (std::size_t i = 0; i < d.masses.size(); ++i)
      if (part.name == "mass" + std::to_string(i + 1)) where = &d.masses[i];
    if (where == nullptr && !part.name.empty()) continue;  // a mass that there is not, or that is not shown
    Actor actor = actorOf(part);
    renderer.AddActor(actor);
    d.all.push_back(actor);
    if (where != nullptr) where->push_back(actor);
    if (where == &d.hand) actor->SetVisibility(d.handShown);
  }
}

ModelActors::~ModelActors() {
  for (const Actor& actor : impl_->all) impl_->renderer.RemoveActor(actor);
}

bool ModelActors::hasHand() const { return !impl_->hand.empty(); }
bool ModelActors::hasMass(std::size_t mass) const { return mass < impl_->masses.size() && !impl_->masses[mass].empty(); }

void ModelActors::show(const SceneFrame& frame) {
  const auto place = [](const std::vector<Actor>& actors, const Vec3& at) {
    if (!isFinite(at)) return;
    for (const Actor& actor : actors) actor->SetPosition(at.x, at.y, at.z);
  };
  place(impl_->hand, ownHand(frame));
  if (!impl_->masses.empty())
    for (const Actor& actor : impl_->masses.front()) actor->SetVisibility(frame.cursorShown);
  for (std::size_t i = 0; i < std::min(frame.masses.size(), impl_->masses.size()); ++i)
    place(impl_->masses[i], frame.masses[i] + impl_->shift[i]);
}

}  // namespace reachlab::gui::scene
