#include "gui/scene/scene_actors.h"

#include <vtkActor.h>
#include <vtkAppendPolyData.h>
#include <vtkArrowSource.h>
#include <vtkCellArray.h>
#include <vtkCubeSource.h>
#include <vtkCylinderSource.h>
#include <vtkConeSource.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3D.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkShaderProperty.h>
#include <vtkSphereSource.h>
#include <vtkTubeFilter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace reachlab::gui::scene {
namespace {

constexpr double kPenLength = 16;               // in radii of its tip
constexpr double kPenTilt = 32, kPenTurn = 24;  // [deg] towards the viewer, to the right

vtkSmartPointer<vtkSphereSource> makeSphere(double radius, int around, int down) {
  auto sphere = vtkSmartPointer<vtkSphereSource>::New();
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(around);
  sphere->SetPhiResolution(down);
  return sphere;
}

Actor actorOf(vtkPolyDataMapper* mapper, const Look& look) {
  mapper->ScalarVisibilityOff();
  const auto actor = Actor::New();
  actor->SetMapper(mapper);
  vtkProperty* p = actor->GetProperty();
  p->SetColor(look.colour.red, look.colour.green, look.colour.blue);
  p->SetOpacity(look.opacity);
  p->SetAmbient(0.12);
  p->SetDiffuse(0.88);
  p->SetSpecular(look.shine);
  p->SetSpecularPower(look.metal ? 60 : 28);
  if (look.metal) p->SetDiffuse(0.55), p->SetAmbient(0.18);
  p->SetInterpolationToPhong();
  return actor;
}

Actor actorOf(vtkAlgorithmOutput* geometry, const Look& look) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(geometry);
  return actorOf(mapper, look);
}

Actor actorOf(vtkPolyData* geometry, const Look& look) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(geometry);
  return actorOf(mapper, look);
}

vtkSmartPointer<vtkPoints> pointsOf(const std::vector<Vec3>& places) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  for (const Vec3& p : places) points->InsertNextPoint(p.x, p.y, p.z);
  return points;
}

template <std::size_t Corners>
vtkSmartPointer<vtkPolyData> facesOf(const std::vector<Vec3>& points, const std::vector<std::array<std::uint32_t, Corners>>& faces) {
  vtkNew<vtkCellArray> cells;
  for (const auto& face : faces) {
    cells->InsertNextCell(static_cast<int>(Corners));
    for (const std::uint32_t corner : face) cells->InsertCellPoint(static_cast<vtkIdType>(corner));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(pointsOf(points));
  data->SetPolys(cells);
  return data;
}

}  // namespace

ActorGroup::ActorGroup(vtkRenderer& renderer) : renderer_(&renderer) {}

ActorGroup::~ActorGroup() {
  for (const Actor& actor : actors_) renderer_->RemoveActor(actor);
}

Actor ActorGroup::add(const Actor& actor) {
  renderer_->AddActor(actor);
  return actors_.emplace_back(actor);
}

void place(vtkActor& actor, const Vec3& at) {
  if (isFinite(at)) actor.SetPosition(at.x, at.y, at.z);
}

vtkSmartPointer<vtkPolyData> quadsOf(const SurfaceMesh& mesh) { return facesOf(mesh.points, mesh.quads); }

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

void makeShell(vtkActor& actor) {
  actor.GetShaderProperty()->AddFragmentShaderReplacement(
      "//VTK::Light::Impl", false,
      "//VTK::Light::Impl\n"
      "  float facing = abs(dot(normalVCVSOutput, normalize(vertexVC.xyz)));\n"
      "  fragOutput0.a = min(1.0, fragOutput0.a * (0.65 + 1.9 * (1.0 - facing) * (1.0 - facing)));\n",
      false);
}

Actor makeBall(const Look& look) { return actorOf(makeSphere(1, 40, 28)->GetOutputPort(), look); }

Actor makeBox(const Look& look) {
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

namespace {

// The wire's centre line runs from end to end in the frame of the axis: a hook, the coil, a hook. Lengths in coil radii.
constexpr int kPerTurn = 16, kHookSamples = 12;
constexpr double kHook = 0.55;  // radius of a hook

int samplesOf(int turns) { return turns * kPerTurn + 1 + 2 * kHookSamples; }

// Point `i` of the wire of a coil of that length. A hook turns once about its centre on the axis, and the coil begins and ends on the axis.
Vec3 wirePoint(int i, int turns, double length) {
  const int last = samplesOf(turns) - 1;
  if (i < kHookSamples || i > last - kHookSamples) {
    const bool first = i < kHookSamples;
    const double share = static_cast<double>(first ? i : last - i) / kHookSamples,
                 angle = 2 * std::numbers::pi * share - std::numbers::pi / 2;
    const double along = kHook + kHook * std::sin(angle) + kHook * share * 1.2, across = kHook * std::cos(angle);
    return {first ? along : length - along, first ? across : -across, 0};
  }
  const double s = static_cast<double>(i - kHookSamples) / (turns * kPerTurn), angle = 2 * std::numbers::pi * turns * s;
  const double radius = std::min({1.0, s * 2 * turns, (1 - s) * 2 * turns}), lead = 1.2 * kHook;
  return {lead + (length - 2 * lead) * s, radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace

Actor makeCoil(const Look& look, int turns) {
  std::vector<Vec3> wire;
  for (int i = 0; i < samplesOf(turns); ++i) wire.push_back(wirePoint(i, turns, 10));
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputData(linesOf({wire}));
  tube->SetNumberOfSides(7);
  return actorOf(tube->GetOutputPort(), look);
}

Vec3 penEnd(const Vec3& hand, double radius) {
  const double tilt = kPenTilt * std::numbers::pi / 180, turn = kPenTurn * std::numbers::pi / 180;
  return hand + kPenLength * radius * Vec3{std::cos(tilt) * std::sin(turn), std::cos(tilt) * std::cos(turn), std::sin(tilt)};
}

Actor makePen(const Look& look) {
  const auto tip = makeSphere(1, 24, 18);
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
  for (vtkAlgorithm* part : std::initializer_list<vtkAlgorithm*>{tip, cone, shaft}) all->AddInputConnection(part->GetOutputPort());
  auto actor = actorOf(all->GetOutputPort(), look);
  actor->SetOrientation(kPenTilt, 0, -kPenTurn);
  return actor;
}

Actor makeRail(const CurveMesh& mesh, double radius, const Look& look) {
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputData(linesOf(mesh.pieces));
  tube->SetRadius(radius);
  tube->SetNumberOfSides(14);
  tube->CappingOn();
  return actorOf(tube->GetOutputPort(), look);
}

Actor makeSkin(const SurfaceMesh& mesh, const Look& look) {
  const auto data = quadsOf(mesh);
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  for (const Vec3& n : mesh.normals) normals->InsertNextTuple3(n.x, n.y, n.z);
  data->GetPointData()->SetNormals(normals);
  return actorOf(data, look);
}

// Corners beyond the points and numbers that are not finite were refused when the file was read (model::check).
Actor makeTriangles(const model::ModelPart& part) {
  constexpr double kEdge = 35;  // [degrees] between two triangles that is an edge, not a bend
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(facesOf(part.points, part.triangles));
  normals->SetFeatureAngle(kEdge);
  const auto& [red, green, blue] = part.colour;
  auto actor = actorOf(normals->GetOutputPort(), {{red, green, blue}, part.opacity, 0.2});
  actor->GetProperty()->SetAmbient(0.15);
  actor->GetProperty()->SetDiffuse(0.85);
  actor->GetProperty()->SetSpecularPower(20);
  return actor;
}

Actor makeLines(const std::vector<std::vector<Vec3>>& pieces, const Look& look, double width) {
  auto actor = actorOf(linesOf(pieces), look);
  actor->GetProperty()->SetLighting(false);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  return actor;
}

Actor makeDots(const std::vector<Vec3>& places, double radius, const Look& look) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(pointsOf(places));
  const auto ball = makeSphere(radius, 12, 9);
  vtkNew<vtkGlyph3D> dots;
  dots->SetInputData(data);
  dots->SetSourceConnection(ball->GetOutputPort());
  dots->ScalingOff();
  return actorOf(dots->GetOutputPort(), look);
}

Actor makeArrows(const std::vector<ForceArrow>& arrows, double longest, const Look& look) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> forces;
  forces->SetNumberOfComponents(3);
  for (const auto& [at, force] : arrows) {
    points->InsertNextPoint(at.x, at.y, at.z);
    forces->InsertNextTuple3(force.x, force.y, force.z);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->GetPointData()->SetVectors(forces);
  vtkNew<vtkArrowSource> arrow;
  arrow->SetShaftRadius(0.05);
  arrow->SetTipRadius(0.13);
  arrow->SetTipLength(0.3);
  arrow->SetShaftResolution(14);
  arrow->SetTipResolution(18);
  vtkNew<vtkGlyph3D> glyphs;
  glyphs->SetInputData(data);
  glyphs->SetSourceConnection(arrow->GetOutputPort());
  glyphs->SetVectorModeToUseVector();
  glyphs->SetScaleModeToScaleByVector();
  glyphs->SetScaleFactor(longest / longestOf(arrows));
  return actorOf(glyphs->GetOutputPort(), look);
}

void stretch(vtkActor& coil, const Vec3& from, const Vec3& to, double radius, double wire) {
  Vec3 x = to - from;
  const double length = norm(x);
  coil.SetVisibility(length > 1.5 * radius);
  if (length <= 1.5 * radius) return;
  x = x / length;
  const Vec3 helper = std::abs(x.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  Vec3 z = cross(x, helper);
  z = z / norm(z);
  const Vec3 y = cross(z, x);
  auto* tube = vtkTubeFilter::SafeDownCast(coil.GetMapper()->GetInputAlgorithm());
  tube->SetRadius(wire);
  vtkPoints* points = vtkPolyData::SafeDownCast(tube->GetInput())->GetPoints();
  const int samples = static_cast<int>(points->GetNumberOfPoints()), turns = (samples - 1 - 2 * kHookSamples) / kPerTurn;
  for (int i = 0; i < samples; ++i) {
    const Vec3 p = radius * wirePoint(i, turns, length / radius), at = from + p.x * x + p.y * y + p.z * z;
    points->SetPoint(i, at.x, at.y, at.z);
  }
  points->Modified();
}

}  // namespace reachlab::gui::scene
