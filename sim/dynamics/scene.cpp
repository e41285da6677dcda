#include "sim/dynamics/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "constraints/constraint.h"
#include "constraints/geometry/task_path.h"
#include "constraints/regularity/analysis.h"
#include "constraints/regularity/narrow.h"
#include "constraints/regularity/period.h"
#include "constraints/regularity/places.h"
#include "constraints/regularity/rounding.h"
#include "constraints/regularity/surface_branches.h"
#include "sim/dynamics/choose_method.h"
#include "sim/dynamics/compile.h"
#include "sim/dynamics/hand_alone.h"
#include "sim/dynamics/rk4_error.h"
#include "sim/dynamics/shared_plant.h"
#include "sim/dynamics/systems/curve_places.h"
#include "sim/dynamics/systems/quadric.h"
#include "sim/experiment/checked_experiment.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment.h"

namespace reachlab::dynamics {

namespace {

constexpr double kHardSpeedRatio = 0.2;  // smallest to largest |r_phi| below which a curve is hard somewhere

bool isLinear(const constraints::Constraint& constraint, const ObjectModel& model) {
  if (model.kind == experiment::ObjectKind::Body) return false;
  return constraint.kind == constraints::ConstraintKind::Free ||
         (constraint.kind == constraints::ConstraintKind::Curve && constraint.straight);
}

struct SpeedRange {
  double least = 0, most = 0;  // [m] |r_phi|; the largest counts only up to kSteep times the typical one
};
/// On the piece that holds the start, over 2 pi about it where it has no end; a dip between samples is followed to its bottom.
SpeedRange findSpeedRange(const constraints::Constraint& constraint, const constraints::CurvePiece& piece, double start) {
  const constraints::Domain d = constraints::boundedDomain(constraint)[0];
  constexpr int kSamples = 1440;
  constexpr double kSteep = 8;
  SpeedRange range{1e300, 0};
  std::vector<double> speeds;
  const bool broken = piece.lo > constraint.domain[0].lo || piece.hi < constraint.domain[0].hi;
  const auto speedAt = [&](double phi) { return norm(evaluate(piece.curve, phi).rPhi); };
  for (const double centre : {0.5 * (d.lo + d.hi), start}) {
    double before = 1e300, last = 1e300;
    const double from = std::fmax(centre - 0.5 * (d.hi - d.lo), piece.lo), to = std::fmin(centre + 0.5 * (d.hi - d.lo), piece.hi);
    if (broken && !(from < to)) continue;
    const auto phiAt = [&](double k) {
      if (broken) return from + (to - from) * ((k + 0.5) / (kSamples + 1));  // not its very ends, where |r_phi| may have no bound
      return std::fmin(std::fmax(centre + (d.hi - d.lo) * (k / kSamples - 0.5), constraint.domain[0].lo), constraint.domain[0].hi);
    };
    for (int i = 0; i <= kSamples; ++i) {
      const double speed = speedAt(phiAt(i));
      if (!std::isfinite(speed)) continue;
      speeds.push_back(speed);
      range.least = std::min(range.least, speed);
      range.most = std::max(range.most, speed);
      if (last < before && last <= speed) {
        double lo = i - 2, hi = i;
        for (int round = 0; round < 60; ++round) {
          const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
          const double atA = speedAt(phiAt(a)), atB = speedAt(phiAt(b));
          (atA < atB ? hi : lo) = atA < atB ? b : a;
        }
        range.least = std::min(range.least, speedAt(phiAt(lo)));
      }
      before = last;
      last = speed;
    }
  }
  if (speeds.empty()) return {0, 0};
  range.most = std::min(range.most, std::max(kSteep * constraints::narrow::median(speeds), norm(evaluate(piece.curve, start).rPhi)));
  return range;
}

/// True if an end of the domain is an edge of the surface: not a period's seam, and not a line that is one point (a pole).
bool hasEdges(const constraints::Constraint& c) {
  for (int k = 0; k < 2; ++k) {
    const constraints::Domain& d = c.domain[k];
    if (d.periodic) continue;
    for (const double end : {d.lo, d.hi}) {
      if (!std::isfinite(end)) continue;
      const constraints::Domain other = constraints::boundedDomain(c)[1 - k];
      const double along = other.lo + 0.37 * (other.hi - other.lo);
      const constraints::SurfacePoint p =
          k == 0 ? constraints::evaluate(c.surface, end, along) : constraints::evaluate(c.surface, along, end);
      const double still = norm(k == 0 ? p.rV : p.rU), moving = norm(k == 0 ? p.rU : p.rV);
      if (still > 1e-9 * moving) return true;
    }
  }
  return false;
}

bool isStill(constraints::PlaceKind kind) {
  return kind == constraints::PlaceKind::Cusp || kind == constraints::PlaceKind::Fold || kind == constraints::PlaceKind::Standstill;
}

void requireValue(const constraints::Curve& curve, double start) {
  const constraints::CurvePoint p = evaluate(curve, start);
  if (!isFinite(p.r) || !isFinite(p.rPhi))
    throw RefusedError(
        fmt::format("the curve has no place for a mass at the start phi = {}: it has no finite value there; choose another start", start));
}

const constraints::CurvePiece& startPiece(const constraints::CurveRegularity& regularity, double start) {
  const int piece = regularity.pieceAt(start);
  if (piece >= 0) return regularity.pieces[piece];
  if (regularity.pieces.empty() && regularity.places.empty())
    throw RefusedError(
        fmt::format("where the curve is smooth about the start phi = {} could not be decided: the formula has no value there, or "
                    "breaks off too often; choose another start, or a simpler formula",
                    start));
  std::string near;
  double nearest = 1e300;
  for (const constraints::Place& place : regularity.places)
    if (std::abs(place.at - start) < nearest) {
      nearest = std::abs(place.at - start);
      near = "; near it: " + describe(place, constraints::ConstraintKind::Curve);
    }
  throw RefusedError(fmt::format("the curve has no place for a mass at the start phi = {}{}; choose another start", start, near));
}

void requireStart(const constraints::Constraint& c, const std::vector<double>& start) {
  const std::size_t wanted = c.kind == constraints::ConstraintKind::Free ? 3 : static_cast<std::size_t>(c.parameterCount());
  if (start.size() != wanted) throw RefusedError(fmt::format("the start has {} numbers where the constraint has {}", start.size(), wanted));
  for (std::size_t k = 0; k < start.size(); ++k) {
    if (!std::isfinite(start[k])) throw RefusedError("the start is not finite");
    if (c.kind != constraints::ConstraintKind::Free && !c.domain[k].has(start[k]))
      throw RefusedError(
          fmt::format("the start {} lies outside the constraint's domain, {} to {}", start[k], c.domain[k].lo, c.domain[k].hi));
  }
}

/// A formula whose own rounding moves a mass (large numbers that cancel) is told so: what is computed would be noise.
void requireDigits(const constraints::Constraint& c, const std::vector<double>& start) {
  constexpr double kShown = 1e-9, kOfPlace = 1e-13;  // [m], and of |r| for a formula that lies far away
  constexpr int kAcross = 5;
  std::vector<double> excess;
  double rounding = 0;
  const auto look = [&](double first, double second) {
    const Vec3 r = c.kind == constraints::ConstraintKind::Curve ? evaluate(c.curve, first).r : evaluate(c.surface, first, second).r;
    if (!isFinite(r)) return;
    const double off = constraints::computeRounding(c, first, second);
    excess.push_back(off / (kShown + kOfPlace * norm(r)));
    rounding = std::max(rounding, off);
  };
  for (int i = 0; i < kAcross * kAcross; ++i) {
    if (c.kind == constraints::ConstraintKind::Curve) look(start[0] + 0.25 * (i - kAcross * kAcross / 2), 0);
    else look(start[0] + 0.25 * (i % kAcross - kAcross / 2), start[1] + 0.25 * (i / kAcross - kAcross / 2));
  }
  if (!excess.empty() && constraints::narrow::median(excess) > 1)
    throw RefusedError(
        fmt::format("the formula loses its digits: roundings inside it move the mass by {:.2g} m about the start, for large "
                    "numbers cancel in it; write it so that they do not arise",
                    rounding));
}

/// Each tick rounds phi once.
void requireNearZero(const constraints::Constraint& c, const constraints::Curve& curve, double start) {
  if (!(std::isfinite(c.domain[0].lo) && std::isfinite(c.domain[0].hi) && !c.domain[0].periodic) && constraints::findPeriod(c).turn > 0)
    return;
  const constraints::CurvePoint p = evaluate(curve, start);
  if (roundingOfPhi(p, start) > allowedRounding(p))
    throw RefusedError(
        fmt::format("the start phi = {} is so far from 0 that a rounding of phi moves the mass by {:.2g} m, in every tick; "
                    "shift the formula's phi, or choose a start nearer 0",
                    start, roundingOfPhi(p, start)));
}

/// Warns of a start so far from the origin that the last digit of a position is more than what is stated.
void warnOfFarStart(Scene& scene, const std::vector<double>& start) {
  constexpr double kShown = 1e-9;  // [m]
  const Vec3 r = placeOn(*scene.constraint, start);
  if (const double digit = 0x1p-52 * norm(r); digit > kShown)
    scene.choice.warnings.push_back(fmt::format(
        "the start lies {:.2g} m from the origin, where the last digit of a position is {:.2g} m; shift the constraint to the origin",
        norm(r), digit));
}

/// The modes' estimate knows nothing of a curve's or a surface's bends: where there is a task its reach is measured.
void estimateRk4(Scene& scene, const experiment::Experiment& experiment, double step) {
  constexpr double kAccurate = 1e-6;  // [m] a predicted error above it is worth a warning
  MethodChoice& choice = scene.choice;
  if (experiment.task)
    if (const auto measured = measureRk4Error(*scene.plant, *experiment.task, *scene.constraint, step)) choice.predictedError = *measured;
  if (choice.predictedError > kAccurate)
    choice.warnings.push_back(fmt::format(
        "rk4 is stable but not accurate here: fastest mode times step {:.3g}, predicted error {:.2g} m; use method auto, or a smaller step",
        choice.fastestMode * step, choice.predictedError));
}

// Several hands are computed by one method, for whatever they hold.
std::string methodFor(const experiment::Experiment& experiment, const SceneOptions& options) {
  const std::string asked = options.method.empty() ? experiment.method : options.method;
  if (experiment.hands.empty()) return asked;
  if (asked != "auto" && asked != "rk4")
    throw RefusedError(fmt::format("method {} is for one hand; several hands are computed by rk4: use auto or rk4", asked));
  return "rk4";
}

/// RK4 in phi holds where the curve is smooth and moves on evenly: what one hand has other methods for is refused.
void requireSharedCurve(const constraints::CurveRegularity& regularity, double speedRatio) {
  constexpr double kEvenly = 0.01;  // of the smallest to the largest |r_phi|
  for (const constraints::Place& place : regularity.places)
    if (isStill(place.kind))
      throw RefusedError(fmt::format("several hands are computed by rk4 in phi, which fails at a {}; use one hand, or a curve without",
                                     describe(place, constraints::ConstraintKind::Curve)));
  if (!regularity.whole) throw RefusedError("several hands need a curve that is smooth throughout; on this one use one hand");
  if (speedRatio < kEvenly)
    throw RefusedError(
        fmt::format("several hands are computed by rk4 in phi, and on this curve |r_phi| falls to {:.2g} of its largest "
                    "(a cusp, or nearly one); use one hand, or a curve where it stays above {}",
                    speedRatio, kEvenly));
}

// What one step a tick errs is measured with each hand alone, along the reach.
void estimateShared(Scene& scene, experiment::Experiment experiment, double step) {
  if (!experiment.task) return;
  std::optional<double> most;
  for (const experiment::Hand& hand : std::vector(experiment.hands)) {
    experiment.hands.assign(1, hand);
    const auto alone = makeSharedPlant(experiment, *scene.constraint);
    if (const auto measured = measureRk4Error(*alone, *experiment.task, *scene.constraint, step))
      most = std::max(most.value_or(0), *measured);
  }
  scene.choice.predictedError = most.value_or(scene.choice.predictedError);
  constexpr double kAccurate = 1e-6, kUseless = 1e-4;  // [m]
  if (scene.choice.predictedError > kUseless)
    throw RefusedError(
        fmt::format("several hands are computed by rk4, one step a tick, which errs by {:.2g} m here; use one hand, or a "
                    "softer object or coupling",
                    scene.choice.predictedError));
  if (scene.choice.predictedError > kAccurate)
    scene.choice.warnings.push_back(
        fmt::format("several hands are computed by rk4, one step a tick: predicted error {:.2g} m", scene.choice.predictedError));
}

void compileShared(Scene& scene, const experiment::Experiment& experiment, double step) {
  auto plant = makeSharedPlant(experiment, *scene.constraint);
  scene.shared = plant.get();
  scene.plant = std::move(plant);
  scene.choice.form = fmt::format("{} hands, {} states", experiment.hands.size(), scene.shared->placeCount() + scene.shared->rateCount());
  scene.choice.reason = "several hands hold the object: rk4, one step a tick; " + scene.choice.reason;
  estimateShared(scene, experiment, step);
}

/// What is known of a curve about the start.
struct CurveFacts {
  std::shared_ptr<const constraints::CurveRegularity> regularity;
  CurveForm form;
  double speedRatio = 1;  // smallest to largest |r_phi|
};

CurveFacts examineCurve(const experiment::Experiment& experiment, const constraints::Constraint& constraint, double start) {
  CurveFacts facts;
  facts.regularity = std::make_shared<const constraints::CurveRegularity>(constraints::computeRegularity(constraint, start));
  const constraints::CurvePiece& piece = startPiece(*facts.regularity, start);
  requireValue(piece.curve, start);
  if (experiment.task) requireNearZero(constraint, piece.curve, start);
  const SpeedRange speeds = findSpeedRange(constraint, piece, start);
  facts.speedRatio = speeds.most > 0 ? speeds.least / speeds.most : 0;
  constexpr double kAhead = 0.1;  // [m] that a mass covers between two looks for the end of what was seen
  const double ahead = speeds.most > 0 ? kAhead / speeds.most : 0;
  facts.form = {facts.speedRatio < kHardSpeedRatio || !facts.regularity->whole, speeds.most, facts.regularity->seenLo + ahead,
                facts.regularity->seenHi - ahead};
  for (const constraints::Place& place : facts.regularity->places)
    if (experiment.task && isStill(place.kind) && std::abs(start - place.at) < 1e-9 * std::max(1.0, std::abs(place.at)))
      throw RefusedError(fmt::format("the start phi = {} is a {}: from rest there the mass could go either way; choose another start",
                                     start, nameOf(place.kind)));
  return facts;
}

/// Whether a straight line has ends that throw the masses back. Throws RefusedError where nothing can move along it.
bool hasElasticEnds(const constraints::Constraint& constraint, const LinearSpace& space, double start) {
  if (space.axes != 1) return false;
  requireValue(constraint.curve, start);
  if (!(norm(space.tangent) > 0)) throw RefusedError("the line has no length: nothing can move along it; give length_m > 0");
  return !space.domain.periodic && space.domain.atEnd == constraints::AtEnd::Bounce &&
         (std::isfinite(space.domain.lo) || std::isfinite(space.domain.hi));
}

void compileLinear(Scene& scene, const ObjectModel& model, const LinearSpace& space, double step, const MethodRequest& request) {
  scene.choice.form = fmt::format("{}, {} states", space.axes == 1 ? "line" : "free space", 2 * space.axes * model.count());
  if (scene.choice.method == "exact") scene.plant = makeExactPlant(model, space, step);
  else scene.plant = space.axes == 1 ? makeLinePlant(model, space, request) : makeFreePlant(model, request);
}

void compileOnCurve(Scene& scene, const ObjectModel& model, const CurveFacts& facts, const MethodRequest& request) {
  if (model.kind == experiment::ObjectKind::Body)
    throw RefusedError("a body moves in free space only; use point, chain or parallel on a curve");
  const int states = 2 * model.count();
  if (!facts.regularity->whole) {
    scene.choice.form = fmt::format("curve by {} smooth pieces (examined from phi = {:.6g} to {:.6g}), speed along it, {} states",
                                    facts.regularity->pieces.size(), facts.regularity->lo, facts.regularity->hi, states);
    scene.plant = makeBrokenCurvePlant(model, *scene.constraint, facts.regularity, facts.form.largestSpeed, request);
    return;
  }
  scene.choice.form = facts.form.tangential ? fmt::format("curve, speed along it (|r_phi| falls to {:.2g} of its largest), {} states",
                                                          facts.speedRatio, states)
                                            : fmt::format("curve in phi, {} states", states);
  scene.plant = makeCurvePlant(model, *scene.constraint, facts.form, request);
}

void compileOnSurface(Scene& scene, const ObjectModel& model, const std::array<double, 2>& start, const MethodRequest& request) {
  const constraints::Constraint& constraint = *scene.constraint;
  if (model.count() != 1 || model.kind == experiment::ObjectKind::Body)
    throw RefusedError("on a surface only a point moves; use a curve, or one mass");
  const auto branches = constraints::computeBranches(constraint);
  if (!isFinite(evaluate(constraint.surface, start[0], start[1]).r))
    throw RefusedError(fmt::format("the surface has no value at the start u = {}, v = {}; choose another start", start[0], start[1]));
  const auto quadric = branches->smooth() ? fitQuadric(constraint.surface, constraint.domain, start) : std::nullopt;
  if (quadric && provesQuadric(constraint, *quadric)) {
    scene.choice.form = "surface of second degree in world coordinates, 6 states";
    scene.plant = makeQuadricPlant(model, constraint, *quadric, hasEdges(constraint), request);
    return;
  }
  scene.choice.form = "surface in u and v, 4 states";
  if (!branches->smooth()) scene.choice.form += fmt::format(", smooth between {} lines", branches->lines.size());
  scene.plant = makeChartPlant(model, constraint, branches->smooth() ? nullptr : branches, request);
}

/// At an apex or a pinch point nothing tells where a mass goes, and every trial would end at once. At an end a pull beyond it ends the trial.
void requireContinuation(Scene& scene, const std::vector<double>& start, double step) {
  const auto stepWithPull = [&](const Vec3& pull) {
    scene.plant->placeAtRest(start);
    HandSegment held;
    held.position[0] = constraints::placeOn(*scene.constraint, start) + pull;
    return scene.plant->step(held, step);
  };
  const StepStatus status = stepWithPull({});
  if (status == StepStatus::NoContinuation || status == StepStatus::NotFinite || status == StepStatus::Capped)
    throw RefusedError(
        fmt::format("no motion can begin at the start [{}]: {}; choose another start", fmt::join(start, ", "), scene.plant->stopReason()));
  bool onEnd = false;
  for (int k = 0; k < scene.constraint->parameterCount(); ++k) {
    const constraints::Domain& domain = scene.constraint->domain[k];
    onEnd = onEnd || (!domain.periodic && (start[k] == domain.lo || start[k] == domain.hi));
  }
  if (!onEnd) return;
  constexpr double kPull = 1e-4;  // [m] of the hand
  for (const Vec3& pull :
       {Vec3{kPull, 0, 0}, Vec3{-kPull, 0, 0}, Vec3{0, kPull, 0}, Vec3{0, -kPull, 0}, Vec3{0, 0, kPull}, Vec3{0, 0, -kPull}})
    if (stepWithPull(pull) != StepStatus::Ok) {
      scene.choice.warnings.push_back("the start lies on an end of the constraint: a pull beyond it ends the trial");
      return;
    }
}

}  // namespace

Scene compileScene(const experiment::Experiment& experiment, const constraints::Constraint& constraint, const SceneOptions& options) {
  Scene scene;
  scene.constraint = std::make_shared<const constraints::Constraint>(constraint);
  if (experiment.object.kind == experiment::ObjectKind::None) {
    scene.choice.method = "exact";
    scene.choice.form = "the hand alone";
    scene.choice.reason = "there is no object, and nothing is integrated";
    scene.plant = makeHandAlone();
    if (experiment.task) scene.plant->placeAtRest(experiment.task->start);
    return scene;
  }
  const ObjectModel model = makeObjectModel(experiment);
  if (!(options.step > 0) || !std::isfinite(options.step))
    throw RefusedError(fmt::format("the step must be positive, not {} s", options.step));
  const std::vector<double> start =
      experiment.task ? experiment.task->start : std::vector<double>(constraint.kind == constraints::ConstraintKind::Free ? 3 : 2, 0.0);
  if (experiment.task) requireStart(constraint, start);

  const bool typed = constraint.name == "curve" || constraint.name == "surface";  // the catalogue's formulas are known
  if (experiment.task && typed) requireDigits(constraint, start);
  SceneFacts facts{.linear = isLinear(constraint, model), .step = options.step};
  if (experiment.task) facts.duration = experiment.task->duration;
  LinearSpace space;
  CurveFacts curve;
  if (facts.linear) {
    space = linearSpace(constraint);
    facts.elasticEnds = hasElasticEnds(constraint, space, start[0]);
  } else if (constraint.kind == constraints::ConstraintKind::Curve) {
    curve = examineCurve(experiment, constraint, start[0]);
    facts.hardCurve = curve.speedRatio < kHardSpeedRatio;
  }
  scene.choice = chooseMethod(methodFor(experiment, options), model, facts);
  const MethodRequest request{scene.choice.method, options.tolerance};

  if (!experiment.hands.empty()) {
    if (curve.regularity) requireSharedCurve(*curve.regularity, curve.speedRatio);
    compileShared(scene, experiment, options.step);
  } else if (facts.linear) {
    compileLinear(scene, model, space, options.step, request);
  } else if (constraint.kind == constraints::ConstraintKind::Free) {
    scene.choice.form = "rigid body, 13 states";
    scene.plant = makeBodyPlant(model, experiment.object, request);
  } else if (constraint.kind == constraints::ConstraintKind::Curve) {
    compileOnCurve(scene, model, curve, request);
  } else {
    compileOnSurface(scene, model, {start[0], start[1]}, request);
  }
  if (scene.choice.method == "rk4" && scene.shared == nullptr) estimateRk4(scene, experiment, options.step);
  if (experiment.task) {
    warnOfFarStart(scene, start);
    if (scene.shared == nullptr) requireContinuation(scene, start, options.step);
    scene.plant->placeAtRest(start);
  }
  return scene;
}

Scene compileScene(const experiment::CompiledExperiment& experiment, const SceneOptions& options) {
  return compileScene(experiment.experiment(), experiment.constraint(), options);
}

std::vector<Scene> compileScenes(std::span<const experiment::CompiledExperiment> experiments) {
  std::vector<Scene> scenes;
  for (const experiment::CompiledExperiment& one : experiments) {
    (void)experiment::requiredTask(one.experiment());
    scenes.push_back(compileScene(one));
  }
  return scenes;
}

Scene compileScene(const experiment::Experiment& experiment, const SceneOptions& options) {
  return compileScene(experiment, constraints::makeConstraint(experiment.constraint), options);
}

}  // namespace reachlab::dynamics
