#include "gui/scene/cue_actors.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "gui/scene/scene_actors.h"
#include "gui/scene/scene_overlay.h"

namespace reachlab::gui::scene {
namespace {

using Actor = vtkSmartPointer<vtkActor>;

constexpr double kLongest = 1.2;       // of the reach: no arrow leaves the picture
constexpr double kLeastForce = 0.02;   // [N]
constexpr double kTraceStep = 0.0015;  // of the reach, between two points

Actor actorOf(vtkPolyDataMapper* mapper, const widgets::Colour& colour, double opacity) {
  mapper->ScalarVisibilityOff();
  const Actor actor = Actor::New();
  actor->SetMapper(mapper);
  actor->PickableOff();
  actor->GetProperty()->SetColor(colour.red, colour.green, colour.blue);
  actor->GetProperty()->SetOpacity(opacity);
  actor->GetProperty()->SetLighting(false);
  return actor;
}

}  // namespace

struct CueActors::Impl {
  Impl(vtkRenderer& to, const ScenePlan& plan)
      : renderer(to), look(plan.look), shift(plan.massShift), radius(plan.massRadius), unit(plan.unit), floor(plan.floor),
        handRadius(plan.handRadius), handShown(plan.handShown) {}

  vtkRenderer& renderer;
  const PlanLook look;
  const std::vector<Vec3> shift;
  const std::vector<double> radius;
  const double unit, floor, handRadius;
  const bool handShown;             // false: the cues are those of the first mass
  std::vector<Actor> all, shadows;  // of the masses, and last the hand's
  Actor arrow;
  vtkNew<vtkPoints> tracePoints;
  vtkNew<vtkPolyData> trace;
  std::int32_t tracedTrial = 0;
  Vec3 lastTraced;

  Actor add(Actor actor) {
    renderer.AddActor(actor);
    all.push_back(actor);
    return actor;
  }

  // Squares of a round length, so that they are a measure too, on a faint floor. Both fade towards the rim.
  void addGrid(const Box& box, double size) {
    const double step = roundLength(0.16 * size);
    if (!(step > 0)) return;
    constexpr double kMargin = 3;  // squares around the scene
    const auto down = [&](double v) { return step * (std::floor(v / step) - kMargin); };
    const auto up = [&](double v) { return step * (std::ceil(v / step) + kMargin); };
    const double left = down(box.low.x), right = up(box.high.x), back = down(box.low.z), front = up(box.high.z);
    const Vec3 middle{0.5 * (left + right), floor, 0.5 * (back + front)};
    const double width = 0.5 * (right - left), depth = 0.5 * (front - back);
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> lines;
    vtkNew<vtkUnsignedCharArray> colours;
    colours->SetNumberOfComponents(4);
    const widgets::Colour& c = look.colours.rail;
    const auto corner = [&](double x, double z) {
      const double out = std::pow((x - middle.x) / width, 2) + std::pow((z - middle.z) / depth, 2);
      colours->InsertNextTuple4(255 * c.red, 255 * c.green, 255 * c.blue, 255 * 0.4 * std::max(0.0, 1 - out));
      return points->InsertNextPoint(x, floor, z);
    };
    const auto line = [&](double ax, double az, double bx, double bz) {
      const int squares = static_cast<int>(std::lround(std::hypot(bx - ax, bz - az) / step));
      lines->InsertNextCell(squares + 1);
      for (int i = 0; i <= squares; ++i) lines->InsertCellPoint(corner(ax + (bx - ax) * i / squares, az + (bz - az) * i / squares));
    };
    for (int i = 0; left + i * step <= right + 0.5 * step; ++i) line(left + i * step, back, left + i * step, front);
    for (int i = 0; back + i * step <= front + 0.5 * step; ++i) line(left, back + i * step, right, back + i * step);
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetLines(lines);
    data->GetPointData()->SetScalars(colours);
    addSoft(data);
    Actor ground = addDisc(c, {{{0.5, 0.13}, {0.8, 0.06}, {1.0, 0}}});
    ground->SetScale(width, 1, depth);
    ground->SetPosition(middle.x, floor - 1e-3 * unit, middle.z);
  }

  Actor addSoft(vtkPolyData* data) {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(data);
    Actor actor = add(actorOf(mapper, {}, 1));
    mapper->ScalarVisibilityOn();
    actor->ForceTranslucentOn();
    return actor;
  }

  struct Ring {
    double distance, opacity;
  };
  // A level disc around the origin whose opacity goes from ring to ring.
  Actor addDisc(const widgets::Colour& colour, const std::array<Ring, 3>& rings) {
    constexpr int kSides = 32;
    vtkNew<vtkPoints> points;
    vtkNew<vtkUnsignedCharArray> colours;
    colours->SetNumberOfComponents(4);
    vtkNew<vtkCellArray> faces;
    faces->InsertNextCell(kSides);
    for (int i = 0; i < kSides; ++i) faces->InsertCellPoint(i);
    for (const auto& [distance, opacity] : rings)
      for (int i = 0; i < kSides; ++i) {
        const double angle = 2 * std::numbers::pi * i / kSides;
        const vtkIdType at = points->InsertNextPoint(distance * std::cos(angle), 0, distance * std::sin(angle));
        colours->InsertNextTuple4(255 * colour.red, 255 * colour.green, 255 * colour.blue, 255 * opacity);
        if (at < kSides) continue;
        const vtkIdType next = i + 1 < kSides ? at + 1 : at + 1 - kSides, corners[] = {at, next, next - kSides, at - kSides};
        faces->InsertNextCell(4, corners);
      }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(faces);
    data->GetPointData()->SetScalars(colours);
    return addSoft(data);
  }

  // As under a wide light: the rim fades.
  Actor addShadow(double size) {
    Actor disc = addDisc({}, {{{0.55, 0.6}, {1.0, 0.3}, {1.45, 0}}});
    disc->SetScale(size, 1, size);
    return disc;
  }

  void addTrace() {
    trace->SetPoints(tracePoints);
    trace->SetLines(vtkNew<vtkCellArray>());
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(trace);
    Actor line = add(actorOf(mapper, look.colours.trace, 0.85));
    line->GetProperty()->SetLineWidth(2);
  }

  void addArrow() {
    arrow = add(makeArrows({{{}, {1, 0, 0}}}, 1, {look.colours.force, 1, 0}));
    arrow->PickableOff();
    arrow->SetUserMatrix(vtkNew<vtkMatrix4x4>());
    arrow->VisibilityOff();
  }

  void showTrace(const SceneFrame& frame) {
    if (frame.trial != tracedTrial) {
      tracedTrial = frame.trial;
      tracePoints->Reset();
    }
    const vtkIdType count = tracePoints->GetNumberOfPoints();
    const Vec3& at = handShown || frame.masses.empty() ? ownHand(frame) : frame.masses.front();
    if (!frame.traced || !(handShown || frame.cursorShown)) return;
    if (!isFinite(at) || (count > 0 && norm(at - lastTraced) < kTraceStep * unit)) return;
    lastTraced = at;
    if (count >= kTracePoints) {  // the older half goes
      for (vtkIdType i = 0; i < count / 2; ++i) tracePoints->SetPoint(i, tracePoints->GetPoint(i + count - count / 2));
      tracePoints->SetNumberOfPoints(count / 2);
    }
    tracePoints->InsertNextPoint(at.x, at.y, at.z);
    vtkNew<vtkCellArray> line;
    line->InsertNextCell(static_cast<int>(tracePoints->GetNumberOfPoints()));
    for (vtkIdType i = 0; i < tracePoints->GetNumberOfPoints(); ++i) line->InsertCellPoint(i);
    trace->SetLines(line);
    tracePoints->Modified();
    trace->Modified();
  }

  void showArrow(const SceneFrame& frame) {
    const double force = norm(frame.force);
    const bool shown = force > kLeastForce && std::isfinite(force) && isFinite(ownHand(frame));
    arrow->SetVisibility(shown);
    if (!shown) return;
    const double length = std::min(kReachPerNewton * force, kLongest) * unit, thick = std::max(length, 0.25 * unit);
    const Vec3 x = frame.force / force, helper = std::abs(x.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
    Vec3 z = cross(x, helper);
    z = z / norm(z);
    const Vec3 y = cross(z, x);
    vtkMatrix4x4* m = arrow->GetUserMatrix();
    const double rows[3][4] = {{length * x.x, thick * y.x, thick * z.x, ownHand(frame).x},
                               {length * x.y, thick * y.y, thick * z.y, ownHand(frame).y},
                               {length * x.z, thick * y.z, thick * z.z, ownHand(frame).z}};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j) m->SetElement(i, j, rows[i][j]);
    m->Modified();
  }
};

CueActors::CueActors(vtkRenderer& renderer, const ScenePlan& plan) : impl_(std::make_unique<Impl>(renderer, plan)) {
  Impl& d = *impl_;
  if (d.look.grid) d.addGrid(plan.box, plan.size);
  if (d.look.shadow) {
    for (const double radius : d.radius) d.shadows.push_back(d.addShadow(radius));
    d.shadows.push_back(d.addShadow(1.6 * d.handRadius));
    d.shadows.back()->SetVisibility(d.handShown);
  }
  if (d.look.trace) d.addTrace();
  if (d.look.forceArrow && d.handShown) d.addArrow();
}

CueActors::~CueActors() {
  for (const Actor& actor : impl_->all) impl_->renderer.RemoveActor(actor);
}

void CueActors::show(const SceneFrame& frame) {
  Impl& d = *impl_;
  const double height = d.floor + 1e-3 * d.unit;  // above the grid's lines
  for (std::size_t i = 0; i < d.shadows.size(); ++i) {
    const bool hand = i + 1 == d.shadows.size();
    if (!hand && i >= frame.masses.size()) continue;
    if (i == 0 && !hand) d.shadows[i]->SetVisibility(frame.cursorShown);
    const Vec3 at = hand ? ownHand(frame) : frame.masses[i] + d.shift[i];
    if (isFinite(at)) d.shadows[i]->SetPosition(at.x, height, at.z);
  }
  if (d.look.trace) d.showTrace(frame);
  if (d.arrow) d.showArrow(frame);
}

int CueActors::tracePointCount() const { return static_cast<int>(impl_->tracePoints->GetNumberOfPoints()); }

}  // namespace reachlab::gui::scene
