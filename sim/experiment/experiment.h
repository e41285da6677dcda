#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/fault.h"
#include "constraints/constraint.h"
#include "sim/experiment/subject_screen.h"

namespace reachlab::experiment {

inline constexpr int kMaxMasses = 512;
inline constexpr int kMaxHands = 8;  // on one object

enum class ObjectKind { Point, Chain, Parallel, Body };

/// The simulated object (paper sec. 3-5). Chain: N masses, N-1 springs, the hand drives mass 1. Parallel: N masses, each tied to the
/// hand by its own spring. Body: one mass with inertia, driven at an offset from its centre.
struct Object {
  ObjectKind kind = ObjectKind::Point;
  std::vector<double> masses;                      // [kg]
  std::vector<double> stiffness;                   // [N/m]
  std::vector<double> damping;                     // [N s/m], as many as stiffness
  double viscosity = 0;                            // [N s/m] lambda of Eq. (9), on every mass
  Vec3 gravity;                                    // [m/s^2]
  std::array<std::array<double, 3>, 3> inertia{};  // [kg m^2] body frame, body only
  Vec3 fpOffset;                                   // [m] body frame, body only
  bool operator==(const Object&) const = default;
};

/// How many springs the object has for its masses.
inline std::size_t springCount(const Object& object) {
  const bool parallel = object.kind == ObjectKind::Parallel;
  return object.masses.empty() ? 0 : object.masses.size() - (parallel ? 0 : 1);
}

/// Spring-damper between HIP and FP, Eq. (8).
struct Coupling {
  double stiffness = 0;  // [N/m]
  double damping = 0;    // [N s/m]
  bool operator==(const Coupling&) const = default;
};

/// One of several hands on one object, each coupled by Eq. (8) for itself: to one mass, or to every mass by a spring of its own.
struct Hand {
  int mass = 1;                            // from 1; 0: to all, and both lists have a number for each
  std::vector<double> stiffness, damping;  // [N/m], [N s/m]; one number where one mass is held
  Vec3 fpOffset;                           // [m] where it holds a body, body frame
  bool operator==(const Hand&) const = default;
};

struct Tolerance {
  double position = 0.012;  // [m]
  double velocity = 0.012;  // [m/s]
  double time = 0.5;        // [s]
  bool operator==(const Tolerance&) const = default;
};

/// What waiting at the start asks of the hand before a trial is armed: to stay there for so long, and slower than that.
struct StartRest {
  double seconds = 0.3;  // [s]
  double speed = 0.02;   // [m/s]
  bool operator==(const StartRest&) const = default;
};
inline constexpr StartRest kNoStartRest{0, 1000};  // armed on touching the start

struct Task {
  std::vector<double> start, target;  // constraint parameters; [m] (three) for a free object
  double duration = 1.35;             // [s] T
  Tolerance tolerance;
  double onset = 0.001;     // [m] t = 0 is when the HIP has moved this far
  double armRadius = 0.01;  // [m]
  double timeout = 10;      // [s] no onset by then: aborted
  StartRest rest;
  bool operator==(const Task&) const = default;
};

/// Two-link planar arm for criterion 2 (docs/theory/criteria.md, "Minimum torque change"); defaults unverified, after Uno 1989.
struct Arm {
  std::array<double, 2> length{0.25, 0.35};     // [m]
  std::array<double, 2> centre{0.11, 0.15};     // [m] from the proximal joint
  std::array<double, 2> mass{0.9, 1.1};         // [kg]
  std::array<double, 2> inertia{0.065, 0.100};  // [kg m^2] about the proximal joint
  std::array<double, 2> damping{0.08, 0.08};    // [N m s/rad]
  std::array<double, 2> shoulder{0.0, -0.45};   // [m] of the shoulder in the task plane: along the line, across it (chest side negative)
  bool elbowLeft = false;                       // which of the two postures
  bool operator==(const Arm&) const = default;
};

/// How v_HIP is estimated from device samples.
struct VelocityEstimatorSpec {
  std::string kind = "auto";  // auto | difference | butterworth | device
  double cutoff = 40;         // [Hz] butterworth
  bool operator==(const VelocityEstimatorSpec&) const = default;
};

/// How much time a movement may miss before its trial does not count (trial/protocol.h). The haptic loop counts in whole ticks of 1 ms.
struct TimingLimits {
  int maxMissedTicks = 5;
  double maxGap = 0.02;  // [s] between two ticks
  bool operator==(const TimingLimits&) const = default;
};
inline constexpr TimingLimits kNoTimingLimits{10'000'000, 7200};  // longer than any task may last

/// One experiment file, validated: what the subject holds, on what, and what is asked. SI units throughout.
struct Experiment {
  int schemaVersion = 1;
  std::string name;
  constraints::ConstraintSpec constraint;
  Object object;
  std::optional<Coupling> coupling;  // required, but none for parallel
  std::vector<Hand> hands;           // empty: one hand, by `coupling` or a parallel object's own springs
  std::optional<Task> task;
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

/// Reads an experiment file, or a shipped one by name. Throws FaultError with every fault, one a line,
/// `FILE:LINE:COLUMN: KEY: what is wrong; allowed: …`.
Experiment readExperiment(const std::string& fileOrName);
/// The same from text; `file` is only named in messages.
/// `definition`: the text of the definition that the experiment names, where it is not to be looked up (recorded runs); empty: looked up.
Experiment parseExperiment(const std::string& text, const std::string& file, const std::string& definition = {});
/// The text of the definition that the experiment names, with formula, shape and domain; empty where it types its formula or moves free.
/// Throws FaultError when there is no such definition.
std::string definitionTextOf(const Experiment& experiment);
/// The experiment as a file that reads back equal (for saving from the window, and for the log).
std::string toJson(const Experiment& experiment);
/// Every fault of the value, each under its key as in the files; empty when fine. The reader adds the places.
std::vector<Fault> problems(const Experiment& experiment);

/// Names of the shipped experiments, sorted: those that one hand does with one device, and those for two.
std::vector<std::string> shippedExperiments();
std::vector<std::string> shippedForTwoHands();
/// Folder of resources: $REACHLAB_RESOURCES, else beside the source or installed. Throws ResourceError when there is none.
std::string resourceFolder();

}  // namespace reachlab::experiment
