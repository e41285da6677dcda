#include "gui/scene/object_actors.h"

#include <vtkActor.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace reachlab::gui::scene {
namespace {

constexpr double kNextVia = 0.6, kLaterVia = 0.3, kPassedVia = 0.1;  // opacity of places on the way
constexpr double kOtherPlaces = 0.5;                                 // opacity of places that are not of this trial
constexpr double kFieldArrow = 0.18, kPulseArrow = 0.4;              // of the reach, the longest of each

void turn(vtkActor& actor, const std::array<double, 4>& quaternion) {
  const auto [w, x, y, z] = quaternion;
  actor.SetOrientation(0, 0, 0);
  actor.RotateWXYZ(2 * std::atan2(std::hypot(x, y, z), w) * 180 / std::numbers::pi, x, y, z);
}

}  // namespace

ObjectActors::ObjectActors(vtkRenderer& renderer, const ScenePlan& plan, SurfaceStyle style)
    : plan_(plan), actors_(renderer), massModels_(plan.massRadius.size()) {
  addModel();
  cues_.emplace(renderer, plan_);
  addConstraint(style);
  addPlaces();
  if (plan.hasTask) addMarks();
  addForces();
  addObject();
  plan_.curve = {};
  plan_.surface = {};
}

Actor ObjectActors::addBall(const Look& look, double radius) {
  Actor ball = actors_.add(makeBall(look));
  ball->SetScale(radius);
  return ball;
}

void ObjectActors::addModel() {
  if (!plan_.model) return;
  for (const model::ModelPart& part : plan_.model->parts) {
    std::vector<Actor>* where = part.name == "hand" ? &handModel_ : nullptr;
    for (std::size_t i = 0; i < massModels_.size(); ++i)
      if (part.name == "mass" + std::to_string(i + 1)) where = &massModels_[i];
    if (where == nullptr && !part.name.empty()) continue;  // a mass that there is not, or that is not shown
    const Actor actor = actors_.add(makeTriangles(part));
    if (where != nullptr) where->push_back(actor);
    if (where == &handModel_) actor->SetVisibility(plan_.handShown);
  }
}

void ObjectActors::addConstraint(SurfaceStyle style) {
  const PartColours& colours = plan_.colours;
  if (plan_.curve.pointCount() > 1) {
    actors_.add(makeRail(plan_.curve, plan_.railRadius, {colours.rail, 1, 0.9, true}));
    // Shifted masses run beside the rail: a faint copy for each.
    for (const Vec3& shift : plan_.massShift)
      if (norm(shift) > 0) place(*actors_.add(makeRail(plan_.curve, 0.4 * plan_.railRadius, {colours.rail, 0.30, 0})), shift);
  }
  if (plan_.surface.quads.empty()) return;
  const bool glass = style == SurfaceStyle::Glass;
  if (glass) makeShell(*actors_.add(makeSkin(plan_.surface, {colours.surface, plan_.look.surfaceOpacity, 0.3})));
  actors_.add(makeLines(plan_.surface.parameterLines, {colours.surfaceLine, glass ? 0.40 : 0.85, 0}, 1.0));
}

// White where a mass goes on, red where none crosses.
void ObjectActors::addPlaces() {
  for (const bool passed : {true, false}) {
    std::vector<Vec3> places;
    for (const PlaceMark& mark : plan_.places)
      if (mark.passed == passed) places.push_back(mark.r);
    const double radius = plan_.surface.quads.empty() ? 1.9 * plan_.railRadius : 0.9 * plan_.railRadius;
    if (!places.empty()) actors_.add(makeDots(places, radius, {passed ? plan_.colours.hand : widgets::colours::kRed, 1, 0.2}));
  }
}

void ObjectActors::addMark(bool atTarget, const Vec3& shift, double radius, double opacity) {
  const PartColours& colours = plan_.colours;
  const Actor ball = addBall({atTarget ? colours.target : colours.start, opacity, 0.2}, radius);
  if (opacity < 0.5) makeShell(*ball);
  place(*ball, (atTarget ? plan_.target : plan_.start) + shift);
  marks_.push_back({ball, atTarget, shift});
}

void ObjectActors::addMarks() {
  for (const Vec3& at : plan_.via) {
    via_.push_back(addBall({plan_.colours.surfaceLine, kLaterVia, 0.2}, plan_.viaRadius));
    makeShell(*via_.back());
    place(*via_.back(), at);
  }
  // Each place where a mass begins and ends, and the hand's own on the constraint. The shell at the target is the tolerance dx.
  const double ball = plan_.massRadius.empty() ? 0 : *std::max_element(plan_.massRadius.begin(), plan_.massRadius.end());
  bool massOnRail = plan_.massShift.empty();
  for (const Vec3& shift : plan_.massShift) {
    massOnRail = massOnRail || norm(shift) == 0;
    if (norm(shift) == 0) continue;
    addMark(false, shift, 0.55 * plan_.markRadius, 0.8);
    if (!plan_.targetShown) continue;
    addMark(true, shift, 0.55 * plan_.markRadius, 0.8);
    if (plan_.tolerance > 0.55 * plan_.markRadius) addMark(true, shift, plan_.tolerance, 0.13);
  }
  addMark(false, {}, plan_.markRadius, 1);
  addMark(false, {}, 1.45 * std::max(ball, plan_.markRadius), 0.25);  // seen around the mass that stands there
  if (!plan_.targetShown) return;
  addMark(true, {}, plan_.markRadius, 1);
  if (plan_.tolerance > plan_.markRadius && massOnRail) addMark(true, {}, plan_.tolerance, 0.13);
}

// The forces on the hand, and the places of the block's other trials.
void ObjectActors::addForces() {
  const ForceMarks& forces = plan_.forces;
  const PartColours& colours = plan_.colours;
  if (!plan_.otherPlaces.empty()) actors_.add(makeDots(plan_.otherPlaces, 1.8 * plan_.markRadius, {colours.target, kOtherPlaces, 0}));
  if (!forces.field.empty()) actors_.add(makeArrows(forces.field, kFieldArrow * plan_.unit, {colours.force, 0.6, 0.1}));
  if (!forces.pulses.empty()) actors_.add(makeArrows(forces.pulses, kPulseArrow * plan_.unit, {colours.force, 0.9, 0.1}));
  if (forces.channel.quads.empty()) return;
  actors_.add(makeSkin(forces.channel, {colours.surface, 0.22, 0}));
  actors_.add(makeLines(forces.channel.parameterLines, {colours.surfaceLine, 0.9, 0}, 2.0));
  actors_.add(makeLines(forces.letsGo, {colours.surfaceLine, 0.6, 0}, 1.0));
}

void ObjectActors::addObject() {
  const PartColours& colours = plan_.colours;
  for (const SpringPlan& spring : plan_.springs)
    springs_.push_back(actors_.add(makeCoil({spring.coupling ? colours.coupling : colours.spring, 1, 0.5}, spring.coupling ? 6 : 9)));
  const std::size_t count = plan_.massRadius.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Look look{i == 0 ? colours.driven : i + 1 == count ? colours.last : colours.middle, 1, 0.55};
    masses_.push_back(actors_.add(plan_.body ? makeBox(look) : makeBall(look)));
    masses_[i]->SetScale(plan_.body ? 2.2 * plan_.massRadius[i] : plan_.massRadius[i]);
    masses_[i]->SetVisibility(massModels_[i].empty());
  }
  const auto own = static_cast<std::size_t>(plan_.ownHand);
  for (std::size_t i = 0; i < std::max<std::size_t>(plan_.hands.size(), 1); ++i) {
    hands_.push_back(actors_.add(makePen({i == own ? colours.hand : plan_.hands[i], 1, 0.6})));
    hands_[i]->SetScale(plan_.handRadius);
    hands_[i]->SetVisibility(i == own && plan_.handShown && handModel_.empty());
  }
}

void ObjectActors::movePlaces(const Vec3& start, const Vec3& target) {
  for (const Mark& mark : marks_) place(*mark.actor, (mark.atTarget ? target : start) + mark.shift);
}

void ObjectActors::show(const SceneFrame& frame) {
  for (const Actor& actor : handModel_) place(*actor, ownHand(frame));
  cues_->show(frame);
  showMasses(frame);
  for (std::size_t i = 0; i < via_.size(); ++i) {
    const int ahead = static_cast<int>(i) - frame.viaPassed;
    via_[i]->GetProperty()->SetOpacity(ahead < 0 ? kPassedVia : ahead == 0 ? kNextVia : kLaterVia);
  }
  showHands(frame);
  showSprings(frame);
}

bool ObjectActors::showGhosts(const std::vector<SceneFrame>& ghosts) {
  constexpr double kFaint = 0.22;
  const PartColours& colours = plan_.colours;
  const std::size_t count = plan_.massRadius.size();
  while (ghosts_.size() < ghosts.size()) {
    std::vector<Actor>& balls = ghosts_.emplace_back();
    for (std::size_t i = 0; i < count; ++i)
      balls.push_back(addBall({i + 1 == count ? colours.last : colours.middle, kFaint, 0.1}, plan_.massRadius[i]));
    balls.push_back(addBall({colours.hand, kFaint, 0.1}, plan_.handRadius));
  }
  for (std::size_t g = 0; g < ghosts_.size(); ++g)
    for (std::size_t i = 0; i <= count; ++i) {
      const bool shown = g < ghosts.size() && (i == count || i < ghosts[g].masses.size());
      ghosts_[g][i]->SetVisibility(shown);
      if (shown) place(*ghosts_[g][i], i == count ? ownHand(ghosts[g]) : drawnPlace(plan_, ghosts[g], i));
    }
  return !ghosts_.empty();
}

void ObjectActors::showMasses(const SceneFrame& frame) {
  if (!massModels_.empty())
    for (const Actor& actor : massModels_.front()) actor->SetVisibility(frame.cursorShown);
  const auto drawn = [&](std::size_t i) { return drawnPlace(plan_, frame, i); };
  for (std::size_t i = 0; i < std::min(frame.masses.size(), masses_.size()); ++i) {
    for (const Actor& actor : massModels_[i]) place(*actor, drawn(i));
    place(*masses_[i], drawn(i));
    if (plan_.body) turn(*masses_[i], frame.body.orientation);
    // Masses at one position are drawn as one: two skins at one position flicker.
    bool hidden = !massModels_[i].empty() || (i == 0 && !frame.cursorShown);
    for (std::size_t k = 0; k < i; ++k)
      hidden = hidden || (isFinite(frame.masses[i]) && plan_.massRadius[k] >= plan_.massRadius[i] &&
                          norm(drawn(i) - drawn(k)) < 0.12 * plan_.massRadius[k]);
    masses_[i]->SetVisibility(!hidden);
  }
}

void ObjectActors::showHands(const SceneFrame& frame) {
  const auto own = static_cast<std::size_t>(plan_.ownHand);
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    const bool shown = i < frame.hands.size() && frame.hands[i] && isFinite(*frame.hands[i]);
    if (shown) place(*hands_[i], *frame.hands[i]);
    if (i != own) hands_[i]->SetVisibility(shown);
  }
  if (frame.handValid == handWasValid_) return;
  handWasValid_ = frame.handValid;
  const widgets::Colour c = frame.handValid ? plan_.colours.hand : widgets::colours::kHandLost;
  hands_[own]->GetProperty()->SetColor(c.red, c.green, c.blue);
}

void ObjectActors::showSprings(const SceneFrame& frame) {
  const std::size_t count = std::min(frame.masses.size(), masses_.size());
  const auto drawn = [&](std::size_t i) { return drawnPlace(plan_, frame, i); };
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const SpringPlan& spring = plan_.springs[i];
    const auto to = static_cast<std::size_t>(spring.to), hand = static_cast<std::size_t>(spring.hand);
    if (to >= count || spring.from >= static_cast<int>(count)) continue;
    const bool fromHand = spring.from < 0;
    if (fromHand && (hand >= frame.hands.size() || !frame.hands[hand] || !isFinite(*frame.hands[hand]))) {
      if (spring.hand != plan_.ownHand) springs_[i]->VisibilityOff();
      continue;
    }
    const Vec3 from = fromHand ? *frame.hands[hand] : drawn(static_cast<std::size_t>(spring.from));
    if (!isFinite(from) || !isFinite(drawn(to))) continue;
    // From surface to surface of the bodies at its ends.
    const Vec3 way = drawn(to) - from;
    const double length = norm(way), first = fromHand ? plan_.handRadius : plan_.massRadius[static_cast<std::size_t>(spring.from)],
                 second = plan_.body ? 0 : plan_.massRadius[to], coil = (spring.coupling ? 0.010 : 0.016) * plan_.unit;
    const Vec3 unit = length > first + second ? way / length : Vec3{};
    stretch(*springs_[i], from + first * unit, length > first + second ? drawn(to) - second * unit : from, coil,
            (spring.coupling ? 0.0016 : 0.0026) * plan_.unit);
  }
}

}  // namespace reachlab::gui::scene
