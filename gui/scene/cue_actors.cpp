#include "gui/scene/cue_actors.h"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gui/scene/scene_overlay.h"

namespace reachlab::gui::scene {
namespace {

constexpr double kLongest = 1.2;       // of the reach: no arrow leaves the picture
constexpr double kLeastForce = 0.02;   // [N]
constexpr double kTraceStep = 0.0015;  // of the reach, between two points

}  // namespace

CueActors::CueActors(vtkRenderer& renderer, const ScenePlan& plan) : actors_(renderer), plan_(plan) {
  if (plan_.look.depthCue != "none") addGrid();
  if (plan_.look.depthCue == "shadow") {
    for (const double radius : plan_.massRadius) addShadow(radius);
    addShadow(1.6 * plan_.handRadius);
    shadows_.back()->SetVisibility(plan_.handShown);
  }
  if (plan_.look.trace) {
    const Actor line = actors_.add(makeLines({}, {plan_.colours.trace, 0.85, 0}, 2));
    vtkPolyDataMapper::SafeDownCast(line->GetMapper())->SetInputData(trace_);
  }
  if (plan_.look.forceArrow && plan_.handShown) {
    arrow_ = actors_.add(makeArrows({{{}, {1, 0, 0}}}, 1, {plan_.colours.force, 1, 0}));
    arrow_->VisibilityOff();
  }
}

// Squares of a round length, so that they are a measure too, on a faint floor. Both fade towards the rim.
void CueActors::addGrid() {
  const Box& box = plan_.box;
  const double step = roundLength(0.16 * plan_.size);
  if (!(step > 0)) return;
  constexpr double kMargin = 3;  // squares around the scene
  const auto down = [&](double v) { return step * (std::floor(v / step) - kMargin); };
  const auto up = [&](double v) { return step * (std::ceil(v / step) + kMargin); };
  const double left = down(box.low.x), right = up(box.high.x), back = down(box.low.z), front = up(box.high.z);
  const Vec3 middle{0.5 * (left + right), plan_.floor, 0.5 * (back + front)};
  const double width = 0.5 * (right - left), depth = 0.5 * (front - back);
  std::vector<std::vector<Vec3>> lines;
  std::vector<double> opacity;
  const auto line = [&](const Vec3& from, const Vec3& to) {
    const int squares = static_cast<int>(std::lround(norm(to - from) / step));
    lines.emplace_back();
    for (int i = 0; i <= squares; ++i) {
      const Vec3& p = lines.back().emplace_back(from + (static_cast<double>(i) / squares) * (to - from));
      opacity.push_back(0.4 * std::max(0.0, 1 - std::pow((p.x - middle.x) / width, 2) - std::pow((p.z - middle.z) / depth, 2)));
    }
  };
  for (int i = 0; left + i * step <= right + 0.5 * step; ++i)
    line({left + i * step, plan_.floor, back}, {left + i * step, plan_.floor, front});
  for (int i = 0; back + i * step <= front + 0.5 * step; ++i)
    line({left, plan_.floor, back + i * step}, {right, plan_.floor, back + i * step});
  const widgets::Colour& c = plan_.colours.rail;
  addSoft(linesOf(lines), c, opacity);
  const Actor ground = addDisc(c, {{{0, 0.13}, {0.5, 0.13}, {0.8, 0.06}, {1.0, 0}}});
  ground->SetScale(width, 1, depth);
  ground->SetPosition(middle.x, plan_.floor - 1e-3 * plan_.unit, middle.z);
}

// With an opacity at each point.
Actor CueActors::addSoft(vtkPolyData* data, const widgets::Colour& colour, const std::vector<double>& opacity) {
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(4);
  for (const double o : opacity) colours->InsertNextTuple4(255 * colour.red, 255 * colour.green, 255 * colour.blue, 255 * o);
  data->GetPointData()->SetScalars(colours);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  const Actor actor = actors_.add(vtkNew<vtkActor>());
  actor->SetMapper(mapper);
  actor->GetProperty()->SetLighting(false);
  actor->ForceTranslucentOn();
  return actor;
}

// A level disc around the origin whose opacity goes from ring to ring. The first ring is its centre.
Actor CueActors::addDisc(const widgets::Colour& colour, const std::array<Ring, 4>& rings) {
  constexpr std::uint32_t kSides = 32;
  SurfaceMesh disc;
  std::vector<double> opacities;
  for (const auto& [distance, opacity] : rings)
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const double angle = 2 * std::numbers::pi * i / kSides;
      const auto at = static_cast<std::uint32_t>(disc.points.size());
      disc.points.push_back({distance * std::cos(angle), 0, distance * std::sin(angle)});
      opacities.push_back(opacity);
      if (at < kSides) continue;
      const std::uint32_t next = i + 1 < kSides ? at + 1 : at + 1 - kSides;
      disc.quads.push_back({at, next, next - kSides, at - kSides});
    }
  return addSoft(quadsOf(disc), colour, opacities);
}

// As under a wide light: the rim fades.
void CueActors::addShadow(double size) {
  shadows_.push_back(addDisc({}, {{{0, 0.6}, {0.55, 0.6}, {1.0, 0.3}, {1.45, 0}}}));
  shadows_.back()->SetScale(size, 1, size);
}

void CueActors::showTrace(const SceneFrame& frame) {
  if (frame.trial != tracedTrial_) {
    tracedTrial_ = frame.trial;
    traced_.clear();
  }
  if (!frame.traced || !(plan_.handShown || frame.cursorShown)) return;
  const Vec3& at = plan_.handShown || frame.masses.empty() ? ownHand(frame) : frame.masses.front();
  if (!isFinite(at) || (!traced_.empty() && norm(at - traced_.back()) < kTraceStep * plan_.unit)) return;
  if (tracePointCount() >= kTracePoints) traced_.erase(traced_.begin(), traced_.begin() + kTracePoints / 2);
  traced_.push_back(at);
  trace_->ShallowCopy(linesOf({traced_}));
}

void CueActors::showArrow(const SceneFrame& frame) {
  const double force = norm(frame.force);
  const bool shown = force > kLeastForce && std::isfinite(force) && isFinite(ownHand(frame));
  arrow_->SetVisibility(shown);
  if (!shown) return;
  const double length = std::min(kReachPerNewton * force, kLongest) * plan_.unit, thick = std::max(length, 0.25 * plan_.unit);
  place(*arrow_, ownHand(frame));
  arrow_->SetScale(length, thick, thick);
  // Half a turn about the middle between x and the force takes x to the force.
  const Vec3 middle = Vec3{1, 0, 0} + frame.force / force, axis = norm(middle) > 1e-6 ? middle : Vec3{0, 1, 0};
  arrow_->SetOrientation(0, 0, 0);
  arrow_->RotateWXYZ(180, axis.x, axis.y, axis.z);
}

void CueActors::show(const SceneFrame& frame) {
  for (std::size_t i = 0; i < shadows_.size(); ++i) {
    const bool hand = i + 1 == shadows_.size();
    if (!hand && i >= frame.masses.size()) continue;
    if (i == 0 && !hand) shadows_[i]->SetVisibility(frame.cursorShown);
    const Vec3 at = hand ? ownHand(frame) : drawnPlace(plan_, frame, i);
    place(*shadows_[i], {at.x, plan_.floor + 1e-3 * plan_.unit, at.z});  // above the grid's lines
  }
  if (plan_.look.trace) showTrace(frame);
  if (arrow_) showArrow(frame);
}

}  // namespace reachlab::gui::scene
