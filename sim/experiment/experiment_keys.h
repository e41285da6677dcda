#pragma once
#include <fmt/format.h>

#include "base/maybe_const.h"
#include "base/number_range.h"
#include "base/ticks.h"
#include "sim/experiment/checked_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/tested_ranges.h"

/// The keys of an experiment's file with their ranges, in the file's order. This is the one list for reading, writing and checking. A new
/// key is one member in experiment.h, one line here and its entry in resources/schemas/experiment.schema.json. Separate functions of
/// reader, writer and check handle keys that depend on other keys: the constraint, the hands, the number of springs.
namespace reachlab::experiment {

struct Key {
  const char* name;
  NumberRange range = anyNumber();                  // of a number, or of each of a fixed count of numbers
  bool required = false;                            // in a file
  const std::vector<std::string>* names = nullptr;  // a text is one of these
  const char* shape = "";                           // how an object that is required looks
  bool constants = false;                           // numbers may be written as constants ("2*pi")
  bool diagonal = false;                            // a matrix may be written as its diagonal
};

/// In the order of ObjectKind.
inline const std::vector<std::string> kObjectKindNames{"point", "chain", "parallel", "body", "none"};
/// In the order of TaskPlane, ForceLaw, ForceWhen, CursorShow and CursorJudge.
inline const std::vector<std::string> kTaskPlaneNames{"horizontal", "frontal"};
inline const std::vector<std::string> kForceKindNames{"viscous", "elastic", "joint-viscous", "channel", "pulse"};
inline const std::vector<std::string> kForceWhenNames{"movement", "trial"};
inline const std::vector<std::string> kCursorShowNames{"always", "movement-end", "never"};
inline const std::vector<std::string> kCursorJudgeNames{"cursor", "hand"};

template <MaybeConst<Object> T, class Visit>
void visitKeys(T& o, const Visit& visit) {
  visit(Key{.name = "kind", .required = true, .names = &kObjectKindNames}, o.kind);
  if (o.kind == ObjectKind::None) return;
  visit(Key{"masses_kg"}, o.masses);
  visit(Key{"stiffness_n_per_m"}, o.stiffness);
  visit(Key{"damping_n_s_per_m"}, o.damping);
  visit(Key{"viscosity_n_s_per_m", dampingRange()}, o.viscosity);
  visit(Key{"gravity_m_per_s2", componentRange()}, o.gravity);
  if (o.kind != ObjectKind::Body) return;
  visit(Key{.name = "inertia_kg_m2",
            .range = componentRange(),
            .required = true,
            .shape = "[Ix, Iy, Iz] or a symmetric positive 3 x 3 matrix",
            .diagonal = true},
        o.inertia);
  visit(Key{"fp_offset_m", componentRange()}, o.fpOffset);
}

template <MaybeConst<Coupling> T, class Visit>
void visitKeys(T& c, const Visit& visit) {
  visit(Key{"stiffness_n_per_m", stiffnessRange(), true}, c.stiffness);
  visit(Key{"damping_n_s_per_m", dampingRange()}, c.damping);
}

template <MaybeConst<Tolerance> T, class Visit>
void visitKeys(T& t, const Visit& visit) {
  visit(Key{"position_m", lengthRange(), true}, t.position);
  visit(Key{"velocity_m_per_s", speedRange(), true}, t.velocity);
  visit(Key{"time_s", positiveUpTo(kMaxDuration, "s"), true}, t.time);
}

template <MaybeConst<Task> T, class Visit>
void visitKeys(T& t, const Visit& visit) {
  visit(Key{.name = "start", .constants = true}, t.start);
  visit(Key{.name = "target", .constants = true}, t.target);
  visit(Key{"duration_s", durationRange(), true}, t.duration);
  visit(Key{.name = "tolerance", .required = true, .shape = "{ position_m, velocity_m_per_s, time_s }"}, t.tolerance);
  visit(Key{"onset_m", lengthRange()}, t.onset);
  visit(Key{"arm_radius_m", lengthRange()}, t.armRadius);
  visit(Key{"timeout_s", positiveUpTo(kMaxTimeout, "s")}, t.timeout);
  visit(Key{"rest_s", {0, kMaxRestDuration, true, fmt::format("0 to {:.0f} s", kMaxRestDuration)}}, t.rest.seconds);
  visit(Key{"rest_speed_m_per_s", positive("m/s")}, t.rest.speed);
  visit(Key{.name = "plane", .names = &kTaskPlaneNames}, t.plane);
  visit(Key{.name = "via_m", .range = componentRange(), .shape = "a list of places [x, y, z]"}, t.via);
  visit(Key{"via_radius_m", lengthRange()}, t.viaRadius);
}

template <MaybeConst<ViscousForce> T, class Visit>
void visitKeys(T& f, const Visit& visit) {
  visit(Key{.name = "matrix_n_s_per_m", .range = between(-1e6, 1e6, "N s/m"), .required = true, .shape = "3 rows of 3 numbers"}, f.matrix);
}

template <MaybeConst<ElasticForce> T, class Visit>
void visitKeys(T& f, const Visit& visit) {
  visit(Key{.name = "matrix_n_per_m", .range = between(-1e6, 1e6, "N/m"), .required = true, .shape = "3 rows of 3 numbers"}, f.matrix);
  visit(Key{"centre_m", componentRange()}, f.centre);
}

template <MaybeConst<JointViscousForce> T, class Visit>
void visitKeys(T& f, const Visit& visit) {
  const NumberRange range = between(-1e6, 1e6, "N m s/rad");
  visit(Key{.name = "matrix_n_m_s_per_rad", .range = range, .required = true, .shape = "2 rows of 2 numbers"}, f.matrix);
}

template <MaybeConst<ChannelForce> T, class Visit>
void visitKeys(T& f, const Visit& visit) {
  visit(Key{"stiffness_n_per_m", positiveUpTo(1e6, "N/m")}, f.stiffness);
  visit(Key{"damping_n_s_per_m", upTo(1e6, "N s/m")}, f.damping);
  visit(Key{"half_width_m", upTo(10, "m")}, f.halfWidth);
  visit(Key{"ramp_s", upTo(60, "s")}, f.ramp);
  visit(Key{"break_m", positiveUpTo(10, "m")}, f.breakDistance);
}

template <MaybeConst<PulseInstant> T, class Visit>
void visitKeys(T& p, const Visit& visit) {
  visit(Key{"onset_s", upTo(kMaxDuration, "s")}, p.onset);
  visit(Key{"distance_m", upTo(10, "m")}, p.distance);
}

template <MaybeConst<PulseForce> T, class Visit>
void visitKeys(T& f, const Visit& visit) {
  visit(Key{.name = "force_n", .range = between(-1e6, 1e6, "N"), .required = true, .shape = "[x, y, z]"}, f.force);
  visit(Key{.name = "at", .required = true, .shape = "{ \"onset_s\": … } or { \"distance_m\": … }"}, f.at);
  visit(Key{"duration_s", durationRange()}, f.duration);
  visit(Key{"rise_s", durationRange()}, f.rise);
}

/// Reader, writer and check visit the keys of the law beside its kind.
template <MaybeConst<HandForce> T, class Visit>
void visitKeys(T& f, const Visit& visit) {
  visit(Key{.name = "kind", .required = true, .names = &kForceKindNames}, f.law);
  if (!std::holds_alternative<PulseForce>(f.law)) visit(Key{.name = "when", .names = &kForceWhenNames}, f.when);
}

template <MaybeConst<Cursor> T, class Visit>
void visitKeys(T& c, const Visit& visit) {
  visit(Key{"rotation_deg", between(-180, 180, "degrees")}, c.rotation);
  visit(Key{"gain", positiveUpTo(100, "")}, c.gain);
  visit(Key{"clamp_deg", between(-180, 180, "degrees")}, c.clamp);
  visit(Key{"delay_s", upTo(10, "s")}, c.delay);
  visit(Key{.name = "show", .names = &kCursorShowNames}, c.show);
  visit(Key{.name = "judge", .names = &kCursorJudgeNames}, c.judge);
}

template <MaybeConst<TimingLimits> T, class Visit>
void visitKeys(T& t, const Visit& visit) {
  visit(Key{"max_missed_ticks", wholeNumber(0, kNoTimingLimits.maxMissedTicks)}, t.maxMissedTicks);
  // A gap between two ticks is at least one tick long.
  const std::string allowed = fmt::format("{} s to {:.0f} s", kTickSeconds, kNoTimingLimits.maxGap);
  visit(Key{"max_gap_s", {kTickSeconds, kNoTimingLimits.maxGap, true, allowed}}, t.maxGap);
}

template <MaybeConst<VelocityEstimatorSpec> T, class Visit>
void visitKeys(T& v, const Visit& visit) {
  visit(Key{.name = "kind", .required = true, .names = &velocityEstimatorNames()}, v.kind);
  visit(Key{"cutoff_hz", positiveUpTo(400, "Hz")}, v.cutoff);
}

template <MaybeConst<Arm> T, class Visit>
void visitKeys(T& a, const Visit& visit) {
  visit(Key{"link_length_m", lengthRange()}, a.length);
  visit(Key{"link_centre_m", lengthRange()}, a.centre);
  visit(Key{"link_mass_kg", massRange()}, a.mass);
  visit(Key{"link_inertia_kg_m2", inertiaRange()}, a.inertia);
  visit(Key{"joint_damping_n_m_s_per_rad", upTo(1e9, "N m s/rad")}, a.damping);
  visit(Key{"shoulder_m", componentRange()}, a.shoulder);
  visit(Key{"elbow_left"}, a.elbowLeft);
}

template <MaybeConst<SubjectScreen> T, class Visit>
void visitKeys(T& s, const Visit& visit) {
  visit(Key{"semaphore"}, s.semaphore);
  visit(Key{"target"}, s.target);
  visit(Key{"masses"}, s.masses);
  visit(Key{"words"}, s.words);
  visit(Key{"score"}, s.score);
  visit(Key{"photodiode"}, s.photodiode);
}

template <MaybeConst<Experiment> T, class Visit>
void visitKeys(T& e, const Visit& visit) {
  visit(Key{"schema_version", {1, 1, true, "1, the version that this program reads"}, true}, e.schemaVersion);
  visit(Key{"name"}, e.name);
  visit(Key{.name = "constraint", .required = true, .shape = "a name of the catalogue, or a curve or surface formula"}, e.constraint);
  visit(Key{.name = "object", .required = true, .shape = "{ kind, masses_kg, … }"}, e.object);
  visit(Key{"coupling"}, e.coupling);
  visit(Key{"hands"}, e.hands);
  visit(Key{"task"}, e.task);
  visit(Key{"environment"}, e.environment);
  visit(Key{"cursor"}, e.cursor);
  visit(Key{.name = "method", .names = &methodNames()}, e.method);
  visit(Key{"hand_mass_kg", handMassRange()}, e.handMass);
  visit(Key{"force_limit_n", forceRange()}, e.forceLimit);
  visit(Key{"force_limit_ends_trial"}, e.forceLimitEndsTrial);
  visit(Key{"timing"}, e.timing);
  visit(Key{"velocity_estimator"}, e.velocityEstimator);
  visit(Key{"arm"}, e.arm);
  visit(Key{"subject_screen"}, e.subjectScreen);
}

}  // namespace reachlab::experiment
