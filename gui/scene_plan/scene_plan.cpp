#include "gui/scene_plan/scene_plan.h"

#include <algorithm>
#include <cmath>

#include "constraints/constraint.h"
#include "constraints/geometry/task_path.h"
#include "gui/scene_plan/hand_colours.h"
#include "gui/widgets/colours.h"
#include "sim/experiment/experiment.h"
#include "sim/trial/protocol.h"

namespace reachlab::gui::scene {
namespace {

Vec3 placeOrOrigin(const constraints::Constraint& constraint, const std::vector<double>& q) {
  const Vec3 r = constraints::placeOn(constraint, q);
  return isFinite(r) ? r : Vec3{};
}

constexpr double kSamePlace = 1e-9;  // [m]

// Looks at the broadest side of the box, a little from above and from the right.
Vec3 viewDirection(const Box& box, constraints::ConstraintKind kind) {
  const Vec3 extent = box.high - box.low;
  if (kind == constraints::ConstraintKind::Surface)
    return extent.z < 0.35 * std::max(extent.x, extent.y) ? Vec3{0.45, -0.9, 1.1} : Vec3{0.6, 0.55, 1};
  const double thin = 0.02 * box.diagonal();
  if (extent.x <= thin && extent.z > thin) return {1, 0.22, 0.3};  // lies in the y-z plane
  if (extent.y <= thin && extent.z > thin) return {0.1, 1, 0.55};  // in the x-z plane
  if (extent.z <= thin) return {0.06, 0.18, 1};
  return {0.55, 0.45, 1};
}

std::vector<double> radiiOf(const std::vector<double>& masses, double unit) {
  double heaviest = 0;
  for (const double m : masses) heaviest = std::max(heaviest, m);
  const double most = (masses.size() > 12 ? 0.022 : 0.034) * unit;
  std::vector<double> radii;
  for (const double m : masses) radii.push_back(heaviest > 0 ? most * std::clamp(std::cbrt(m / heaviest), 0.45, 1.0) : most);
  return radii;
}

bool isSideBySide(const experiment::Object& object, ViewOptions::SideBySide wish) {
  if (object.masses.size() < 2 || wish == ViewOptions::SideBySide::Never) return false;
  return wish == ViewOptions::SideBySide::Always || object.kind == experiment::ObjectKind::Parallel;
}

// What each hand holds.
void planHands(const experiment::Experiment& experiment, int masses, ScenePlan& plan) {
  const bool parallel = experiment.object.kind == experiment::ObjectKind::Parallel;
  const auto toAll = [&](int hand) {
    for (int i = 0; i < masses; ++i) plan.springs.push_back({-1, i, hand, false});
  };
  if (experiment.hands.empty()) {
    if (parallel) toAll(0);
    else if (experiment.coupling) plan.springs.push_back({-1, 0, 0, true});
    return;
  }
  for (std::size_t hand = 0; hand < experiment.hands.size(); ++hand) {
    plan.hands.push_back(widgets::themed(handColour(hand)));
    const int mass = experiment.hands[hand].mass;
    if (parallel && mass == 0) toAll(static_cast<int>(hand));
    else plan.springs.push_back({-1, std::clamp(mass - 1, 0, masses - 1), static_cast<int>(hand), true});
  }
}

void planMasses(const experiment::Experiment& experiment, constraints::ConstraintKind kind, ViewOptions::SideBySide wish, ScenePlan& plan) {
  const experiment::Object& object = experiment.object;
  // Without an object the hand, or its cursor, is drawn as a mass.
  const std::vector<double> drawn = object.kind == experiment::ObjectKind::None ? std::vector<double>{1} : object.masses;
  const std::size_t count = drawn.size();
  plan.massRadius = radiiOf(drawn, std::max(plan.unit, 0.6 * plan.size));
  plan.massShift.assign(count, Vec3{});
  if (count == 0) return;
  const bool shifted = isSideBySide(object, wish);
  if (!shifted)  // where all coincide the driven one would hide the rest
    for (std::size_t i = 1; i + 1 < count; ++i) plan.massRadius[i] *= 0.72;
  if (shifted) {
    const Vec3 across = kind == constraints::ConstraintKind::Curve && std::abs(plan.target.y - plan.start.y) < 0.7 * plan.unit
                            ? Vec3{0, -1, 0}
                            : Vec3{0.7, -0.7, 0};
    const double step = std::min(0.22, 0.5 / static_cast<double>(count)) * plan.unit;
    const double middle = object.kind == experiment::ObjectKind::Parallel ? 0.5 * static_cast<double>(count - 1) : 0.0;
    for (std::size_t i = 0; i < count; ++i) plan.massShift[i] = ((static_cast<double>(i) - middle) * step) * across;
  }
  const int last = static_cast<int>(count);
  planHands(experiment, last, plan);
  if (object.kind == experiment::ObjectKind::Chain)
    for (int i = 1; i < last; ++i) plan.springs.push_back({i - 1, i, 0, false});
}

struct Part {
  const char* name;
  widgets::Colour PartColours::*colour;
  widgets::Colour usual;
};

constexpr Part kSceneParts[] = {{"background_top", &PartColours::backgroundTop, widgets::colours::kSkyTop},
                                {"background_bottom", &PartColours::backgroundBottom, widgets::colours::kSkyBottom},
                                {"rail", &PartColours::rail, widgets::colours::kRail},
                                {"surface", &PartColours::surface, widgets::colours::kSurface},
                                {"surface_line", &PartColours::surfaceLine, widgets::colours::kSurfaceLine},
                                {"start", &PartColours::start, widgets::colours::kStart},
                                {"target", &PartColours::target, widgets::colours::kTarget},
                                {"driven", &PartColours::driven, widgets::colours::kDriven},
                                {"middle", &PartColours::middle, widgets::colours::kMiddle},
                                {"last", &PartColours::last, widgets::colours::kLast},
                                {"hand", &PartColours::hand, widgets::colours::kHand},
                                {"spring", &PartColours::spring, widgets::colours::kSpring},
                                {"coupling", &PartColours::coupling, widgets::colours::kCoupling},
                                {"force", &PartColours::force, widgets::colours::kRed},
                                {"trace", &PartColours::trace, widgets::colours::kTrace}};

PartColours coloursOf(const experiment::SceneLook& look) {
  PartColours colours;
  for (const Part& part : kSceneParts) {
    const auto own = look.colours.find(part.name);
    colours.*part.colour = own == look.colours.end() ? widgets::themed(part.usual) : widgets::colourOf(own->second);
  }
  return colours;
}

// Some hundreds of the constraint's points, and the task's places with the shifts of their masses.
std::vector<Vec3> pointsSeen(const ScenePlan& plan, const std::vector<Vec3>& blockPlaces) {
  std::vector<Vec3> seen;
  const std::size_t skip = 1 + plan.curve.pointCount() / 400;
  for (const auto& piece : plan.curve.pieces) {
    for (std::size_t i = 0; i < piece.size(); i += skip) seen.push_back(piece[i]);
    seen.push_back(piece.back());
  }
  const std::size_t skipQuads = 1 + plan.surface.quads.size() / 800;
  for (std::size_t i = 0; i < plan.surface.quads.size(); i += skipQuads) seen.push_back(plan.surface.points[plan.surface.quads[i][0]]);
  if (plan.hasTask)
    for (const Vec3& place : blockPlaces.empty() ? std::vector<Vec3>{plan.start, plan.target} : blockPlaces) {
      seen.push_back(place);
      for (const Vec3& shift : plan.massShift) seen.push_back(place + shift);
    }
  seen.insert(seen.end(), plan.via.begin(), plan.via.end());
  if (seen.empty()) seen = {plan.box.centre() - Vec3{0.5 * plan.size, 0, 0}, plan.box.centre() + Vec3{0.5 * plan.size, 0, 0}};
  return seen;
}

}  // namespace

const widgets::Colour* partNamed(const PartColours& colours, const std::string& name) {
  for (const Part& part : kSceneParts)
    if (name == part.name) return &(colours.*part.colour);
  return nullptr;
}

ScenePlan planScene(const experiment::Experiment& experiment, const constraints::Constraint& constraint, const ViewOptions& options) {
  ScenePlan plan;
  plan.body = experiment.object.kind == experiment::ObjectKind::Body;
  const std::vector<double> none;
  const auto& from = experiment.task ? experiment.task->start : none;
  const auto& to = experiment.task ? experiment.task->target : none;
  Box box;
  if (constraint.kind != constraints::ConstraintKind::Free) {
    const bool curve = constraint.kind == constraints::ConstraintKind::Curve;
    const auto domain = drawnDomain(constraint, from, to);
    if (curve) plan.curve = sampleCurve(constraint.curve, domain[0].lo, domain[0].hi);
    else plan.surface = sampleSurface(constraint.surface, domain);
    plan.places = markPlaces(constraint, domain, from);
    box = curve ? boxOf(plan.curve) : boxOf(plan.surface);
  }
  if (experiment.task) {
    plan.hasTask = true;
    plan.start = placeOrOrigin(constraint, from);
    plan.target = placeOrOrigin(constraint, to);
    plan.tolerance = experiment.task->tolerance.position;
    plan.via = experiment.task->via;
    plan.viaRadius = experiment.task->viaRadius;
    for (const Vec3& place : plan.via) box.add(place);
    box.add(plan.start);
    box.add(plan.target);
  }
  for (const Vec3& place : options.blockPlaces) {
    box.add(place);
    if (norm(place - plan.start) > kSamePlace && norm(place - plan.target) > kSamePlace) plan.otherPlaces.push_back(place);
  }
  if (!box.valid() || box.diagonal() <= 0) box.add({-0.1, -0.05, 0}), box.add({0.1, 0.05, 0});
  plan.size = box.diagonal();
  const double reach = norm(plan.target - plan.start);
  plan.unit = plan.hasTask && reach > 0.3 * plan.size ? reach : std::max(0.5 * plan.size, reach);
  plan.viewFrom = viewDirection(box, constraint.kind);
  plan.bareHand = experiment.object.kind == experiment::ObjectKind::None;
  plan.cursor = experiment.cursor;
  if (plan.bareHand && plan.hasTask)  // onto the plane, with the subject's right to the right
    plan.viewFrom = experiment.task->plane == experiment::TaskPlane::Frontal ? Vec3{0, 0.18, 1} : Vec3{0, 1, 0.55};
  if (options.forces) plan.forces = markForces(experiment, plan.start, plan.target);
  plan.handRadius = 0.016 * plan.unit;
  plan.markRadius = 0.014 * plan.unit;
  plan.railRadius = std::max(0.0045 * plan.unit, 0.0028 * plan.size);
  planMasses(experiment, constraint.kind, options.sideBySide, plan);
  plan.look = experiment::lookOf(experiment);
  plan.colours = coloursOf(plan.look);
  plan.ownHand = std::clamp(options.ownHand, 0, std::max(static_cast<int>(plan.hands.size()) - 1, 0));
  if (!plan.hands.empty() && !plan.look.colours.contains("hand")) plan.colours.hand = plan.hands.at(static_cast<std::size_t>(plan.ownHand));
  plan.box = box;
  plan.seen = pointsSeen(plan, options.blockPlaces);
  plan.floor = box.low.y;
  for (const Vec3& point : plan.seen) plan.floor = std::min(plan.floor, point.y);
  plan.floor -= 0.12 * plan.size;
  return plan;
}

ScenePlan subjectsPlan(ScenePlan plan, const experiment::SubjectScreen& screen) {
  plan.targetShown = screen.target;
  plan.forces = {};
  plan.otherPlaces.clear();
  plan.handShown = !plan.bareHand;
  if (!screen.masses && !plan.bareHand) {
    plan.massRadius.clear();
    plan.massShift.clear();
    plan.springs.clear();
  }
  return plan;
}

bool isCursorShown(const ScenePlan& plan, trial::Phase phase) {
  if (!plan.cursor || plan.handShown || plan.cursor->show == experiment::CursorShow::Always) return true;
  return plan.cursor->show == experiment::CursorShow::MovementEnd && !trial::isEngaged(phase);
}

SceneFrame restingFrame(const ScenePlan& plan) {
  SceneFrame frame;
  frame.hands.assign(std::max<std::size_t>(plan.hands.size(), 1), plan.start);
  frame.ownHand = plan.ownHand;
  frame.masses.assign(plan.massRadius.size(), plan.start);
  frame.cursorShown = isCursorShown(plan, trial::Phase::Idle);
  return frame;
}

void copyToFrame(const haptics::TickState& state, SceneFrame& frame) {
  const auto own = static_cast<std::size_t>(frame.ownHand), count = static_cast<std::size_t>(state.handCount);
  frame.hands.assign(std::max(frame.hands.size(), own + count), std::nullopt);
  for (std::size_t i = 0; i < count; ++i) frame.hands[own + i] = state.hands[i].hip.position;
  frame.handValid = state.hands[0].hip.valid;
  frame.force = state.hands[0].feedbackForce;
  frame.trial = state.trial;
  frame.viaPassed = state.viaPassed;
  frame.traced = state.phase == trial::Phase::Armed || state.phase == trial::Phase::Moving;
  frame.body = state.body;
  frame.masses.resize(static_cast<std::size_t>(state.massCount));
  for (std::size_t i = 0; i < frame.masses.size(); ++i) frame.masses[i] = state.masses[i].r;
}

bool movedBeyond(double distance, const SceneFrame& from, const SceneFrame& to) {
  const auto apart = [&](const Vec3& a, const Vec3& b) { return !(norm(a - b) <= distance); };
  if (from.handValid != to.handValid || from.cursorShown != to.cursorShown || from.viaPassed != to.viaPassed ||
      from.masses.size() != to.masses.size() || from.hands.size() != to.hands.size())
    return true;
  for (std::size_t i = 0; i < from.hands.size(); ++i)
    if (from.hands[i].has_value() != to.hands[i].has_value() || (from.hands[i] && apart(*from.hands[i], *to.hands[i]))) return true;
  for (std::size_t i = 0; i < from.masses.size(); ++i)
    if (apart(from.masses[i], to.masses[i])) return true;
  if (!(norm(from.force - to.force) <= 0.05)) return true;
  for (std::size_t i = 0; i < 4; ++i)
    if (!(std::abs(from.body.orientation[i] - to.body.orientation[i]) <= 1e-3)) return true;
  return false;
}

int massesAtOnePlace(const ScenePlan& plan, const SceneFrame& frame) {
  const std::size_t count = std::min(frame.masses.size(), plan.massRadius.size());
  if (count < 2) return 0;
  for (std::size_t i = 1; i < count; ++i)
    if (!(norm(drawnPlace(plan, frame, i) - drawnPlace(plan, frame, 0)) < 0.5 * plan.massRadius[i])) return 0;
  return static_cast<int>(count);
}

}  // namespace reachlab::gui::scene
