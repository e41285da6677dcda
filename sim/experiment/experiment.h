#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/fault.h"
#include "constraints/constraint_spec.h"
#include "sim/experiment/cursor.h"
#include "sim/experiment/environment.h"
#include "sim/experiment/object.h"
#include "sim/experiment/task.h"
#include "sim/experiment/velocity_estimator_spec.h"

namespace reachlab::experiment {

/// Two-link planar arm for criterion 2 (docs/theory/criteria.md, "Minimum torque change"). Unverified defaults, after Uno 1989.
struct Arm {
  std::array<double, 2> length{0.25, 0.35};     // [m]
  std::array<double, 2> centre{0.11, 0.15};     // [m] from the proximal joint
  std::array<double, 2> mass{0.9, 1.1};         // [kg]
  std::array<double, 2> inertia{0.065, 0.100};  // [kg m^2] about the proximal joint
  std::array<double, 2> damping{0.08, 0.08};    // [N m s/rad]
  std::array<double, 2> shoulder{0.0, -0.45};   // [m] of the shoulder in the horizontal plane: world x to the right, -z forward
  bool elbowLeft = false;                       // which of the two postures
  bool operator==(const Arm&) const = default;
};

/// The content of the subject's screen. It is stored with the experiment because it is part of the task.
struct SubjectScreen {
  bool semaphore = true, target = true, masses = true, words = true;
  bool score = false;       // trials of the run that succeeded
  bool photodiode = false;  // a square in the lower left corner, white from the go signal to the trial's end: for a light sensor
  bool operator==(const SubjectScreen&) const = default;
};

/// One experiment file, validated: object, constraint, coupling and task. SI units throughout.
struct Experiment {
  int schemaVersion = 1;
  std::string name;
  constraints::ConstraintSpec constraint;
  Object object;
  std::optional<Coupling> coupling;  // required, but not for parallel and none
  std::vector<Hand> hands;           // empty: one hand, by `coupling` or a parallel object's own springs
  std::optional<Task> task;
  Environment environment;           // forces on the hand itself
  std::optional<Cursor> cursor;      // only without an object; nullopt: the hand is seen where it is
  std::string method = "auto";       // auto | rk4 | exact | abm | adaptive | stiff
  double handMass = 0;               // [kg] predictions only
  std::optional<double> forceLimit;  // [N] of the device; nullopt: the device's own
  bool forceLimitEndsTrial = false;
  TimingLimits timing;
  VelocityEstimatorSpec velocityEstimator;
  Arm arm;
  SubjectScreen subjectScreen;
  std::string text;  // the file as read: goes into the recording unchanged
  bool operator==(const Experiment&) const = default;
};

/// Reads an experiment file, or a shipped one by name. Throws FaultError with every fault, one per line,
/// `FILE:LINE:COLUMN: KEY: what is wrong; allowed: …`.
Experiment readExperiment(const std::string& fileOrName);
/// The same from text. `file` is only named in messages.
/// `definition`: the text of the constraint's definition, for recorded runs. If it is empty, the definition is looked up by its name.
Experiment parseExperiment(const std::string& text, const std::string& file, const std::string& definition = {});
/// The text of the definition that the experiment names, with formula, shape and domain. Empty if the formula is typed or the object is
/// free. Throws FaultError when there is no such definition.
std::string definitionTextOf(const Experiment& experiment);
/// The experiment as a file that reads back equal (for saving from the window, and for the log).
std::string toJson(const Experiment& experiment);

}  // namespace reachlab::experiment
