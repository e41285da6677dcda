#include "gui/scene/object_actors.h"

#include <vtkActor.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <optional>

#include "gui/scene/cue_actors.h"
#include "gui/scene/model_actors.h"
#include "gui/scene/scene_actors.h"

namespace reachlab::gui::scene {
namespace {

using Actor = vtkSmartPointer<vtkActor>;

constexpr double kNextVia = 0.6, kLaterVia = 0.3, kPassedVia = 0.1;  // opacity of places on the way
constexpr double kOtherPlaces = 0.5;                                 // opacity of places that are not of this trial
constexpr double kFieldArrow = 0.18, kPulseArrow = 0.4;              // of the reach, the longest of each

widgets::Colour colourOf(MassRole role, const PartColours& colours) {
  switch (role) {
    case MassRole::Driven: return colours.driven;
    case MassRole::Last: return colours.last;
    case MassRole::Middle: break;
  }
  return colours.middle;
}

void place(vtkActor& actor, const Vec3& at) { actor.SetPosition(at.x, at.y, at.z); }

// Columns: the rotation of a unit quaternion, times the edge, and the place.
void placeBody(vtkActor& actor, const Vec3& at, const std::array<double, 4>& q, double edge) {
  const auto [w, x, y, z] = q;
  const double rows[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                             {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                             {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
  if (actor.GetUserMatrix() == nullptr) actor.SetUserMatrix(vtkNew<vtkMatrix4x4>());
  vtkMatrix4x4* m = actor.GetUserMatrix();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m->SetElement(i, j, edge * rows[i][j]);
  m->SetElement(0, 3, at.x);
  m->SetElement(1, 3, at.y);
  m->SetElement(2, 3, at.z);
  m->Modified();
}

}  // namespace

struct ObjectActors::Impl {
  vtkRenderer& renderer;
  ScenePlan plan;  // without its meshes
  std::vector<Actor> all, masses, springs, hands, via;
  struct Mark {
    Actor actor;
    bool atTarget;
    Vec3 shift;  // [m] beside it
  };
  std::vector<Mark> marks;
  std::unique_ptr<CueActors> cues;
  std::unique_ptr<ModelActors> model;
  bool handWasValid = true;

  Actor add(Actor actor) {
    renderer.AddActor(actor);
    all.push_back(actor);
    return actor;
  }
  void addConstraint(const ScenePlan& from, SurfaceStyle style) {
    if (from.curve.pointCount() > 1) {
      add(makeRail(from.curve, from.railRadius, {from.look.colours.rail, 1, 0.9, true}));
      // Shifted masses run beside the rail: a faint copy for each.
      for (const Vec3& shift : from.massShift)
        if (norm(shift) > 0) place(*add(makeRail(from.curve, 0.4 * from.railRadius, {from.look.colours.rail, 0.30, 0})), shift);
    }
    if (!from.surface.quads.empty()) {
      if (style == SurfaceStyle::Glass) makeShell(*add(makeSkin(from.surface, {from.look.colours.surface, from.look.surfaceOpacity, 0.3})));
      Actor lines =
          add(makeParameterLines(from.surface, {from.look.colours.surfaceLine, style == SurfaceStyle::Glass ? 0.40 : 0.85, 0}, 1.0));
      lines->PickableOff();
    }
  }
  // White where a mass goes on, red where none crosses.
  void addPlaces(const ScenePlan& from) {
    for (const bool passed : {true, false}) {
      std::vector<Vec3> places;
      for (const PlaceMark& mark : from.places)
        if (mark.passed == passed) places.push_back(mark.r);
      const double radius = from.surface.quads.empty() ? 1.9 * from.railRadius : 0.9 * from.railRadius;
      if (!places.empty()) add(makeDots(places, radius, {passed ? from.look.colours.hand : widgets::colours::kRed, 1, 0.2}));
    }
  }
  void addMarks(const ScenePlan& from) {
    if (!from.hasTask) return;
    for (const Vec3& at : from.via) {
      via.push_back(add(makeBall({from.look.colours.surfaceLine, kLaterVia, 0.2})));
      makeShell(*via.back());
      via.back()->SetScale(from.viaRadius);
      place(*via.back(), at);
    }
    const auto mark = [&](bool atTarget, const Vec3& shift, double radius, double opacity) {
      Actor ball = add(makeBall({atTarget ? from.look.colours.target : from.look.colours.start, opacity, 0.2}));
      if (opacity < 0.5) makeShell(*ball);
      ball->SetScale(radius);
      place(*ball, (atTarget ? from.target : from.start) + shift);
      marks.push_back({ball, atTarget, shift});
    };
    // Each place where a mass begins and ends, and the hand's own on the constraint. The shell at the target is the tolerance dx.
    const double ball = from.massRadius.empty() ? 0 : *std::max_element(from.massRadius.begin(), from.massRadius.end());
    for (const Vec3& shift : from.massShift) {
      if (norm(shift) == 0) continue;
      mark(false, shift, 0.55 * from.markRadius, 0.8);
      if (!from.targetShown) continue;
      mark(true, shift, 0.55 * from.markRadius, 0.8);
      if (from.tolerance > 0.55 * from.markRadius) mark(true, shift, from.tolerance, 0.13);
    }
    mark(false, {}, from.markRadius, 1);
    mark(false, {}, 1.45 * std::max(ball, from.markRadius), 0.25);  // seen around the mass that stands there
    if (!from.targetShown) return;
    mark(true, {}, from.markRadius, 1);
    const bool massOnRail = from.massShift.empty() ||
                            std::any_of(from.massShift.begin(), from.massShift.end(), [](const Vec3& shift) { return norm(shift) == 0; });
    if (from.tolerance > from.markRadius && massOnRail) mark(true, {}, from.tolerance, 0.13);
  }
  // The forces on the hand, and the places of the block's other trials.
  void addForces(const ScenePlan& from) {
    const ForceMarks& forces = from.forces;
    const widgets::Colour& colour = from.look.colours.force;
    if (!from.otherPlaces.empty()) add(makeDots(from.otherPlaces, 1.8 * from.markRadius, {from.look.colours.target, kOtherPlaces, 0}));
    if (!forces.field.empty()) add(makeArrows(forces.field, kFieldArrow * from.unit, {colour, 0.6, 0.1}));
    if (!forces.pulses.empty()) add(makeArrows(forces.pulses, kPulseArrow * from.unit, {colour, 0.9, 0.1}));
    if (forces.channel.quads.empty()) return;
    add(makeSkin(forces.channel, {from.look.colours.surface, 0.22, 0}));
    add(makeParameterLines(forces.channel, {from.look.colours.surfaceLine, 0.9, 0}, 2.0));
    SurfaceMesh dashes;
    dashes.parameterLines = forces.letsGo;
    add(makeParameterLines(dashes, {from.look.colours.surfaceLine, 0.6, 0}, 1.0));
  }
  void addObject(const ScenePlan& from) {
    for (const SpringPlan& spring : from.springs)
      springs.push_back(
          add(makeCoil({spring.coupling ? from.look.colours.coupling : from.look.colours.spring, 1, 0.5}, spring.coupling ? 6 : 9)));
    for (std::size_t i = 0; i < from.massRadius.size(); ++i) {
      const Look look{colourOf(from.massRole[i], from.look.colours), 1, 0.55};
      masses.push_back(add(from.body ? makeBox(look) : makeBall(look)));
      if (!from.body) masses.back()->SetScale(from.massRadius[i]);
    }
    const auto own = static_cast<std::size_t>(from.ownHand);
    for (std::size_t i = 0; i < std::max<std::size_t>(from.hands.size(), 1); ++i) {
      hands.push_back(add(makePen({i == own ? from.look.colours.hand : from.hands[i].colour, 1, 0.6})));
      hands[i]->SetScale(from.handRadius);
      hands[i]->SetVisibility(i == own);
    }
    for (std::size_t i = 0; i < masses.size(); ++i) masses[i]->SetVisibility(!model->hasMass(i));
    hands[own]->SetVisibility(from.handShown && !model->hasHand());
  }
};

ObjectActors::ObjectActors(vtkRenderer& renderer, const ScenePlan& plan, SurfaceStyle style)
    : impl_(new Impl{renderer, plan, {}, {}, {}, {}, {}, {}, nullptr, nullptr}) {
  impl_->plan.curve = {};
  impl_->plan.surface = {};
  impl_->model = std::make_unique<ModelActors>(renderer, plan);
  impl_->cues = std::make_unique<CueActors>(renderer, plan);
  impl_->addConstraint(plan, style);
  impl_->addPlaces(plan);
  impl_->addMarks(plan);
  impl_->addForces(plan);
  impl_->addObject(plan);
}

ObjectActors::~ObjectActors() {
  for (const Actor& actor : impl_->all) impl_->renderer.RemoveActor(actor);
}

void ObjectActors::movePlaces(const Vec3& start, const Vec3& target) {
  for (const Impl::Mark& mark : impl_->marks) place(*mark.actor, (mark.atTarget ? target : start) + mark.shift);
}

void ObjectActors::show(const SceneFrame& frame) {
  const ScenePlan& plan = impl_->plan;
  impl_->model->show(frame);
  impl_->cues->show(frame);
  const std::size_t count = std::min(frame.masses.size(), impl_->masses.size());
  const auto drawn = [&](std::size_t i) { return frame.masses[i] + plan.massShift[i]; };
  for (std::size_t i = 0; i < count; ++i) {
    if (!isFinite(frame.masses[i])) continue;
    if (plan.body) placeBody(*impl_->masses[i], drawn(i), frame.body.orientation, 2.2 * plan.massRadius[i]);
    else place(*impl_->masses[i], drawn(i));
  }
  if (count > 0) impl_->masses[0]->SetVisibility(frame.cursorShown && !impl_->model->hasMass(0));
  // Masses at one position are drawn as one: two skins at one position flicker.
  for (std::size_t i = 1; i < count; ++i) {
    bool hidden = impl_->model->hasMass(i);
    for (std::size_t k = 0; k < i; ++k)
      hidden = hidden || (isFinite(frame.masses[i]) && plan.massRadius[k] >= plan.massRadius[i] &&
                          norm(drawn(i) - drawn(k)) < 0.12 * plan.massRadius[k]);
    impl_->masses[i]->SetVisibility(!hidden);
  }
  for (std::size_t i = 0; i < impl_->via.size(); ++i) {
    const int ahead = static_cast<int>(i) - frame.viaPassed;
    impl_->via[i]->GetProperty()->SetOpacity(ahead < 0 ? kPassedVia : ahead == 0 ? kNextVia : kLaterVia);
  }
  const auto own = static_cast<std::size_t>(plan.ownHand);
  const auto isShown = [&](std::size_t i) { return i < frame.hands.size() && frame.hands[i] && isFinite(*frame.hands[i]); };
  for (std::size_t i = 0; i < impl_->hands.size(); ++i) {
    if (isShown(i)) place(*impl_->hands[i], *frame.hands[i]);
    if (i != own) impl_->hands[i]->SetVisibility(isShown(i));
  }
  if (frame.handValid != impl_->handWasValid) {
    impl_->handWasValid = frame.handValid;
    const widgets::Colour c = frame.handValid ? plan.look.colours.hand : widgets::colours::kHandLost;
    impl_->hands[own]->GetProperty()->SetColor(c.red, c.green, c.blue);
  }
  for (std::size_t i = 0; i < impl_->springs.size(); ++i) {
    const SpringPlan& spring = plan.springs[i];
    const auto to = static_cast<std::size_t>(spring.to);
    if (to >= count || (spring.from >= 0 && static_cast<std::size_t>(spring.from) >= count)) continue;
    const auto hand = static_cast<std::size_t>(spring.hand);
    if (spring.from < 0 && !isShown(hand)) {
      if (hand != own) impl_->springs[i]->VisibilityOff();
      continue;
    }
    const Vec3 from = spring.from < 0 ? *frame.hands[hand] : drawn(static_cast<std::size_t>(spring.from));
    if (!isFinite(from) || !isFinite(drawn(to))) continue;
    // From surface to surface of the bodies at its ends.
    const Vec3 way = drawn(to) - from;
    const double length = norm(way), first = spring.from < 0 ? plan.handRadius : plan.massRadius[static_cast<std::size_t>(spring.from)],
                 second = plan.body ? 0 : plan.massRadius[to], coil = (spring.coupling ? 0.010 : 0.016) * plan.unit;
    const Vec3 unit = length > first + second ? way / length : Vec3{};
    stretch(*impl_->springs[i], from + first * unit, length > first + second ? drawn(to) - second * unit : from, coil,
            (spring.coupling ? 0.0016 : 0.0026) * plan.unit);
  }
}

}  // namespace reachlab::gui::scene
