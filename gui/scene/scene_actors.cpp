#include "gui/scene/scene_actors.h"

#include <vtkActor.h>
#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkCubeSource.h>
#include <vtkCylinderSource.h>
#include <vtkConeSource.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3D.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>
#include <vtkTubeFilter.h>

#include <cmath>
#include <numbers>

namespace reachlab::gui::scene {
namespace {

constexpr double kPenLength = 16;               // in radii of its tip
constexpr double kPenTilt = 32, kPenTurn = 24;  // [deg] towards the viewer, to the right

vtkSmartPointer<vtkActor> actorOf(vtkAlgorithmOutput* geometry, const Look& look) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(geometry);
  mapper->ScalarVisibilityOff();
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty* p = actor->GetProperty();
  p->SetColor(look.colour.red, look.colour.green, look.colour.blue);
  p->SetOpacity(look.opacity);
  p->SetAmbient(0.12);
  p->SetDiffuse(0.88);
  p->SetSpecular(look.shine);
  p->SetSpecularPower(28);
  p->SetInterpolationToPhong();
  return actor;
}

vtkSmartPointer<vtkPolyData> linesOf(const std::vector<std::vector<Vec3>>& pieces) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  for (const auto& piece : pieces) {
    lines->InsertNextCell(static_cast<int>(piece.size()));
    for (const Vec3& p : piece) lines->InsertCellPoint(points->InsertNextPoint(p.x, p.y, p.z));
  }
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(lines);
  return data;
}

}  // namespace

vtkSmartPointer<vtkActor> makeBall(const Look& look) {
  vtkNew<vtkSphereSource> source;
  source->SetRadius(1);
  source->SetThetaResolution(40);
  source->SetPhiResolution(28);
  return actorOf(source->GetOutputPort(), look);
}

vtkSmartPointer<vtkActor> makeBox(const Look& look) {
  vtkNew<vtkCubeSource> cube, mark;
  mark->SetXLength(0.12);
  mark->SetYLength(0.5);
  mark->SetZLength(0.5);
  mark->SetCenter(0.5, 0, 0);
  vtkNew<vtkAppendPolyData> both;
  both->AddInputConnection(cube->GetOutputPort());
  both->AddInputConnection(mark->GetOutputPort());
  auto actor = actorOf(both->GetOutputPort(), look);
  actor->GetProperty()->SetInterpolationToFlat();
  return actor;
}

vtkSmartPointer<vtkActor> makeCoil(const Look& look, int turns, double wire) {
  CurveMesh mesh;
  mesh.pieces.emplace_back();
  const int perTurn = 20, samples = turns * perTurn;
  const double lead = 0.08;  // straight share at either end
  mesh.pieces[0].push_back({0, 0, 0});
  for (int i = 0; i <= samples; ++i) {
    const double s = static_cast<double>(i) / samples, angle = 2 * std::numbers::pi * turns * s;
    const double radius = std::min({1.0, s * 3 * turns, (1 - s) * 3 * turns});
    mesh.pieces[0].push_back({lead + (1 - 2 * lead) * s, radius * std::cos(angle), radius * std::sin(angle)});
  }
  mesh.pieces[0].push_back({1, 0, 0});
  // The wire is round once the coil is stretched to about eight times its radius.
  for (Vec3& p : mesh.pieces[0]) p.x *= 8;
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputData(linesOf(mesh.pieces));
  tube->SetRadius(wire);
  tube->SetNumberOfSides(8);
  tube->CappingOn();
  return actorOf(tube->GetOutputPort(), look);
}

Vec3 penEnd(const Vec3& hand, double radius) {
  const double tilt = kPenTilt * std::numbers::pi / 180, turn = kPenTurn * std::numbers::pi / 180;
  return hand + kPenLength * radius * Vec3{std::cos(tilt) * std::sin(turn), std::cos(tilt) * std::cos(turn), std::sin(tilt)};
}

vtkSmartPointer<vtkActor> makePen(const Look& look) {
  vtkNew<vtkSphereSource> tip;
  tip->SetRadius(1);
  tip->SetThetaResolution(24);
  tip->SetPhiResolution(18);
  vtkNew<vtkConeSource> cone;
  cone->SetResolution(24);
  cone->SetHeight(5);
  cone->SetRadius(0.85);
  cone->SetDirection(0, -1, 0);
  cone->SetCenter(0, 2.5, 0);
  vtkNew<vtkCylinderSource> shaft;
  shaft->SetResolution(24);
  shaft->SetRadius(0.85);
  shaft->SetHeight(kPenLength - 5);
  shaft->SetCenter(0, (kPenLength + 5) / 2, 0);
  vtkNew<vtkAppendPolyData> all;
  all->AddInputConnection(tip->GetOutputPort());
  all->AddInputConnection(cone->GetOutputPort());
  all->AddInputConnection(shaft->GetOutputPort());
  auto actor = actorOf(all->GetOutputPort(), look);
  actor->SetOrientation(kPenTilt, 0, -kPenTurn);
  return actor;
}

vtkSmartPointer<vtkActor> makeRail(const CurveMesh& mesh, double radius, const Look& look) {
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputData(linesOf(mesh.pieces));
  tube->SetRadius(radius);
  tube->SetNumberOfSides(14);
  tube->CappingOn();
  return actorOf(tube->GetOutputPort(), look);
}

vtkSmartPointer<vtkActor> makeSkin(const SurfaceMesh& mesh, const Look& look) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vec3 &p = mesh.points[i], &n = mesh.normals[i];
    points->InsertNextPoint(p.x, p.y, p.z);
    normals->InsertNextTuple3(n.x, n.y, n.z);
  }
  vtkNew<vtkCellArray> quads;
  for (const auto& quad : mesh.quads) {
    quads->InsertNextCell(4);
    for (const std::uint32_t corner : quad) quads->InsertCellPoint(static_cast<vtkIdType>(corner));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(quads);
  data->GetPointData()->SetNormals(normals);
  vtkNew<vtkPolyDataMapper> mapper;
  auto actor = actorOf(nullptr, look);
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
  actor->SetMapper(mapper);
  return actor;
}

vtkSmartPointer<vtkActor> makeParameterLines(const SurfaceMesh& mesh, const Look& look, double width) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(linesOf(mesh.parameterLines));
  auto actor = actorOf(nullptr, look);
  actor->SetMapper(mapper);
  actor->GetProperty()->SetLighting(false);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  return actor;
}

vtkSmartPointer<vtkActor> makeDots(const std::vector<Vec3>& places, double radius, const Look& look) {
  vtkNew<vtkPoints> points;
  for (const Vec3& p : places) points->InsertNextPoint(p.x, p.y, p.z);
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(radius);
  ball->SetThetaResolution(12);
  ball->SetPhiResolution(9);
  vtkNew<vtkGlyph3D> dots;
  dots->SetInputData(data);
  dots->SetSourceConnection(ball->GetOutputPort());
  dots->ScalingOff();
  return actorOf(dots->GetOutputPort(), look);
}

void stretch(vtkActor& coil, const Vec3& from, const Vec3& to, double radius) {
  Vec3 x = to - from;
  const double length = norm(x);
  coil.SetVisibility(length > 0.2 * radius);
  if (length <= 0.2 * radius) return;
  x = x / length;
  const Vec3 helper = std::abs(x.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  Vec3 z = cross(x, helper);
  z = z / norm(z);
  const Vec3 y = cross(z, x);
  vtkMatrix4x4* m = coil.GetUserMatrix();
  if (m == nullptr) {
    vtkNew<vtkMatrix4x4> made;
    coil.SetUserMatrix(made);
    m = made;
  }
  const double sx = length / 8;  // makeCoil's own length
  const double rows[3][4] = {{sx * x.x, radius * y.x, radius * z.x, from.x},
                             {sx * x.y, radius * y.y, radius * z.y, from.y},
                             {sx * x.z, radius * y.z, radius * z.z, from.z}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) m->SetElement(i, j, rows[i][j]);
  m->Modified();
}

}  // namespace reachlab::gui::scene
