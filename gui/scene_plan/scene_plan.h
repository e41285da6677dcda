#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gui/model/model.h"
#include "gui/scene_plan/constraint_mesh.h"
#include "gui/scene_plan/force_marks.h"
#include "gui/scene_plan/place_marks.h"
#include "gui/widgets/colours.h"
#include "sim/experiment/cursor.h"
#include "sim/experiment/experiment_fwd.h"
#include "sim/experiment/scene_look.h"
#include "sim/haptics/tick_state.h"

/// The drawn content of an experiment as plain data: sizes, positions and colours. Independent of any graphics library.
namespace reachlab::gui::scene {

struct SpringPlan {
  int from = -1, to = 0;  // masses from 0; -1: a hand
  int hand = 0;           // which, from 0
  bool coupling = false;  // the coupling (8): drawn thinner than the object's own springs
};

/// Colours of the scene's parts: the theme's colours, or the colours that the experiment sets.
struct PartColours {
  widgets::Colour backgroundTop, backgroundBottom, rail, surface, surfaceLine, start, target, driven, middle, last, hand, spring, coupling,
      force, trace;
};
/// The colour of the part that an experiment's `look` calls by this name. Null for an unknown name.
const widgets::Colour* partNamed(const PartColours& colours, const std::string& name);

struct ScenePlan {
  CurveMesh curve;
  SurfaceMesh surface;
  std::vector<PlaceMark> places;  // where the formula is not smooth
  Vec3 start, target;             // [m]
  bool hasTask = false;
  bool targetShown = true;
  std::vector<Vec3> via;           // [m] places to pass on the way
  double viaRadius = 0;            // [m]
  double tolerance = 0;            // [m] dx, drawn as a faint shell around the target
  double size = 0.2;               // [m] diagonal of what is seen
  double unit = 0.2;               // [m] what bodies are sized by
  Vec3 viewFrom{0.1, 0.35, 1};     // direction from the centre to the camera
  std::vector<Vec3> seen;          // [m] points that a view of the whole must hold
  std::vector<double> massRadius;  // [m]
  std::vector<Vec3> massShift;     // [m] added for the eye only
  std::vector<SpringPlan> springs;
  std::vector<widgets::Colour> hands;  // colours of several hands on one object; empty: one hand
  int ownHand = 0;                     // which of them the frame's own hand is
  bool body = false;                   // drawn as a box that turns
  bool bareHand = false;               // there is no object: the first mass is the hand or its cursor
  std::optional<experiment::Cursor> cursor;
  bool handShown = true;                                  // by its pen
  double handRadius = 0, markRadius = 0, railRadius = 0;  // [m]
  experiment::SceneLook look;
  PartColours colours;
  Box box;                                    // [m] of constraint and task; the camera looks at its centre
  double floor = 0;                           // [m] height of the grid, below all of it
  ForceMarks forces;                          // on the hand
  std::vector<Vec3> otherPlaces;              // [m] of the block, neither start nor target of this trial; drawn faintly
  std::shared_ptr<const model::Model> model;  // scenery, and what stands for hand and masses; null: none
};

struct ViewOptions {
  enum class SideBySide { Auto, Always, Never };
  SideBySide sideBySide = SideBySide::Auto;  // Auto: parallel masses only, as in the paper's Fig. 7
  int ownHand = 0;                           // which of the experiment's hands is here, from 0
  bool forces = false;                       // the forces on the hand are drawn
  std::vector<Vec3> blockPlaces = {};        // [m] starts and targets of all trials of the block: every trial is seen from the same side
};

ScenePlan planScene(const experiment::Experiment& experiment, const constraints::Constraint& constraint, const ViewOptions& options = {});

/// The same without forces and other places, and without its masses and springs or its target where the screen has none. A bare hand has
/// no pen, so that a cursor looks like it.
ScenePlan subjectsPlan(ScenePlan plan, const experiment::SubjectScreen& screen);

/// One instant of the scene: positions that actors are moved to.
struct SceneFrame {
  std::vector<std::optional<Vec3>> hands{Vec3{}};  // [m] of each of the plan's hands, or of the only one; empty: not known
  int ownHand = 0;                                 // the index of the hand that is here; its place is always known
  std::vector<Vec3> masses;                        // [m] true places
  dynamics::BodyState body;
  bool handValid = true;    // the own hand's device delivers samples
  bool cursorShown = true;  // the first mass, where it is a cursor
  Vec3 force;               // [N] of the coupling on the own hand; zero where no arrow is drawn
  int viaPassed = 0;        // of the plan's
  std::int32_t trial = 0;   // a trace ends with its trial
  bool traced = false;      // the hand is under way
};
inline const Vec3& ownHand(const SceneFrame& frame) { return *frame.hands[static_cast<std::size_t>(frame.ownHand)]; }
inline Vec3& ownHand(SceneFrame& frame) { return *frame.hands[static_cast<std::size_t>(frame.ownHand)]; }
/// Where a mass of the frame is drawn. [m]
inline Vec3 drawnPlace(const ScenePlan& plan, const SceneFrame& frame, std::size_t mass) {
  return frame.masses[mass] + plan.massShift[mass];
}
/// Whether the plan's picture has its cursor in this phase of a trial. The experimenter always sees it.
bool isCursorShown(const ScenePlan& plan, trial::Phase phase);
/// At rest at the start.
SceneFrame restingFrame(const ScenePlan& plan);
/// The state's first hand becomes the hand of the frame. Further hands come from the state, and the rest is not known.
void copyToFrame(const haptics::TickState& state, SceneFrame& frame);
/// Whether the change is visible: a shift of more than that length [m], a turn of more than a thousandth, a drawn force that differs by
/// 0.05 N, a hand that was lost or found, a cursor that appeared or vanished, or a place that was passed.
bool movedBeyond(double distance, const SceneFrame& from, const SceneFrame& to);
/// The number of masses that hide behind the first: all of them if each is within half its radius of the first, else 0.
int massesAtOnePlace(const ScenePlan& plan, const SceneFrame& frame);

}  // namespace reachlab::gui::scene
